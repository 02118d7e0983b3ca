"""An emulator over shapes for each observable, with the noise of every run known."""

from collections.abc import Mapping

import numpy as np

from drumrs.decide.emulator import Emulator
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.sentences import OBSERVABLES
from drumrs.paper.shape import BASES, HEIGHTS, Shape

# Of height, base and tip [m].
RANGES = (HEIGHTS, BASES, (0.0, BASES[1]))
# Noise below this part of the spread is not believed.
_LEAST_NOISE = 0.02


def emulate(scanned: Mapping[Shape, Means]) -> dict[Observable, Emulator]:
    """Return an emulator of every observable that a sentence is about.

    Parameters
    ----------
    scanned
        What is known of each shape that was run with softer springs.
    """
    shapes = sorted(scanned)
    lengths = np.array([shape.lengths for shape in shapes])
    found = {}
    for one in OBSERVABLES:
        if one.baffles:
            known = np.array([scanned[shape][one] for shape in shapes])
            found[one] = Emulator.fit(lengths, known[:, 0], known[:, 1], RANGES, _LEAST_NOISE).calibrated()
    return found
