"""Verdicts: what a claim comes to, with the numbers that decide it."""

import math
from dataclasses import dataclass

from drumrs.analysis import Estimate

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
    >>> from drumrs.paper import Number
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
