"""The registry of quantities as a table: what there is, and where it is found; and the page of the documentation.

docs/quantities.md is what ``drumrs quantities --markdown`` prints.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, fields
from typing import Any

import polars as pl

from drumrs import registry
from drumrs.decide import readings
from drumrs.frames import COLUMNS
from drumrs.result import Summary
from drumrs.sweep.columns import schema

_PLACES = {
    "series": "`simulation.series`, `series.parquet`: one row for each sample",
    "summary": "`result.summary`, `summary.json`, and the table of a sweep: averages over the window",
    "table": "the table of a sweep, `table.parquet`, beyond the summaries: one row for each run",
    "study": "the table of `drumrs reproduce` beyond that of a sweep; all but the first with `…_error`",
    "drums": "the table of `drumrs validate`, not in that of a sweep; all but the first with `…_error`",
    "measures": "what `drumrs.measures` returns by name, each with its error, not in tables",
    "frames": "`frames.parquet`: one row for each frame and bundle",
    "facts": "`Config.derived`, and in part on the first line of a run and below the title of a player",
    "phases": "`drumrs.phases(result)`, `phases.parquet`, beside the name and means as above: one row for each phase",
}

_OPENING = """# Quantities

Everything that drumrs measures, under the one name that it has everywhere: in tables, files, figures and Python.
`drumrs quantities` prints this list, `drumrs.quantities()` returns it, `drumrs.quantity(name)` returns one row of it.
This page is written by `drumrs quantities --markdown`.

Energies, powers, forces and torques are per meter of drum depth. Names follow these rules:

- The mean power of a cumulative energy ends in `_power`, and `_work` gives way to it: `dissipated_sliding`,
  `dissipated_sliding_power`; `drum_work`, `drum_power`.
- What is divided by the mass M of the load is *specific*: `drum_specific_power`, `specific_angular_momentum`.
- The standard error of a mean has its name and `_error`: `drum_specific_power_error`.
- What one part of the drum does begins with the part: `rim_torque`, `baffle_2_work`, `wall_1_force_x`.

N/T, normal over tangential power, has three readings: `dissipation_ratio`, what normal damping takes over what sliding
takes; `work_ratio`, which counts what springs store as well; and `gross_work_ratio`, which counts loading and unloading
both. Gross work is recorded on request: `run.record = ["gross_work"]`.

How values are to be read:

{readings}

What has *yes* in the last column can be a [target](decisions/README.md#targets) of a decision, over the window or in a
phase; beside it stands what the run has to keep, which a decision switches on by itself.

Δ is a change over the time Δt, between two samples or over the window; beside an energy without a rate, the change
since t = 0.
"""


class QuantityTable(pl.DataFrame):
    """A polars table that is printed whole, with every text in full."""

    def __str__(self) -> str:
        """Return the whole table."""
        with _whole():
            return super().__str__()

    def __repr__(self) -> str:
        """Return the whole table."""
        return str(self)

    def _repr_html_(self, **options: Any) -> str:
        """Show the whole table in a notebook."""
        with _whole():
            return super()._repr_html_(**options)


def _whole() -> pl.Config:
    return pl.Config(
        tbl_rows=-1,
        tbl_cols=-1,
        fmt_str_lengths=1000,
        tbl_width_chars=180,
        tbl_hide_column_data_types=True,
        tbl_hide_dataframe_shape=True,
        tbl_formatting="NOTHING",
    )


def quantities() -> QuantityTable:
    """Return everything that drumrs measures: a row for each quantity, in the order of the tables that hold it.

    Columns are ``name``, ``unit``, ``reading``, ``symbol``, ``formula``, ``meaning``, as `drumrs.quantity` has them,
    ``found_in``: series, summary, table (of a sweep), study (of the paper), drums (that were published), measures,
    frames, facts (of a case), phases (of a program); and ``target``: "yes" where it can be a `Target`, with what the
    run has to keep, and empty elsewhere. Baffles, walls and the parts that a liner names are numbered from 1; only the
    first baffle and wall are listed.

    Examples
    --------
    >>> import drumrs
    >>> table = drumrs.quantities()
    >>> table.filter(table["name"] == "dissipated_sliding").select("unit", "reading", "found_in").row(0)
    ('J/m', 'cumulative', 'series')
    """
    places = _places()
    names = dict.fromkeys(name for found in places.values() for name in found)
    rows = []
    for name in names:
        row = asdict(registry.quantity(name))
        kept = {key: row[key] for key in ("name", "unit", "reading", "symbol", "formula", "meaning")}
        found_in = ", ".join(place for place in places if name in places[place])
        rows.append(kept | {"found_in": found_in, "target": _as_target(name)})
    return QuantityTable(rows)


def _as_target(name: str) -> str:
    """Say whether a quantity can be a target, and what the run has to keep for it."""
    if name not in readings.names():
        return ""
    return ", ".join(["yes", *readings.kept_for(name)])


def _places() -> Mapping[str, Sequence[str]]:
    """Return the names that are found in each place."""
    series = [column.name for column in registry.recorded(record=registry.RECORDINGS)]
    summary = [field.name for field in fields(Summary)]
    table = [one.name for one in registry.known(schema()) if one.name not in summary]
    drums, measures = registry.PUBLISHED_DRUMS, registry.MEASURES
    facts, phases = registry.FACTS, registry.PHASES
    placed = {*series, *summary, *table, *drums, *measures, *COLUMNS, *facts, *phases}
    study = [name for name in registry.declared() if name not in placed]
    places: dict[str, Sequence[str]] = {"series": series, "summary": summary, "table": table, "study": study}
    places |= {"drums": drums, "measures": measures, "frames": COLUMNS}
    return {**places, "facts": facts, "phases": phases}


def page() -> str:
    """Return the registry as a page of Markdown."""
    readings = "\n".join(f"- **{name}**: {meaning}" for name, meaning in registry.READINGS.items())
    return "\n".join([_OPENING.format(readings=readings), *_tables()])


def _tables() -> Iterator[str]:
    for place, names in _places().items():
        yield f"## {place.capitalize()}\n\nFound in {_PLACES[place]}.\n"
        yield "| name | unit | symbol | formula | reading | meaning | target |\n|---|---|---|---|---|---|---|"
        for name in names:
            one = registry.quantity(name)
            texts = (
                f"`{name}`",
                one.unit,
                one.symbol,
                one.formula,
                one.reading,
                one.meaning,
                _as_target(name),
            )
            yield f"| {' | '.join(text.replace('|', '&#124;') for text in texts)} |"
        yield ""
