"""Whose a folder is: results never take the place of another run's, or of a file that drumrs did not write.

A folder of results holds a file ``drumrs-KIND.json``, which says what they are of.
"""

import json
from collections.abc import Sequence
from pathlib import Path

from drumrs.errors import ConfigError
from drumrs.files import read_object, write_whole

# What a folder may be of, and how it is called.
KINDS = {
    "run": "a run",
    "baseline": "a comparison",
    "sweep": "a sweep",
    "compare": "a comparison of designs",
    "screen": "a screening",
    "reproduction": "a reproduction",
    "validation": "a validation",
    "baffle": "an inference of the baffle",
    "optimization": "an optimization",
    "calibration": "a calibration",
}
# Where a sweep's folder keeps finished cases that were packed.
PACKS = "packs"
# What a run's folder holds.
RUN_FILES = (
    "config.toml",
    "series.parquet",
    "frames.parquet",
    "phases.parquet",
    "contacts.parquet",
    "wall_profile.parquet",
    "ledger_split.parquet",
    "discs.parquet",
    "fields.parquet",
    "zone_visits.parquet",
    "summary.json",
    "unstable.json",
    "checkpoint.bin",
    "snapshots.png",
    "time_series.png",
    "player.html",
    "records",
)
# Without any of these a run has left nothing that one could miss.
_WORTH = ("summary.json", "unstable.json", "checkpoint.bin")
_FORMAT = 1


def marker(kind: str) -> str:
    """Return the name of the file that says that a folder is of a kind."""
    return f"drumrs-{kind}.json"


def require_own(folder: Path, kind: str, names: Sequence[str], option: str = "folder") -> None:
    """Refuse a folder of results of another kind, or one with files of these names that drumrs did not write.

    Parameters
    ----------
    folder
        Where results are to be written; it need not exist.
    kind
        One of `KINDS`.
    names
        What is going to be written there.
    option
        What the user called the folder.

    Raises
    ------
    ConfigError
        Where the folder is not accepted.
    """
    for other, called in KINDS.items():
        if other != kind and (folder / marker(other)).exists():
            limit = f"a new folder or one of {KINDS[kind]}: it is that of {called}"
            raise ConfigError(option, folder, limit, hint="choose another")
    found = [name for name in names if (folder / name).exists()]
    if found and not (folder / marker(kind)).exists():
        limit = (
            f"a new folder or one that drumrs made: this one has a {found[0]} that is not overwritten, for drumrs did "
            "not write it"
        )
        raise ConfigError(option, folder, limit, hint="choose another folder, or move the file away")


def require_unused(
    folder: Path, kind: str, *, digest: str = "", force: str = "--force", option: str = "folder"
) -> None:
    """Refuse a folder that holds other results of the same kind.

    Parameters
    ----------
    folder
        Where results are to be written; it need not exist.
    kind
        One of `KINDS`.
    digest
        Digest of what may be there already, since it is going to be written again; empty where nothing may.
    force
        How to have the results replaced.
    option
        What the user called the folder.

    Raises
    ------
    ConfigError
        Where there are such results.
    """
    if not (folder / marker(kind)).exists():
        return
    mark = read_object(folder / marker(kind)) or {}
    left = [name for name in _WORTH if (folder / name).exists()]
    if (digest and mark.get("digest") == digest) or (kind == "run" and not left):
        return
    resume = f"go on with it: drumrs run --resume {folder}; " if left == ["checkpoint.bin"] else ""
    limit = f"a folder without {KINDS[kind]}: it holds that of {mark.get('title', 'an unknown case')}"
    hint = f"{resume}replace it: {force}; or choose another folder"
    raise ConfigError(option, folder, limit, hint=hint)


def claim(folder: Path, kind: str, title: str, digest: str) -> None:
    """Make a folder where there is none, and say in it whose it is.

    Raises
    ------
    OSError
        Where it cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    content = {"format": _FORMAT, "title": title, "digest": digest}
    write_whole(folder / marker(kind), f"{json.dumps(content, ensure_ascii=False)}\n".encode())


def require_format(folder: Path, kind: str) -> None:
    """Refuse to read a folder whose marker names a newer format; one without a marker has its files checked alone.

    Raises
    ------
    ConfigError
        Where a newer version of drumrs made it.
    """
    found = (read_object(folder / marker(kind)) or {}).get("format", _FORMAT)
    if not isinstance(found, int) or found > _FORMAT:
        limit = f"of format {_FORMAT} at most: a newer drumrs made it"
        raise ConfigError(
            folder, found, limit, problem=f"is of format {found}, but must be {limit}", bound=_FORMAT
        )


def is_claimed(folder: Path, kind: str, digest: str) -> bool:
    """Tell whether a folder says that it is of a kind, with this digest."""
    return (read_object(folder / marker(kind)) or {}).get("digest") == digest
