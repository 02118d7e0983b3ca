"""`Check`: a published statement beside what was measured, and whether they agree."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drumrs.analysis import Estimate

# Stands for what a publication says where it says nothing: a number of ours, or a test of our own means.
NOTHING = "–"
AGREES, DIFFERS, UNDECIDED, SHOWN = "agrees", "differs", "undecided", "shown"


@dataclass(frozen=True)
class Check:
    """A number of a publication beside our own.

    Attributes
    ----------
    quantity
        What it is.
    published
        What the publication says, in words or figures; `NOTHING` where the check is one of our own.
    measured
        What the simulations gave.
    low, high
        The interval that agrees with the publication, tolerance included; without one the number is shown, not judged.
    unit
        Unit of the number, as it is shown.
    """

    quantity: str
    published: str
    measured: "Estimate"
    low: float = -math.inf
    high: float = math.inf
    unit: str = ""

    @property
    def verdict(self) -> str:
        """Whether the interval of 95 % lies within the tolerance, outside, or across its edge."""
        if (self.low, self.high) == (-math.inf, math.inf):
            return SHOWN
        found = self.measured.interval()
        if not math.isfinite(found.mean):
            return UNDECIDED
        if self.low <= found.low and found.high <= self.high:
            return AGREES
        return DIFFERS if found.high < self.low or found.low > self.high else UNDECIDED

    @property
    def measured_text(self) -> str:
        """The measured number with half its interval of 95 %, rounded to the interval's second digit."""
        found = self.measured.interval()
        unit = f" {self.unit}" if self.unit else ""
        if not math.isfinite(found.mean):
            return "not measured"
        if not math.isfinite(found.half_width) or not found.half_width:
            return f"{found.mean:.3g}{unit}"
        digits = max(0, 1 - math.floor(math.log10(found.half_width)))
        return f"{found.mean:.{digits}f} ± {found.half_width:.{digits}f}{unit}"

    @property
    def tolerated_text(self) -> str:
        """The interval that agrees."""
        if self.verdict == SHOWN:
            return NOTHING
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.high):
            return f"above {self.low:.3g}{unit}"
        if math.isinf(self.low):
            return f"below {self.high:.3g}{unit}"
        return f"{self.low:.3g} to {self.high:.3g}{unit}"
