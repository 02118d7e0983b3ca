"""Verdicts: what a claim and each of its parts come to, where they hold, and the numbers that decide."""

import math
from dataclasses import dataclass, field, replace

from drumrs.analysis import Estimate
from drumrs.paper.ranges import Piece, where

HOLDS, IN_PART, FAILS, UNDECIDED = "holds", "holds in part", "does not hold", "undecided"
OUTCOMES = (HOLDS, IN_PART, FAILS, UNDECIDED)


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
class Band:
    """Where a part of a claim wants a curve, in the curve's own units; limits may be infinite.

    Attributes
    ----------
    axis, column, label
        Parameter, quantity and name of the curve.
    x, low, high
        Values of the parameter, and the limits there.
    """

    axis: str
    column: str
    label: str
    x: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]


@dataclass(frozen=True)
class Finding:
    """What one part of a claim comes to.

    Attributes
    ----------
    outcome
        `HOLDS`, `FAILS` or `UNDECIDED`, for the part as a whole.
    sentence
        Why, in words.
    numbers
        The numbers that decide.
    name
        What the part says, in a few words, such as ``"without baffles"``.
    axis, pieces
        The parameter along which the part is judged, and its outcome piece by piece.
    bands
        Where it wants the curve.
    deciding
        Those of the numbers that decide first, where there are several kinds; else all.
    deviates
        Whether it fails by one reading at least, finer or coarser than that by which it is judged.
    """

    outcome: str
    sentence: str
    numbers: tuple[Number, ...] = ()
    name: str = ""
    axis: str = ""
    pieces: tuple[Piece, ...] = ()
    bands: tuple[Band, ...] = field(default=(), repr=False)
    deciding: tuple[Number, ...] = ()
    deviates: bool = False

    def __post_init__(self) -> None:
        """Let all numbers decide unless some are named."""
        object.__setattr__(self, "deciding", self.deciding or self.numbers)

    @property
    def where(self) -> str:
        """Over which values of the parameter it surely holds, in words; empty where nowhere or as a whole."""
        return "" if self.outcome == HOLDS else where(self.axis, self.pieces, HOLDS)

    @property
    def verdict(self) -> str:
        """The outcome, and `IN_PART` for what fails as a whole but surely holds over a range."""
        return IN_PART if self.outcome == FAILS and self.where else self.outcome

    @property
    def held(self) -> str:
        """What of it surely holds, in words; empty where nothing does."""
        if self.outcome == HOLDS:
            return self.name
        return f"{self.name}, {self.where}".removeprefix(", ") if self.where else ""

    @property
    def heading(self) -> str:
        """What it says and, where it is not so as a whole, the range over which it surely is."""
        surely = "surely " if self.outcome == UNDECIDED else ""
        told = f"{self.name}, {surely}{self.where}" if self.where else self.name
        return told[:1].upper() + told[1:]

    def named(self, name: str) -> "Finding":
        """Return it under a name."""
        return replace(self, name=name)


@dataclass(frozen=True)
class OtherReading:
    """What a claim comes to when something is read otherwise: by another ratio, or with other baffles."""

    name: str
    verdict: str
    where: str = ""

    def __str__(self) -> str:
        """Return name and verdict, and where it holds if in part."""
        told = f"is {self.verdict}" if self.verdict == UNDECIDED else self.verdict
        return f"{self.name} it {told}{f' ({self.where})' if self.verdict == IN_PART else ''}"


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
        What each part of the claim comes to.
    others
        What it comes to by other readings, shown beside.
    why
        Why it fails where it does, in words made of the data; empty where nothing is to be said.
    is_evidence
        Whether the shape of the baffles was inferred from it, so that agreeing is no confirmation.
    """

    claim: str
    statement: str
    criterion: str
    figure: str
    parts: tuple[Finding, ...]
    others: tuple[OtherReading, ...] = ()
    why: str = ""
    is_evidence: bool = False

    @property
    def verdict(self) -> str:
        """`HOLDS`, `IN_PART`, `FAILS` or `UNDECIDED`: what is true however the undecided parts come out.

        It holds where all parts do, and does not where all fail everywhere. It holds in part where something surely
        holds, a part or a range of one, and a part surely fails. All else is undecided.
        """
        outcomes = {part.outcome for part in self.parts}
        if FAILS in outcomes and any(part.held for part in self.parts):
            return IN_PART
        return outcomes.pop() if len(outcomes) == 1 else UNDECIDED

    @property
    def where(self) -> str:
        """What of it surely holds, in words; empty where all or nothing does."""
        if self.verdict == HOLDS:
            return ""
        return "; ".join(part.held for part in self.parts if part.held)

    @property
    def sentence(self) -> str:
        """Why, in words."""
        return " ".join(part.sentence for part in self.parts)

    @property
    def numbers(self) -> tuple[Number, ...]:
        """The numbers that decide, with 95 % intervals."""
        return tuple(number for part in self.parts for number in part.numbers)
