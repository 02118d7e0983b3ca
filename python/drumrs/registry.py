"""The registry of quantities: one name for each, with symbol, unit, reading, formula and meaning.

What a run records is declared by the core, beside the code that computes it. What is made of it is declared in
`quantity_rows`, or follows from the rules for names (`_by_rule`). Columns of tables, fields of the summary, units in
files, labels of figures and docs/quantities.md all read from here.
"""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import MappingProxyType

from drumrs import _core, quantity_rows
from drumrs.errors import ConfigError

# What adds columns to the series on request, by the key `run.record`.
RECORDINGS = ("gross_work",)

# Names of what is made beyond the table of a sweep: for published drums, by measures, as facts of a case, by phase.
PUBLISHED_DRUMS, MEASURES, FACTS, PHASES = (
    tuple(row.name for row in rows)
    for rows in (
        quantity_rows.PUBLISHED_DRUMS,
        quantity_rows.MEASURES,
        quantity_rows.FACTS,
        quantity_rows.PHASES,
    )
)

# The parts of a drum with one baffle and one wall.
PARTS = ("rim", "baffle 1", "wall 1")

# How values are to be read.
READINGS = MappingProxyType(
    {
        "sample": "value at the time of the sample",
        "mean": "mean since the last sample, or over the window",
        "cumulative": "integral since t = 0",
        "greatest": "greatest value since the last sample, or within the window",
        "run": "one value for the run",
        "ratio": "ratio of two means over the window",
        "error": "standard error of a mean over the window, from block averages",
        "test": "test of whether the window is steady",
    }
)


@dataclass(frozen=True)
class Quantity:
    """What a column or a field holds.

    Attributes
    ----------
    name
        The name under which it goes everywhere.
    symbol
        Symbol, as formulas use it.
    unit
        Unit, per meter of drum depth where the quantity is extensive; "1" for a plain number.
    reading
        How its values are to be read: a key of `READINGS`.
    formula
        Formula, in the symbols of other quantities; empty where the meaning says it all. Δ is the change between two
        samples, or over the window; in energies without a rate, the change since t = 0.
    meaning
        What it means.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.quantity("dissipated_sliding").label
    'dissipated sliding [J/m]'
    """

    name: str
    symbol: str
    unit: str
    reading: str
    formula: str
    meaning: str

    @property
    def title(self) -> str:
        """The name in words."""
        return self.name.replace("_", " ")

    @property
    def label(self) -> str:
        """The name in words, with the unit: what stands at an axis or at the head of a column."""
        return self.title if self.unit == "1" else f"{self.title} [{self.unit}]"

    @property
    def text(self) -> str:
        """Meaning, formula and unit in one line."""
        formula = f", {self.formula}" if self.formula else ""
        unit = f" [{self.unit}]" if self.unit != "1" else ""
        return f"{self.meaning[0].upper()}{self.meaning[1:]}{formula}{unit}"


def quantity(name: str) -> Quantity:
    """Return what the registry says of a quantity.

    Parameters
    ----------
    name
        Name of a column of series, frames or a table of results, or of a field of the summary.

    Raises
    ------
    KeyError
        Where there is no such quantity.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.quantity("baffle_2_work").unit, drumrs.quantity("dissipated_sliding_specific_power").unit
    ('J/m', 'W/kg')
    >>> print(drumrs.quantity("dissipation_ratio").meaning)
    N/T by dissipation: what normal damping takes over what sliding takes
    """
    found = _find(name)
    if found is None:
        raise KeyError(f"{name!r} is not the name of a quantity; drumrs.quantities() lists them")
    return found


def known(names: Iterable[str]) -> list[Quantity]:
    """Return those of the names that are quantities."""
    return [found for name in names if (found := _find(name)) is not None]


def metadata(columns: Iterable[Quantity]) -> dict[str, str]:
    """Return what a file has to carry beside a table with these columns: their units and meanings, as JSON."""
    columns = list(columns)
    return {
        "units": json.dumps({column.name: column.unit for column in columns}),
        "meanings": json.dumps({column.name: column.meaning for column in columns}, ensure_ascii=False),
    }


