"""Units of expressions: products and powers of the units that the registry has."""

from collections.abc import Mapping
from types import MappingProxyType

# How often each unit is a factor; none for a plain number.
Unit = Mapping[str, float]
PLAIN: Unit = MappingProxyType({})

_DIGITS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_TO_DIGITS = str.maketrans(_DIGITS, "0123456789")


def parse_unit(text: str) -> Unit:
    """Read a unit as the registry writes it.

    Examples
    --------
    >>> from drumrs.decide.units import parse_unit
    >>> parse_unit("kg m²/s")
    {'kg': 1.0, 'm': 2.0, 's': -1.0}
    """
    found: dict[str, float] = {}
    above, _, below = text.partition("/")
    for part, sign in ((above, 1.0), (below, -1.0)):
        for factor in part.strip("()").split():
            name = factor.rstrip(_DIGITS)
            power = float(factor[len(name) :].translate(_TO_DIGITS) or 1)
            if name != "1":
                found[name] = found.get(name, 0.0) + sign * power
    return found


def product(one: Unit, other: Unit, power: float = 1.0) -> Unit:
    """Return the unit of one quantity times a power of another.

    Examples
    --------
    >>> from drumrs.decide.units import product
    >>> product({"m": 1.0}, {"W": 1.0, "m": 1.0}, -1.0)
    {'W': -1.0}
    """
    powers = {name: one.get(name, 0.0) + power * other.get(name, 0.0) for name in {**one, **other}}
    return {name: value for name, value in powers.items() if value}


def format_unit(unit: Unit) -> str:
    """Write a unit as the registry does.

    Examples
    --------
    >>> from drumrs.decide.units import format_unit
    >>> format_unit({"m": 1.0, "kg": 1.0, "W": -1.0, "s": -2.0}), format_unit({})
    ('m kg/(W s²)', '1')
    """
    above = " ".join(_factor(name, power) for name, power in unit.items() if power > 0.0)
    below = [_factor(name, -power) for name, power in unit.items() if power < 0.0]
    if not below:
        return above or "1"
    divisor = below[0] if len(below) == 1 else f"({' '.join(below)})"
    return f"{above or '1'}/{divisor}"


def _factor(name: str, power: float) -> str:
    if power == 1.0:
        return name
    if not power.is_integer():
        return f"{name}^{power:g}"
    return name + "".join(_DIGITS[int(digit)] for digit in f"{power:g}")
