"""How the paper's words are read as numbers, the same for every claim, and how numbers are held against them.

Where the text compares by eye what a figure shows, limits are widened by a part of the largest value that the figure
shows: that much a point read off a printed figure is worth, wherever it lies. Three such parts are tried.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from drumrs.analysis import Estimate, combine
from drumrs.analysis.estimate import LEVEL
from drumrs.paper.curves import Curve, Results, slope
from drumrs.paper.ranges import Piece, place
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, Band, Finding, MissingError, Number

# "About", "nearly constant", "just under", "similar", "minor": to this part of the largest value shown. Where one of
# the other two would turn the outcome, it is left undecided.
READING = 0.10
READINGS = (0.05, READING, 0.15)
# "Only about 20 %", "weak", "little".
WEAK = 0.20
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
# A mean, and the value of the parameter, or the step from one to the next, to which it belongs.
At = tuple[float, float, Estimate]


@dataclass(frozen=True)
class Claim:
    """What the paper says, how that is read as numbers, where it shows, and the conditions that judge it.

    Attributes
    ----------
    number, statement
        Its number, and what the paper says.
    criterion
        How that is read.
    figure
        The figure that shows it.
    shows
        Parameter and quantity of the curve that its card shows; "N/T" is whichever ratio stands for it.
    conditions
        Function from results to the conditions of its parts, each under the name of its part.
    why
        Function from results to a paragraph on why it fails where it does.
    """

    number: str
    statement: str
    criterion: str
    figure: str
    shows: tuple[str, str]
    conditions: Callable[[Results], Iterable[tuple[str, Condition]]]
    why: Callable[[Results], str] | None = None


def settle(name: str, condition: Condition) -> Finding:
    """Judge a part of a claim, which is undecided where its cases are missing or it compares with a mean of 0."""
    try:
        return condition().named(name)
    except MissingError as missing:
        return Finding(UNDECIDED, f"Cases are missing: {missing}.", name=name)
    except ZeroDivisionError:
        return Finding(UNDECIDED, "A mean of 0 stands where others are compared with it.", name=name)


def within(
    name: str,
    estimate: Estimate,
    low: float = -math.inf,
    high: float = math.inf,
    unit: str = "",
    *,
    largest: float = 0.0,
) -> Finding:
    """Ask whether a mean lies between limits: its 95 % interval decides, where it does not reach over one.

    Parameters
    ----------
    name
        What the mean is of.
    estimate
        The mean.
    low, high, unit
        The limits and their unit.
    largest
        Largest value of the figure off which the text reads this by eye; 0 where it does not.
    """
    number = Number.of(name, estimate, unit)
    read = _read([(0.0, 0.0, estimate)], low, high, largest)
    told = f"{name}: {number.text} ({claimed(low, high, unit, largest)}: {read.told})."
    return Finding(read.outcome, told, (number,), deviates=read.deviates)


def each_within(
    name: str,
    points: Sequence[At],
    low: float = -math.inf,
    high: float = math.inf,
    *,
    axis: str = "fill",
    largest: float = 0.0,
) -> Finding:
    """Ask whether all means lie between limits.

    It holds where every 95 % interval lies within; it does not where one lies outside even when widened so that
    among all of them one in twenty deviates by chance (Bonferroni).

    Parameters
    ----------
    name
        What the means are of.
    points
        The means, in the order of the parameter.
    low, high, largest
        As for `within`.
    axis
        The parameter.

    Raises
    ------
    MissingError
        Where there are no means.
    """
    if not points:
        raise MissingError(name)
    read = _read(points, low, high, largest)
    least, most = min(points, key=lambda p: p[2].mean), max(points, key=lambda p: p[2].mean)
    ends = {place(axis, a, b): one for a, b, one in (least, most)}
    numbers = tuple(Number.of(f"{name} at {at}", one) for at, one in ends.items())
    values = " to ".join(f"{number.text} at {at}" for number, at in zip(numbers, ends, strict=True))
    outside = [place(axis, piece.low, piece.high) for piece in read.pieces if piece.outcome == FAILS]
    where = f" Not so at {', '.join(outside)}." if outside else ""
    sentence = (
        f"{name}: {'from ' if len(ends) > 1 else ''}{values} "
        f"(each {claimed(low, high, '', largest)}: {read.told}).{where}"
    )
    return Finding(read.outcome, sentence, numbers, "", axis, read.pieces, deviates=read.deviates)


@dataclass(frozen=True)
class _Read:
    """What means come to by three readings of their limits: as a whole, piece by piece, and in words."""

    outcome: str
    pieces: tuple[Piece, ...]
    told: str
    deviates: bool


def _read(points: Sequence[At], low: float, high: float, largest: float) -> _Read:
    read = {part: _judge(points, low - part * largest, high + part * largest) for part in READINGS}
    outcome = _agreed({part: found for part, (found, _) in read.items()})
    pieces = tuple(
        Piece(a, b, _agreed({part: each[k] for part, (_, each) in read.items()}))
        for k, (a, b, _) in enumerate(points)
    )
    answers = {part: ANSWERS[found] for part, (found, _) in read.items()}
    told = answers[READING]
    if largest and len(set(answers.values())) == 1:
        told += ", by each reading"
    elif largest:
        told = "read to " + ", ".join(f"{100.0 * part:.0f} % {answer}" for part, answer in answers.items())
    if outcome != read[READING][0]:
        told += "; undecided by reading"
    return _Read(outcome, pieces, told, FAILS in {found for found, _ in read.values()})


def _judge(points: Sequence[At], low: float, high: float) -> tuple[str, list[str]]:
    level = 1.0 - (1.0 - LEVEL) / len(points)
    each = []
    for _, _, one in points:
        held, deviates = _place(one, low, high, LEVEL) == HOLDS, _place(one, low, high, level) == FAILS
        each.append(HOLDS if held else FAILS if deviates else UNDECIDED)
    return joined(each), each


def _agreed(outcomes: dict[float, str]) -> str:
    return UNDECIDED if {HOLDS, FAILS} <= set(outcomes.values()) else outcomes[READING]


def _place(estimate: Estimate, low: float, high: float, level: float) -> str:
    interval = estimate.interval(level)
    if low <= interval.low and interval.high <= high:
        return HOLDS
    return FAILS if interval.high < low or interval.low > high else UNDECIDED


def joined(outcomes: Iterable[str]) -> str:
    """Return what several outcomes come to together: one that fails decides, else one that is undecided does."""
    found = set(outcomes)
    return FAILS if FAILS in found else UNDECIDED if UNDECIDED in found else HOLDS


def all_of(
    findings: Sequence[Finding],
    pieces: tuple[Piece, ...] = (),
    axis: str = "",
    bands: tuple[Band, ...] = (),
) -> Finding:
    """Return what several findings come to as one part of a claim; `bands` add to their own."""
    outcome = joined(one.outcome for one in findings)
    return Finding(
        outcome,
        " ".join(one.sentence for one in findings),
        tuple(number for one in findings for number in one.numbers),
        "",
        axis,
        pieces,
        (*bands, *(one for finding in findings for one in finding.bands)),
        next(one.numbers for one in findings if one.outcome == outcome),
        any(one.deviates for one in findings),
    )


def at_fills(findings: Sequence[tuple[float, Finding]]) -> Finding:
    """Return what the same question at several fills comes to as one part of a claim."""
    pieces = tuple(Piece(fill, fill, one.outcome) for fill, one in findings)
    return all_of([one for _, one in findings], pieces, "fill")


def none_outside(finding: Finding) -> Finding:
    """Ask only that no mean surely lies outside of limits; none needs to be surely within."""
    return replace(finding, outcome=HOLDS) if finding.outcome == UNDECIDED else finding


def claimed(low: float = -math.inf, high: float = math.inf, unit: str = "", largest: float = 0.0) -> str:
    """Write the limits that a claim sets, widened as they are read."""
    unit = f" {unit}" if unit else ""
    slack = READING * largest
    if low == high:
        return f"claimed {low:.3g} ± {slack:.2g}{unit}"
    if low == -math.inf:
        return f"claimed below {high + slack:.3g}{unit}"
    if high == math.inf:
        return f"claimed above {low - slack:.3g}{unit}"
    return f"claimed {low - slack:.3g} to {high + slack:.3g}{unit}"


def points_of(curve: Curve) -> list[At]:
    """Return the points of a curve as `each_within` takes them."""
    return [(point.x, point.x, point.estimate) for point in curve.points]


def stays_within(curve: Curve, name: str, low: float, high: float, largest: float) -> Finding:
    """Ask whether a curve, two points at least, lies between limits that the text reads by eye."""
    curve = curve.between(least=2)
    found = each_within(name, points_of(curve), low, high, axis=curve.axis, largest=largest)
    return replace(found, bands=(band(curve, low - READING * largest, high + READING * largest),))


def band(curve: Curve, low: float, high: float) -> Band:
    """Return the band between two limits along a curve."""
    count = len(curve)
    return Band(
        curve.axis, curve.column, curve.label, tuple(curve.x.tolist()), (low,) * count, (high,) * count
    )


def is_constant(curve: Curve, name: str, largest: float) -> Finding:
    """Ask whether all points of a curve lie about their mean."""
    means = [one.mean for one in curve.between(least=2).estimates]
    level = float(np.mean(means))
    found = stays_within(curve, name, level, level, largest)
    return _with_relative(found, [mean / level - 1.0 for mean in means])


def is_similar(curve: Curve, other: Curve, name: str, largest: float) -> Finding:
    """Ask whether two curves are about the same, at the values of the parameter that both have."""
    pairs = curve.against(other, lambda a, b: a - b)
    found = each_within(name, [(x, x, one) for x, one in pairs], 0.0, 0.0, axis=curve.axis, largest=largest)
    x, slack = tuple(x for x, _ in pairs), READING * largest
    level = [other.at(one).mean for one in x]
    low, high = (tuple(one + way * slack for one in level) for way in (-1.0, 1.0))
    found = replace(found, bands=(Band(curve.axis, curve.column, curve.label, x, low, high),))
    # Beside next to nothing any difference is great.
    if min(level) <= slack:
        return found
    return _with_relative(found, [curve.at(at).mean / one - 1.0 for at, one in zip(x, level, strict=True)])


def _with_relative(finding: Finding, differences: Sequence[float]) -> Finding:
    """Add relative differences to what is judged on the figure's scale."""
    ends = dict.fromkeys(f"{100.0 * one:+.0f} %" for one in (min(differences), max(differences)))
    return replace(finding, sentence=f"{finding.sentence} Relative difference: {' to '.join(ends)}.")


