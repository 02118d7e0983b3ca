"""Files that are either whole or not there: written under a temporary name, flushed to disk, renamed."""

import errno
import json
import os
import re
import secrets
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

# What a write says where there is no room: disk, quota, limit of a process.
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
# How long to wait for another program to let go of a file [s].
_PAUSES = (0.05, 0.1, 0.25, 0.6, 1.0)
_TEMPORARY = re.compile(r"\..+\.[0-9a-f]{8}\.tmp")


def read_plain(path: Path) -> bytes:
    """Read a plain file; a folder, a pipe or a device of that name, which could keep one waiting for ever, is refused.

    Raises
    ------
    OSError
        Where there is no such file, it is none, or it cannot be read or held.
    """
    require_plain(path)
    try:
        return path.read_bytes()
    except MemoryError:
        raise OSError(errno.EFBIG, "it is too large", str(path)) from None


def require_plain(path: Path) -> None:
    """Refuse a folder, a pipe or a device in the place of a file."""
    if path.exists() and not path.is_file():
        kind = errno.EISDIR if path.is_dir() else errno.EINVAL
        raise OSError(kind, "it is a folder" if path.is_dir() else "it is no file", str(path))


def read_object(path: Path) -> dict[str, Any] | None:
    """Read a JSON object; `None` where there is no file that holds one."""
    try:
        return parse_object(read_plain(path))
    except OSError:
        return None


def parse_object(data: bytes) -> dict[str, Any] | None:
    """Return the JSON object that a file holds; `None` where it holds something else."""
    try:
        content = json.loads(data)
    except (ValueError, RecursionError):
        return None
    return content if isinstance(content, dict) else None


def write_whole(path: str | Path, *data: bytes | memoryview) -> None:
    """Write `data`, piece after piece, so that `path` never holds half of it, not even after a power cut.

    Raises
    ------
    OSError
        Where the folder cannot be written; the temporary file is removed.
    """
    with replacing(path) as temporary, temporary.open("wb") as file:
        for piece in data:
            file.write(piece)


def remove_temporaries(folder: Path) -> None:
    """Remove the temporary files that a kill has left in a folder to which nobody else writes now."""
    for path in folder.glob(".*.tmp"):
        if _TEMPORARY.fullmatch(path.name):
            path.unlink(missing_ok=True)


def _replace(temporary: Path, path: Path) -> None:
    """Let a file take the place of another, which another program may hold open for a moment, or for longer.

    Raises
    ------
    PermissionError
        Where it is held for longer; what was written is kept beside, under a name that the message tells.
    """
    for pause in _PAUSES:
        try:
            temporary.replace(path)
        except PermissionError:
            time.sleep(pause)
        else:
            return
    try:
        temporary.replace(path)
    except PermissionError as error:
        kept = path.with_name(f"{path.stem}.{secrets.token_hex(4)}{path.suffix}")
        temporary.rename(kept)
        told = PermissionError(
            f"cannot replace {str(path)!r}: another program holds it open, or it is protected ({error.strerror}); "
            f"what was to be written is in {str(kept)!r}"
        )
        raise told from None


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Give a temporary file to write, which takes the place of `path` once it is whole and on the disk.

    Raises
    ------
    OSError
        Where the folder cannot be written; the temporary file is removed.
    """
    path = Path(path)
    # Two writers of one file, on threads of a process or on two machines, must not share a temporary.
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        _replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
