"""Types of the configuration's values: what they accept, and their limits in words for error messages."""

import numbers
import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field

from drumrs.config.derived import GREATEST_BAFFLES, GREATEST_COUNT


@dataclass(frozen=True)
class Limit:
    """What a field accepts, as the end of the message "KEY is VALUE, but must be …"."""

    text: str


def _plain(value: Any) -> Any:
    """Turn NumPy scalars and arrays into Python's own, so that a study may feed either."""
    # Nearly all values; asking for abstract classes takes a quarter of the time of a validation.
    if type(value) in (bool, int, float, str):
        return value
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        return float(value)
    return value.tolist() if hasattr(value, "tolist") else value


def _float_of(value: Any) -> Any:
    """Let 54 and "54.0" stand for 54.0; an integer beyond all floats is refused as infinite."""
    value = _number_in(_plain(value))
    if isinstance(value, int) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            return float("inf") if value > 0 else float("-inf")
    return value


def _whole_of(value: Any) -> Any:
    """Let 1e3 and "1000" stand for 1000."""
    value = _number_in(_plain(value))
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _number_in(value: Any) -> Any:
    """Return the number that a string holds; anything else as it is."""
    if not isinstance(value, str):
        return value
    try:
        return float(value)
    except ValueError:
        return value


def _within(least: int, most: int) -> Any:
    return Field(strict=True, ge=least, le=most)


def _whole(least: int, most: int) -> Limit:
    return Limit(f"a whole number from {least} to {most}")


_NUMBER = BeforeValidator(_float_of)
_COUNT = BeforeValidator(_whole_of)
_FINITE = Field(strict=True, allow_inf_nan=False)

Real = Annotated[float, _NUMBER, _FINITE, Limit("a finite number")]
Positive = Annotated[float, _NUMBER, _FINITE, Field(gt=0), Limit("a positive finite number")]
NonNegative = Annotated[float, _NUMBER, _FINITE, Field(ge=0), Limit("a finite number of at least 0")]
Restitution = Annotated[float, _NUMBER, _FINITE, Field(gt=0, le=1), Limit("above 0 and at most 1")]
PoissonRatio = Annotated[float, _NUMBER, _FINITE, Field(ge=0, le=0.5), Limit("at least 0 and at most 0.5")]
Tilt = Annotated[
    float, _NUMBER, _FINITE, Field(gt=-90, lt=90), Limit("an angle above -90 and below 90 degrees")
]
OpenFraction = Annotated[float, _NUMBER, _FINITE, Field(gt=0, lt=1), Limit("between 0 and 1")]
FaceAngle = Annotated[
    float, _NUMBER, Field(strict=True, gt=-90, lt=90), Limit("above -90 and below 90 degrees")
]
Flag = Annotated[bool, Field(strict=True), Limit("true or false")]

GREATEST_SEED = 2**63 - 1

BundleCount = Annotated[int, _COUNT, _within(1, GREATEST_COUNT), _whole(1, GREATEST_COUNT)]
BaffleCount = Annotated[int, _COUNT, _within(0, GREATEST_BAFFLES), _whole(0, GREATEST_BAFFLES)]
RepeatCount = Annotated[int, _COUNT, _within(1, GREATEST_BAFFLES), _whole(1, GREATEST_BAFFLES)]
Seed = Annotated[int, _COUNT, _within(0, GREATEST_SEED), _whole(0, GREATEST_SEED)]

PartName = Annotated[
    str,
    Field(strict=True, pattern=r"^[a-z]\w*$"),
    Limit("a name that begins with a small letter, then letters, digits and _, such as 'lifter'"),
]
Recordings = Annotated[
    tuple[Literal["gross_work", "contacts", "wall_profile", "ledger_split", "discs", "fields"], ...],
    Limit("a list of any of 'gross_work', 'contacts', 'wall_profile', 'ledger_split', 'discs', 'fields'"),
]

_NAME = re.compile(r"[^\W\d_][\w-]*")


def _is_name(value: str) -> str:
    if not _NAME.fullmatch(value) or value == DRUM:
        raise ValueError
    return value


# How a pair of contact laws calls the drum.
DRUM = "drum"
SpeciesName = Annotated[
    str,
    Field(strict=True),
    AfterValidator(_is_name),
    Limit("a word of letters, digits, - and _, which begins with a letter and is not 'drum'"),
]
TwoNames = Annotated[tuple[str, str], BeforeValidator(_plain), Limit("a pair of names, of species or 'drum'")]
Measure = Annotated[Literal["mass", "area", "number"], Limit("'mass', 'area' or 'number'")]
Numbers = Annotated[
    tuple[Real, ...], BeforeValidator(_plain), Field(min_length=1), Limit("a list of numbers")
]

Vector = Annotated[tuple[Real, Real], BeforeValidator(_plain), Limit("a pair [x, y] of finite numbers")]
Interval = Annotated[
    tuple[NonNegative, NonNegative], BeforeValidator(_plain), Limit("a pair [start, end] of times")
]
Points = Annotated[
    tuple[Vector, ...],
    BeforeValidator(_plain),
    Field(min_length=3),
    Limit("a list of at least 3 points [x, y]"),
]
Polyline = Annotated[
    tuple[Vector, ...],
    BeforeValidator(_plain),
    Field(min_length=2),
    Limit("a list of at least 2 points [x, y]"),
]
ZoneFrame = Annotated[Literal["laboratory", "drum"], Limit("'laboratory' or 'drum'")]
Name = Annotated[str, Field(strict=True, min_length=1, max_length=60), Limit("a name of 1 to 60 characters")]
Repeat = Annotated[int, _COUNT, _within(1, GREATEST_COUNT), _whole(1, GREATEST_COUNT)]
Ramp = Annotated[tuple[Real, Real], BeforeValidator(_plain), Limit("a pair [from, to] of speeds")]
Knot = Annotated[
    tuple[NonNegative, Real], BeforeValidator(_plain), Limit("a knot [time, rpm], time at least 0")
]
Program = Annotated[
    tuple[Knot, ...],
    BeforeValidator(_plain),
    Field(min_length=1),
    Limit("a list of at least 1 knot [time, rpm]"),
]