def require(path: Path, names: Iterable[str], wanted: Iterable[str]) -> None:
    """Refuse a file of another version of drumrs, in which quantities have other names.

    Raises
    ------
    ConfigError
        Where one of those wanted is not among the names.
    """
    known = set(names)
    for name in wanted:
        if name not in known:
            problem = (
                f"has no {name!r}, but must have it: another version of drumrs wrote it, with other names"
            )
            hint = "run its configuration again, or read it with that version"
            raise ConfigError(Path(path), problem=problem, hint=hint)


def recorded(parts: Iterable[str] = PARTS, record: Iterable[str] = ()) -> list[Quantity]:
    """Return the columns of the series of a drum with these parts, in their order.

    Those of what is recorded on request, `record`, are among them.
    """
    return [Quantity(*row) for row in _core.Simulation.columns(list(parts), "gross_work" in record)]


def declared() -> Mapping[str, Quantity]:
    """Return what is declared, not made by a rule, by name: the series with one baffle and one wall, then the rest."""
    return _declared()


@cache
def _declared() -> Mapping[str, Quantity]:
    rows = quantity_rows
    made = (*rows.TABLES, *rows.PUBLISHED_DRUMS, *rows.MEASURES, *rows.FACTS, *rows.PHASES)
    found = (*recorded(record=RECORDINGS), *(Quantity(*row) for row in made))
    return MappingProxyType({row.name: row for row in found})


def _find(name: str) -> Quantity | None:
    return _declared().get(name) or _of_surface(name) or _of_part(name) or _by_rule(name)


def _of_surface(name: str) -> Quantity | None:
    """Return a column of a part of the drum: of a baffle or wall beyond the first, or one that a liner names."""
    found = re.fullmatch(r"([a-z]\w*)_([1-9]\d*)_(work|torque|force_x|force_y)", name)
    if found is None:
        return None
    columns = recorded([f"{found[1]} {found[2]}"])
    return next(column for column in columns if column.name == name)


def part_and_measure(name: str) -> tuple[str, str] | None:
    """Return the part of the drum and the measure that a name such as "baffle_1_impact_rate" has; else `None`."""
    found = re.fullmatch(rf"(rim|[a-z]\w*_[1-9]\d*)_({'|'.join(quantity_rows.OF_PARTS)})", name)
    return (found[1], found[2]) if found else None


def _of_part(name: str) -> Quantity | None:
    """Return a measure of records of one part of the drum."""
    found = part_and_measure(name)
    if found is None:
        return None
    whole = _declared()[quantity_rows.OF_PARTS[found[1]]]
    part = "rim" if found[0] == "rim" else found[0].replace("_", " ")
    meaning = whole.meaning.replace("the outline of the drum", part).replace("the drum", part)
    return replace(whole, name=name, meaning=meaning)


def _by_rule(name: str) -> Quantity | None:
    """Return what follows from another quantity by the rules for names.

    - ``<energy>_power``: what a cumulative energy grows by per time. An ending ``_work`` gives way: ``drum_work``,
      ``drum_power``.
    - ``<energy>_specific_power``: the same over the mass of the load.
    - ``<mean>_error``: the standard error of a mean.
    """
    stem, _, ending = name.rpartition("_")
    if ending == "error":
        mean = _declared().get(stem) or _by_rule(stem)
        known = mean is not None and mean.reading in {"mean", "ratio"}
        return _error_of(mean) if mean is not None and known else None
    flow = stem.removesuffix("_specific")
    energy = _declared().get(flow) or _declared().get(f"{flow}_work")
    if ending != "power" or energy is None or energy.reading != "cumulative":
        return None
    formula = f"Δ{energy.symbol}/Δt"
    power = Quantity(name, formula, "W/m", "mean", formula, f"{energy.meaning}, per time")
    if flow == stem:
        return power
    specific = f"{formula}/M"
    return replace(
        power, symbol=specific, unit="W/kg", formula=specific, meaning=f"{power.meaning} and mass of the load"
    )


def _error_of(mean: Quantity) -> Quantity:
    changes = {"reading": "error", "formula": "", "meaning": f"standard error of {mean.name}"}
    return replace(mean, name=f"{mean.name}_error", symbol=f"s({mean.symbol})", **changes)
