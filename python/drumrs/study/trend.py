"""Whether a curve rises, or falls, all along."""

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from drumrs.analysis import combine
from drumrs.study.curves import Curve, slope
from drumrs.study.verdict import Condition, Finding, each_within, within
from drumrs.study.words import ABOUT

RISES, FALLS = 1, -1
_NAMES = {RISES: "Rise", FALLS: "Fall"}


def goes(curve: Callable[[], Curve], name: str, way: int) -> Iterator[Condition]:
    """Ask whether a curve rises or falls: as a whole, and never the other way by more than what rounds to nothing.

    Parameters
    ----------
    curve
        Called for the curve, and may raise `MissingError`.
    name
        What is drawn against what, such as ``"N/T over fill"``.
    way
        `RISES` or `FALLS`.
    """
    yield lambda: slopes(curve(), name, way)
    yield lambda: turns_nowhere(curve(), name, way)


def slopes(curve: Curve, name: str, way: int, unit: str = "") -> Finding:
    """Ask for the sign of the slope of the straight line through a curve."""
    low, high = (0.0, math.inf) if way == RISES else (-math.inf, 0.0)
    return within(f"Slope of {name}", slope(curve), low, high, unit)


def turns_nowhere(curve: Curve, name: str, way: int) -> Finding:
    """Ask whether no step between neighboring points goes the other way, by more than 10 % of the mean."""
    points = curve.between(least=2).points
    level = way * abs(float(np.mean([point.estimate.mean for point in points])))
    steps = []
    for here, there in pairwise(points):
        change = (there.estimate.mean - here.estimate.mean) / level
        step = combine(change, [(1.0 / level, there.estimate), (-1.0 / level, here.estimate)])
        steps.append((f"{here.x:.4g} to {there.x:.4g}", step))
    return each_within(f"{_NAMES[way]} of {name} from point to point, over its mean", steps, low=-ABOUT)
