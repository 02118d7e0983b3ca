"""LIGGGHTS: drums with or without baffles."""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from codes.balance import Trace
from codes.case import Array, Case
from codes.lammps import SAMPLE, as_options, read_rows, read_timing, shared_values
from codes.program import DECKS, Timing, call, require


@dataclass(frozen=True)
class Liggghts:
    """LIGGGHTS, with Debian's program `liggghts`."""

    name: str = "LIGGGHTS"
    pace: float = 15e6

    def require(self) -> None:
        """Raise `MissingError` where LIGGGHTS is not installed."""
        require("LIGGGHTS", "liggghts", "liggghts")

    def time(self, case: Case, settle: int, timed: int, folder: Path) -> Timing:
        """Time a number of steps, after some that are not timed."""
        return read_timing(self._run(case, folder, trace=False, settle=settle, timed=timed), timed)

    def trace(self, case: Case, duration: float, folder: Path) -> Trace:
        """Run for so long [s] and tell power and center of mass."""
        steps = SAMPLE * -(-round(duration / case.time_step) // SAMPLE)
        self._run(case, folder, trace=True, settle=0, timed=steps)
        return read_rows(folder / "rows.txt", case)

    def _run(self, case: Case, folder: Path, *, trace: bool, settle: int, timed: int) -> str:
        program = require("LIGGGHTS", "liggghts", "liggghts")
        case.write_data(folder / "state.data", types=2)
        baffles = case.baffles()
        if baffles:
            triangles = _triangles(baffles, depth=1.5 * case.config.load.diameter)
            (folder / "baffles.stl").write_text(triangles, encoding="ascii")
        values = shared_values(case) | {
            "kp": case.pair.stiffness,
            "np": case.pair.damping,
            "kw": case.wall.stiffness,
            "nw": case.wall.damping,
            "baffles": len(baffles),
            "trace": int(trace),
            "settle": settle,
            "timed": timed,
        }
        words = [program, "-log", "none", "-in", str(DECKS / "liggghts" / "drum.in")]
        return call("LIGGGHTS", words + as_options(values), folder)


def _triangles(baffles: list[Array], depth: float) -> str:
    """Return the baffles' edges as walls across the slice, two triangles each, in the STL format.

    The depth must stay within the periodic box: LIGGGHTS would fold corners beyond it.
    """
    facets = []
    for line in baffles:
        for a, b in pairwise(line):
            along = (b - a) / np.hypot(*(b - a))
            low_a, low_b, high_b, high_a = (
                (*p, z) for p, z in ((a, -depth), (b, -depth), (b, depth), (a, depth))
            )
            for corners in ((low_a, low_b, high_b), (low_a, high_b, high_a)):
                vertices = "\n".join(f"  vertex {x:.12g} {y:.12g} {z:.12g}" for x, y, z in corners)
                facets.append(
                    f"facet normal {along[1]:.12g} {-along[0]:.12g} 0\n outer loop\n{vertices}\n endloop\nendfacet"
                )
    return "\n".join(["solid baffles", *facets, "endsolid baffles", ""])
