"""Yade: drums with or without baffles, by a law whose dashpot never pulls."""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from codes.balance import Trace
from codes.case import Case
from codes.lammps import SAMPLE, read_rows, read_timing
from codes.program import DECKS, Timing, call, require

# Length of a side of the polygon that stands for the rim [m]: the rim lies within 0.04 mm of it in Table 1's drum.
_SIDE = 0.0083


@dataclass(frozen=True)
class Yade:
    """Yade, with Debian's program `yade`."""

    name: str = "Yade"
    pace: float = 3e6

    def require(self) -> None:
        """Raise `MissingError` where Yade is not installed."""
        require("Yade", "yade", "yade")

    def time(self, case: Case, settle: int, timed: int, folder: Path) -> Timing:
        """Time a number of steps, after some that are not timed."""
        return read_timing(self._run(case, folder, trace=False, settle=settle, timed=timed), timed)

    def trace(self, case: Case, duration: float, folder: Path) -> Trace:
        """Run for so long [s] and tell power and center of mass."""
        steps = SAMPLE * -(-round(duration / case.time_step) // SAMPLE)
        self._run(case, folder, trace=True, settle=0, timed=steps)
        return read_rows(folder / "rows.txt", case)

    def _run(self, case: Case, folder: Path, *, trace: bool, settle: int, timed: int) -> str:
        program = require("Yade", "yade", "yade")
        np.savetxt(folder / "state.txt", case.motion(), fmt="%.17g")
        values = {
            "radius": case.radius,
            "diameter": case.config.load.diameter,
            "density": case.config.load.density,
            "omega": case.angular_velocity,
            "friction": case.pair.friction,
            "pair": {"stiffness": case.pair.stiffness, "damping": case.pair.damping},
            "wall": {"stiffness": case.wall.stiffness, "damping": case.wall.damping},
            "time_step": case.time_step,
            "sides": math.ceil(2.0 * math.pi * case.radius / _SIDE),
            "baffles": [line.tolist() for line in case.baffles()],
            "trace": trace,
            "sample": SAMPLE,
            "settle": settle,
            "timed": timed,
        }
        (folder / "case.json").write_text(json.dumps(values), encoding="utf-8")
        return call("Yade", [program, "-x", "-n", "-j1", str(DECKS / "yade" / "drum.py")], folder)
