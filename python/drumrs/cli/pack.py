"""`drumrs pack`: the many files of a sweep in a few."""

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.messages import warn
from drumrs.cli.tables import print_paths
from drumrs.sweep import pack as pack_folder
from drumrs.sweep import unpack

_FAILED = 1
_MOST_NAMED = 10


def pack(out: Path, /, *, unpack_: Annotated[str | None, Parameter(name="--unpack")] = None) -> int:
    """Put the files of a sweep's finished cases, four or more each, into two files for some thousand cases.

    For file systems with a quota of files. OUT/packs then has pairs of files: a `.zip` with the files as they were,
    byte for byte, and a `.parquet` with the rows of the table. Each file is checked before it is packed, and removed
    only after its copy was read back and found equal; killed at any moment nothing is lost, and the same command goes
    on.

    `drumrs sweep` and `drumrs status` work on as before, finished cases are not computed again, and the table holds
    all rows. Cases that failed or are left stay as they are. It is refused while a case has a fresh checkpoint, as then
    somebody computes there. `drumrs view`, `export` and `movie` take a case after `--unpack`.

    Exit status: 0; 1, finished cases were left as they are, since they are damaged or of another version; 2, refused.

    Parameters
    ----------
    out
        Folder of the sweep.
    unpack_
        Pack nothing, and put the files of the case with this id, or beginning of an id, back into the folder.
    """
    if unpack_ is not None:
        print_paths(unpack(out, unpack_))
        return 0
    done = pack_folder(out)
    sys.stdout.write(f"packed {done.cases} cases: {2 * done.packs} files in place of {done.files}\n")
    for case, reason in list(done.left.items())[:_MOST_NAMED]:
        warn(f"case {case} keeps files of its own: {reason}")
    if len(done.left) > _MOST_NAMED:
        warn(f"… and {len(done.left) - _MOST_NAMED} more cases keep files of their own")
    return _FAILED if done.left else 0
