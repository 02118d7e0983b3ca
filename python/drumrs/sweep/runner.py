"""Who works on a case: a mark beside its checkpoint, by which a case that was stopped is told from one under way.

The process that runs a case leaves the mark before the checkpoint, and takes it away when it ends in order. So a
checkpoint without a mark belongs to nobody, wherever it was written. Whether a process that left its mark is still
there, only its own machine can tell.
"""

import json
import os
import platform
from functools import cache
from pathlib import Path

from drumrs.files import read_object, write_whole

ENDING = "runner.json"
# Of a process that has ended and that nobody has asked for how.
_ENDED = ("Z", "X")


class Runner:
    """The mark of this process on a case.

    Parameters
    ----------
    path
        The file of the mark.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def mark(self) -> None:
        """Say that this process works on the case.

        Raises
        ------
        OSError
            Where the folder is full or cannot be written.
        """
        write_whole(self._path, f"{json.dumps(_me())}\n".encode())

    def clear(self) -> None:
        """Take the mark away, unless it is another's who works on the same case."""
        if read_object(self._path) == _me():
            self._path.unlink(missing_ok=True)


def is_at_work(path: Path) -> bool | None:
    """Tell whether the process that left a mark is at work; `None` where that cannot be told from here.

    Parameters
    ----------
    path
        The file of the mark.
    """
    mark = read_object(path)
    if mark is None:
        return False if not path.exists() else None
    process, machine = mark.get("process"), mark.get("machine")
    if not isinstance(process, int) or machine is None or machine != _machine():
        return None
    return _began(process) == mark.get("began")


def _me() -> dict[str, object]:
    # Asked for each time: a process that was forked is another one.
    process = os.getpid()
    return {"host": platform.node(), "machine": _machine(), "process": process, "began": _began(process)}


@cache
def _machine() -> str | None:
    """Return what tells apart machines, their starts, and containers with processes of their own; `None` elsewhere."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        return f"{boot} {Path('/proc/self/ns/pid').readlink()}"
    except OSError:
        return None


def _began(process: int) -> int | None:
    """Return when a process of this machine began, in ticks since the machine did; `None` where it is no more.

    Numbers of processes are given anew; with this one they are not taken for each other.
    """
    try:
        words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return None if words[0] in _ENDED else int(words[19])
