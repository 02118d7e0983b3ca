"""Verdicts: what a claim comes to, with the numbers that decide it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from drumrs.analysis import Estimate
from drumrs.analysis.estimate import LEVEL

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "undecided"


# Numbers below this are round-off.
_NOTHING = 1e-9
# Numbers below this are written with a power of ten.
_TINY = 1e-3
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class MissingError(LookupError):
    """A point that a claim needs and the table does not have."""


@dataclass(frozen=True)
class Number:
    """A number that decides, with the half width of its 95 % interval.

    Examples
    --------
    >>> from drumrs.study import Number
    >>> print(Number("N/T at 50 % fill", 1.4321, 0.0521))
    N/T at 50 % fill: 1.432 ± 0.052
    """

    name: str
    value: float
    half_width: float
    unit: str = ""

    @classmethod
    def of(cls, name: str, estimate: Estimate, unit: str = "") -> "Number":
        """Take mean and interval of an estimate."""
        interval = estimate.interval()
        return cls(name, interval.mean, interval.half_width, unit)

    @property
    def text(self) -> str:
        """Value and half width, both to the second digit of the latter."""
        unit = f" {self.unit}" if self.unit else ""
        if not math.isfinite(self.half_width):
            return f"{self.value:.3g} ± ?{unit}"
        if self.half_width < _NOTHING:
            return f"{self.value if abs(self.value) > _NOTHING else 0.0:.3g}{unit}"
        if max(abs(self.value), self.half_width) < _TINY:
            power = math.floor(math.log10(max(abs(self.value), self.half_width)))
            scaled = (self.value / 10.0**power, self.half_width / 10.0**power)
            return f"({scaled[0]:.1f} ± {scaled[1]:.1f})·10{str(power).translate(_RAISED)}{unit}"
        digits = max(0, 1 - math.floor(math.log10(self.half_width)))
        return f"{self.value:.{digits}f} ± {self.half_width:.{digits}f}{unit}"

    def __str__(self) -> str:
        """Return name and text."""
        return f"{self.name}: {self.text}"


@dataclass(frozen=True)
class Finding:
    """What one part of a claim comes to: its outcome, why in words, and the numbers that decide."""

    outcome: str
    sentence: str
    numbers: tuple[Number, ...] = ()


@dataclass(frozen=True)
class Verdict:
    """What a claim comes to.

    Attributes
    ----------
    claim
        Its number, such as ``"C1"``.
    statement
        What the paper says.
    criterion
        How that is read as numbers.
    figure
        The figure that shows it.
    parts
        What each part of the claim comes to: one that fails decides, else one that is undecided does.
    """

    claim: str
    statement: str
    criterion: str
    figure: str
    parts: tuple[Finding, ...]

    @property
    def verdict(self) -> str:
        """``"holds"``, ``"does not hold"`` or ``"undecided"``."""
        outcomes = {part.outcome for part in self.parts}
        return FAILS if FAILS in outcomes else UNDECIDED if UNDECIDED in outcomes else HOLDS

    @property
    def sentence(self) -> str:
        """Why, in words."""
        return " ".join(part.sentence for part in self.parts)

    @property
    def numbers(self) -> tuple[Number, ...]:
        """The numbers that decide, with 95 % intervals."""
        return tuple(number for part in self.parts for number in part.numbers)


Condition = Callable[[], Finding]


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
        outcome, f"{name}: {number.text} ({claimed(low, high, unit)}: {WORDS[outcome]}).", (number,)
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
    return Finding(outcome, f"{told} (each {claimed(low, high)}: {WORDS[outcome]}{where}).", numbers)


def none_outside(
    name: str, points: Sequence[tuple[str, Estimate]], low: float = -math.inf, high: float = math.inf
) -> Finding:
    """Ask whether no mean surely lies outside of limits, as `each_within` does; none needs to be surely within."""
    found = each_within(name, points, low, high)
    return replace(found, outcome=HOLDS) if found.outcome == UNDECIDED else found


# Whether a number is within the limits that are claimed.
WORDS = {HOLDS: "yes", FAILS: "no", UNDECIDED: "open"}


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
