"""LAMMPS: bare drums, the wall on the discs near it or on all."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from codes.balance import Trace
from codes.case import Case
from codes.program import DECKS, PeerError, Timing, call, last_words, require

# The wall acts on discs within this distance [m] of touching it.
_MARGIN = 0.006
# Steps between rows of a trace.
SAMPLE = 200


@dataclass(frozen=True)
class Lammps:
    """LAMMPS, with Debian's program `lmp`.

    Attributes
    ----------
    near
        Whether the wall acts on the discs near it only, picked anew every few hundred steps: the fastest correct
        set-up. Else on every disc.
    """

    near: bool = True
    name: str = "LAMMPS"
    pace: float = 15e6

    def require(self) -> None:
        """Raise `MissingError` where LAMMPS is not installed."""
        require("LAMMPS", "lmp", "lammps")

    def time(self, case: Case, settle: int, timed: int, folder: Path) -> Timing:
        """Time a number of steps, after some that are not timed."""
        return read_timing(self._run(case, folder, trace=False, settle=settle, timed=timed), timed)

    def trace(self, case: Case, duration: float, folder: Path) -> Trace:
        """Run for so long [s] and tell power and center of mass."""
        steps = SAMPLE * -(-round(duration / case.time_step) // SAMPLE)
        self._run(case, folder, trace=True, settle=0, timed=steps)
        return read_rows(folder / "rows.txt", case)

    def _run(self, case: Case, folder: Path, *, trace: bool, settle: int, timed: int) -> str:
        program = require("LAMMPS", "lmp", "lammps")
        if case.config.drum.baffles.count:
            raise PeerError("LAMMPS has no deck with baffles; LIGGGHTS and Yade have")
        case.write_data(folder / "state.data")
        values = self._values(case) | {"trace": int(trace), "settle": settle, "timed": timed}
        words = [program, "-log", "none", "-in", str(DECKS / "lammps" / "drum.in")]
        return call("LAMMPS", words + as_options(values), folder)

    def _values(self, case: Case) -> dict[str, object]:
        return shared_values(case) | {
            "kp": case.pair.stiffness,
            "gp": case.pair.damping_rate,
            "kw": case.wall.stiffness,
            "gw": case.wall.damping_rate,
            "wall": "near" if self.near else "all",
            "margin": _MARGIN,
            "pick": max(1, int(_MARGIN / (case.fastest * case.time_step))),
        }


def shared_values(case: Case) -> dict[str, object]:
    """Return the variables that the decks of LAMMPS and LIGGGHTS share."""
    return {
        "state": "state.data",
        "density": case.config.load.density,
        "diameter": case.config.load.diameter,
        "radius": case.radius,
        "omega": case.angular_velocity,
        "mu": case.pair.friction,
        "dt": case.time_step,
        "sample": SAMPLE,
        "out": "rows.txt",
    }


def as_options(values: dict[str, object]) -> list[str]:
    """Return variables as words of the command line."""
    return [word for name, value in values.items() for word in ("-var", name, str(value))]


def read_timing(printed: str, steps: int) -> Timing:
    """Read the times of the clock that a deck has printed before and after its timed steps.

    Raises
    ------
    PeerError
        Where there are none.
    """
    # The clock's lines may come in the middle of others, which a pipe keeps back and cuts anywhere.
    began, ended = (re.search(rf"{word}:([0-9]+\.[0-9]+)", printed) for word in ("BEGAN", "ENDED"))
    if began is None or ended is None or not float(ended[1]) > float(began[1]):
        raise PeerError(f"there is no time taken in the output, but this at its end:\n{last_words(printed)}")
    return Timing(steps, float(ended[1]) - float(began[1]))


def read_rows(path: Path, case: Case) -> Trace:
    """Read rows of step, x, y and angular momentum per mass, as `fix ave/time` writes them.

    Raises
    ------
    PeerError
        Where there are fewer than two, or something but numbers.
    """
    try:
        rows = np.loadtxt(path, comments="#", ndmin=2)
    except (OSError, ValueError) as error:
        raise PeerError(f"{path} cannot be read as rows of numbers: {error}") from None
    if rows.ndim != 2 or rows.shape[0] < 2 or rows.shape[1] != 4 or not np.isfinite(rows).all():  # noqa: PLR2004
        raise PeerError(
            f"{path} holds {rows.shape[0]} rows, but must hold two or more, of four finite numbers"
        )
    return Trace.of_samples(rows[:, 0] * case.time_step, rows[:, 1:], case.angular_velocity)