def varies_little(curve: Curve, name: str, largest: float) -> Finding:
    """Ask whether a curve falls from its greatest value by 20 % of it at most, read by eye."""
    means = [one.mean for one in curve.between(least=2).estimates]
    greatest = max(means)
    found = stays_within(curve, name, (1.0 - WEAK) * greatest, math.inf, largest)
    varies = f"Greatest less least, over the greatest: {100.0 * (1.0 - min(means) / greatest):.0f} %."
    return replace(found, sentence=f"{found.sentence} {varies}")


RISES, FALLS = 1, -1
_NAMES = {RISES: "Rise", FALLS: "Fall"}


def is_monotonic(
    curve: Curve,
    name: str,
    way: int,
    largest: float,
    sections: Sequence[tuple[float, float]] = ((-math.inf, math.inf),),
) -> Finding:
    """Ask whether a curve rises or falls: over each section, and from no point to the next the other way.

    Parameters
    ----------
    curve
        The curve.
    name
        What is drawn against what, such as ``"N/T over fill"``.
    way
        `RISES` or `FALLS`.
    largest
        Largest value of its figure: steps the other way by a tenth of it cannot be read.
    sections
        Parts of the axis over each of which the slope is asked for, so that none hides behind another.
    """
    steps = _turns_nowhere(curve.between(least=2), name, way, largest)
    slopes = []
    for low, high in sections:
        part = curve.between(low, high)
        ends = f", {place(curve.axis, part.x[0], part.x[-1])}" if len(sections) > 1 else ""
        slopes.append(_slopes(part, f"{name}{ends}", way))
    # A step counts for nothing where the section that it lies in goes the other way.
    pieces = tuple(
        replace(piece, outcome=joined([piece.outcome, *_around(piece, sections, slopes)]))
        for piece in steps.pieces
    )
    return all_of([*slopes, steps], pieces, curve.axis)


