"""What a page is made of: sections, and in them sentences, numbers, tables, pictures and the player."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.errors import ConfigError
from drumrs.registry import quantity
from drumrs.result import with_error

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from drumrs.analysis import Mean
    from drumrs.reports.run_data import RunData

# Greatest and smallest magnitude that is written without a power of ten.
_PLAIN = (1e-3, 1e5)
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Table:
    """A table: the first column names its rows; ``numbers`` tells that the others are right-aligned."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str = ""
    numbers: bool = True


@dataclass(frozen=True)
class Picture:
    """A figure with its title and what it shows; ``draw`` makes it, once the page is written."""

    title: str
    caption: str
    draw: "Callable[[], Figure]"


@dataclass(frozen=True)
class Play:
    """The player of the run."""


Block = str | Table | Picture | Play


@dataclass(frozen=True)
class Section:
    """A part of a page.

    Attributes
    ----------
    anchor, title
        Its name in addresses, and in words.
    write
        Gives its blocks one after the other. A `ConfigError` ends it: what was there remains, and the page says what
        the rest lacks.
    """

    anchor: str
    title: str
    write: "Callable[[RunData], Iterable[Block]]"

    def blocks(self, data: "RunData") -> tuple[list[Block], str]:
        """Return the blocks of a run, and what the rest lacks, empty where nothing does."""
        made: list[Block] = []
        try:
            for block in self.write(data):
                made.append(block)  # noqa: PERF402 - what came before an error is kept
        except ConfigError as error:
            return made, str(error)
        return made, ""


def measured(found: "Mapping[str, Mean | None]", caption: str = "") -> Table:
    """Return means by name of the registry as a table, with errors, units and meanings; angles are in degrees."""
    return Table(("", "mean ± error", "what it is"), [_row(*item) for item in found.items()], caption, False)


def _row(name: str, mean: "Mean | None") -> Sequence[str]:
    own = quantity(name)
    unit, factor = ("°", math.degrees(1.0)) if own.unit == "rad" else (own.unit, 1.0)
    label = own.title if unit == "1" else f"{own.title} [{unit}]"
    if mean is None or not math.isfinite(mean.value):
        return label, "–", own.meaning
    return label, value(factor * mean.value, mean.error and factor * mean.error), own.meaning


def value(number: float | None, error: float | None = None, digits: int = 4) -> str:
    """Show a number with its standard error, to the error's second digit, or to some digits; a dash for none.

    Examples
    --------
    >>> from drumrs.reports.content import value
    >>> value(12.345, 0.21), value(3.2e-7), value(0.5, 0.0), value(123456.0, 3200.0), value(52374.0)
    ('12.35 ± 0.21', '3.2·10⁻⁷', '0.5', '(1.235 ± 0.032)·10⁵', '52370')
    """
    if number is None or not math.isfinite(number):
        return "–"
    size = abs(float(f"{number:.{digits}g}"))
    if size == 0.0 or _PLAIN[0] <= size < _PLAIN[1]:
        return _plain(number, error, digits).replace("-", "−")
    power = math.floor(math.log10(size))
    mantissa = _plain(number / 10.0**power, error and error / 10.0**power, digits)
    return f"{f'({mantissa})' if error else mantissa}·10{str(power).translate(_RAISED)}".replace("-", "−")


def _plain(number: float, error: float | None, digits: int) -> str:
    """Show a number without a power of ten."""
    if error:
        return with_error(number, error)
    return np.format_float_positional(float(f"{number:.{digits}g}"), trim="-")
