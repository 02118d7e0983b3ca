"""How the paper's words are read as numbers, the same for every claim, and how numbers are held against them."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from drumrs.analysis import Estimate, combine
from drumrs.analysis.estimate import LEVEL
from drumrs.paper.curves import Curve, Results, slope
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, Finding, MissingError, Number

# "About", "nearly", "just under", "similar", "minor", "constant": within ten per cent, which is what a point read
# off a printed figure is worth.
ABOUT = 0.10
# "Only about 20 %", "weak", "little": what rounds to 20 % in steps of ten.
WEAK = 0.25
# "Zero": below one per cent of the usual value.
ZERO = 0.01
# "Small but not zero": more than that, and below a quarter of the usual value.
SMALL = 0.25
# "At small μ": up to here.
SMALL_FRICTION = 0.05
# "Abruptly": within a tenth of the coefficient of friction, from a tenth of the usual circulation to half of it.
ABRUPT = 0.10
STILL, CIRCULATING = 0.1, 0.5
# "Carried round the rim as if centrifuging": along the rim for most of the time, and most of the load over the top
# in a turn of the drum.
CENTRIFUGING = 0.5
# "Little relative motion": slower, relative to the turning drum, than a tenth of the rim.
LITTLE_MOTION = 0.1

# Whether a number is within the limits that are claimed.
ANSWERS = {HOLDS: "yes", FAILS: "no", UNDECIDED: "open"}

Condition = Callable[[], Finding]


@dataclass(frozen=True)
class Claim:
    """What the paper says, how that is read as numbers, where it shows, and the conditions that judge it."""

    number: str
    statement: str
    criterion: str
    figure: str
    conditions: Callable[[Results], Iterable[Condition]]


def settle(condition: Condition) -> Finding:
    """Judge a part of a claim, which is undecided where its cases are missing or it compares with a mean of 0."""
    try:
        return condition()
    except MissingError as missing:
        return Finding(UNDECIDED, f"Cases are missing: {missing}.")
    except ZeroDivisionError:
        return Finding(UNDECIDED, "A mean of 0 stands where others are compared with it.")


def within(
    name: str, estimate: Estimate, low: float = -math.inf, high: float = math.inf, unit: str = ""
) -> Finding:
    """Ask whether a mean lies between limits: its 95 % interval decides, where it does not reach over one."""
    number = Number.of(name, estimate, unit)
    outcome = _place(estimate, low, high, LEVEL)
    return Finding(
        outcome, f"{name}: {number.text} ({claimed(low, high, unit)}: {ANSWERS[outcome]}).", (number,)
    )


def each_within(
    name: str, points: Sequence[tuple[str, Estimate]], low: float = -math.inf, high: float = math.inf
) -> Finding:
    """Ask whether all means lie between limits.

    It holds where every 95 % interval lies within; it does not where one lies outside even when widened so that
    among all of them one in twenty strays by chance (Bonferroni).

    Raises
    ------
    MissingError
        Where there are no means.
    """
    if not points:
        raise MissingError(name)
    level = 1.0 - (1.0 - LEVEL) / len(points)
    inside = all(_place(one, low, high, LEVEL) == HOLDS for _, one in points)
    outside = [place for place, one in points if _place(one, low, high, level) == FAILS]
    outcome = FAILS if outside else HOLDS if inside else UNDECIDED
    least, most = min(points, key=lambda p: p[1].mean), max(points, key=lambda p: p[1].mean)
    numbers = tuple(Number.of(f"{name} at {place}", one) for place, one in dict.fromkeys((least, most)))
    told = f"{name}: from {numbers[0].text} at {least[0]} to {numbers[-1].text} at {most[0]}"
    where = f", for what is at {', '.join(outside)}" if outside else ""
    return Finding(outcome, f"{told} (each {claimed(low, high)}: {ANSWERS[outcome]}{where}).", numbers)


def none_outside(
    name: str, points: Sequence[tuple[str, Estimate]], low: float = -math.inf, high: float = math.inf
) -> Finding:
    """Ask whether no mean surely lies outside of limits, as `each_within` does; none needs to be surely within."""
    found = each_within(name, points, low, high)
    return replace(found, outcome=HOLDS) if found.outcome == UNDECIDED else found


def _place(estimate: Estimate, low: float, high: float, level: float) -> str:
    interval = estimate.interval(level)
    if low <= interval.low and interval.high <= high:
        return HOLDS
    return FAILS if interval.high < low or interval.low > high else UNDECIDED


def claimed(low: float = -math.inf, high: float = math.inf, unit: str = "") -> str:
    """Write the limits that a claim sets."""
    unit = f" {unit}" if unit else ""
    if low == -math.inf:
        return f"claimed below {high:.3g}{unit}"
    if high == math.inf:
        return f"claimed above {low:.3g}{unit}"
    return f"claimed {low:.3g} to {high:.3g}{unit}"


RISES, FALLS = 1, -1
_NAMES = {RISES: "Rise", FALLS: "Fall"}


def is_monotonic(curve: Callable[[], Curve], name: str, way: int) -> Iterator[Condition]:
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