def _around(piece: Piece, sections: Sequence[tuple[float, float]], slopes: Sequence[Finding]) -> list[str]:
    middle = (piece.low + piece.high) / 2.0
    return [one.outcome for (low, high), one in zip(sections, slopes, strict=True) if low <= middle <= high]


def _slopes(curve: Curve, name: str, way: int) -> Finding:
    """Ask for the sign of the slope of the straight line through a curve."""
    low, high = (0.0, math.inf) if way == RISES else (-math.inf, 0.0)
    return within(f"Slope of {name}", slope(curve), low, high)


def _turns_nowhere(curve: Curve, name: str, way: int, largest: float) -> Finding:
    steps: list[At] = []
    # What a point may not pass: the one before it, as well as that can be read.
    limits = []
    for here, there in pairwise(curve.points):
        change = way * (there.estimate.mean - here.estimate.mean)
        steps.append((here.x, there.x, combine(change, [(1.0, there.estimate), (-1.0, here.estimate)])))
        limits.append(here.estimate.mean - way * READING * largest)
    title = f"{_NAMES[way]} of {name} from point to point"
    found = each_within(title, steps, low=0.0, axis=curve.axis, largest=largest)
    none, x = (way * math.inf,) * len(limits), tuple(point.x for point in curve.points[1:])
    low, high = (tuple(limits), none) if way == RISES else (none, tuple(limits))
    return replace(found, bands=(Band(curve.axis, curve.column, curve.label, x, low, high),))
