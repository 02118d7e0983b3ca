"""Files that are either whole or not there: written under a temporary name, flushed to disk, renamed."""

import errno
import os
import secrets
from pathlib import Path

# What a write says where there is no room: disk, quota, limit of a process.
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})


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
