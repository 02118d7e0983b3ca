"""Files that are either whole or not there: written under a temporary name, flushed to disk, renamed."""

import errno
import json
import os
import secrets
from pathlib import Path
from typing import Any

# What a write says where there is no room: disk, quota, limit of a process.
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})


def read_plain(path: Path) -> bytes:
    """Read a plain file; a folder, a pipe or a device of that name, which could keep one waiting for ever, is refused.

    Raises
    ------
    OSError
        Where there is no such file, it is none, or it cannot be read or held.
    """
    if path.exists() and not path.is_file():
        kind = errno.EISDIR if path.is_dir() else errno.EINVAL
        raise OSError(kind, "it is a folder" if path.is_dir() else "it is no file", str(path))
    try:
        return path.read_bytes()
    except MemoryError:
        raise OSError(errno.EFBIG, "it is too large", str(path)) from None


def read_object(path: Path) -> dict[str, Any] | None:
    """Read a JSON object; `None` where there is no file that holds one."""
    try:
        content = json.loads(read_plain(path))
    except (OSError, ValueError, RecursionError):
        return None
    return content if isinstance(content, dict) else None


def write_whole(path: str | Path, data: bytes) -> None:
    """Write `data` so that `path` never holds half of it, not even after a power cut.

    Raises
    ------
    OSError
        Where the folder cannot be written; the temporary file is removed.
    """
    path = Path(path)
    # Two writers of one file, on threads of a process or on two machines, must not share a temporary.
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
