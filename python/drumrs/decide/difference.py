"""`Difference`: how far apart two values of a target may be that count as equal."""

import math
import re
from dataclasses import dataclass

from drumrs.errors import ConfigError

_PERCENT = 100.0


@dataclass(frozen=True)
class Difference:
    """A difference below which designs count as equal: a part of the best one's mean, or an amount in its unit.

    Examples
    --------
    >>> from drumrs.decide.difference import Difference
    >>> Difference.parse("5 %", "W/kg"), Difference.parse("0.2 W/kg", "W/kg")
    (Difference(amount=0.05, is_relative=True), Difference(amount=0.2, is_relative=False))
    """

    amount: float
    is_relative: bool

    @classmethod
    def parse(cls, text: str | float, unit: str) -> "Difference":
        """Read a difference: a number in the target's unit, with or without it, or a percentage.

        Raises
        ------
        ConfigError
            Where it is neither, or not positive.
        """
        found = re.fullmatch(r"\s*([-+.\deE]+)\s*(.*?)\s*", str(text))
        limit = (
            f"a positive number with a % or in {unit}" if unit != "1" else "a positive number or percentage"
        )
        try:
            number = float(found[1]) if found else math.nan
        except ValueError:
            number = math.nan
        if not found or not 0.0 < number < math.inf or found[2] not in {"", "%", unit}:
            raise ConfigError("difference", text, limit)
        return cls(number / _PERCENT, True) if found[2] == "%" else cls(number, False)

    def of(self, best: float) -> float:
        """Return it as an amount, for a mean of the best design."""
        return self.amount * abs(best) if self.is_relative else self.amount

    def text(self, best: float, unit: str) -> str:
        """Say it, for a mean of the best design."""
        amount = with_unit(f"{self.of(best):.2g}", unit)
        return f"{_PERCENT * self.amount:g} % ({amount})" if self.is_relative else amount


def with_unit(number: str, unit: str) -> str:
    """Return a number with its unit, where it has one."""
    return number if unit == "1" else f"{number} {unit}"
