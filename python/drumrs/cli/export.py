"""`drumrs export`: a run for ParaView, OVITO and other programs."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.options import PATH
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError


def export(
    run: Path,
    /,
    *,
    to: str | None = None,
    out: Annotated[Path | None, PATH] = None,
    case: Annotated[list[str] | None, Parameter(negative="")] = None,
    force: Annotated[bool, Parameter(negative="")] = False,
) -> None:
    """Write the frames of a run, and the drum that turns about them, in the format of another program.

    - `vtkhdf`: ParaView, VTK, PyVista
    - `gsd`: OVITO, HOOMD-blue, freud
    - `lammps`, `xyz`: OVITO and most other programs for particles, as text
    - `csv`: spreadsheets, R, MATLAB
    - `netcdf`: xarray, MATLAB, Panoply

    `vtkhdf`, `gsd` and `netcdf` need the extra: pip install 'drumrs[export]'.

    Parameters
    ----------
    run
        Folder of a run, its frames.parquet, or a sweep's folder with the beginning of a case's id: out/study/3f2a.
    to
        The format; the name of `--out` tells it unless given.
    out
        File to write. Without it: beside the frames.
    case
        Which case of a sweep's folder: KEY=VALUE of its configuration; may be repeated.
    force
        Replace a file that is there.
    """
    from drumrs import exports

    if to is None and out is None:
        raise ConfigError("--to", problem="is missing", hint=f"give one of {', '.join(exports.FORMATS)}")
    if to is not None and to not in exports.FORMATS:
        raise ConfigError("--to", to, f"one of {', '.join(exports.FORMATS)}")
    frames, recorded = exports.read(run, case or [])
    path = out or exports.default_file(frames, to or "")
    try:
        print_paths(exports.write(recorded, path, to, force=force, option="--out"))
    except OSError as error:
        limit = f"a file that can be written: {error.strerror or error}"
        raise ConfigError("--out", path, limit) from None
