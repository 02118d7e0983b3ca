"""Other people's programs: found or named with what installs them, run, and their failures told in a sentence."""

import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from codes.balance import Trace
from codes.case import Case

# So much of a failed program's last words is shown.
_LAST_LINES = 6
DECKS = Path(__file__).parents[1] / "decks"


class PeerError(Exception):
    """A code that could not be run, or whose output is not what was expected."""


class MissingError(PeerError):
    """A code that is not installed."""


@dataclass(frozen=True)
class Timing:
    """So many steps took so long [s]."""

    steps: int
    seconds: float

    def rate(self, count: int) -> float:
        """Return the particle-steps per second."""
        return count * self.steps / self.seconds


class Code(Protocol):
    """A code that runs cases, in a folder of its own.

    Attributes
    ----------
    name
        What it is called.
    pace
        Particle-steps per second that it makes, roughly: what is timed is chosen by it.
    """

    @property
    def name(self) -> str: ...  # noqa: D102

    @property
    def pace(self) -> float: ...  # noqa: D102

    def require(self) -> None:
        """Raise `MissingError` where the code is not installed."""

    def time(self, case: Case, settle: int, timed: int, folder: Path) -> Timing:
        """Time a number of steps, after some that are not timed."""

    def trace(self, case: Case, duration: float, folder: Path) -> Trace:
        """Run for so long [s] and tell power and center of mass."""


def require(name: str, program: str, package: str) -> str:
    """Return where a program is.

    Raises
    ------
    MissingError
        Where it is not on the path; the sentence says what installs it.
    """
    found = shutil.which(program)
    if found is None:
        raise MissingError(
            f"{name} is not here: no program {program!r} is on the path; "
            f"on Debian and Ubuntu `apt-get install {package}` installs it"
        )
    return found


def call(name: str, words: Sequence[str], folder: Path) -> str:
    """Run a program in a folder and return what it printed.

    Raises
    ------
    PeerError
        Where it fails; with its last words.
    """
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
    printed = done.stdout + done.stderr
    if done.returncode:
        raise PeerError(f"{name} ended with status {done.returncode}:\n{last_words(printed)}")
    return printed


def last_words(printed: str) -> str:
    """Return the last lines of an output, indented."""
    lines = [line for line in printed.splitlines() if line.strip()]
    return "\n".join(f"    {line}" for line in lines[-_LAST_LINES:])
