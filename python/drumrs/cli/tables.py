"""What several commands print: summaries side by side, paths written."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.result import Summary

if TYPE_CHECKING:
    import polars as pl


def print_table(summaries: dict[str, Summary]) -> None:
    """Print summaries, a column each."""
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    columns = [summary.rows() for summary in summaries.values()]
    table = Table(box=None, show_header=len(summaries) > 1, highlight=False)
    table.add_column("")
    for name in summaries:
        table.add_column(name, justify="right", no_wrap=True)
    for label in columns[0]:
        table.add_row(escape(label), *(column[label] for column in columns))
    Console(highlight=False).print(table)


def print_phases(phases: "pl.DataFrame") -> None:
    """Print a program's phases, a row for each name: how often it came, time, work, mean power."""
    import polars as pl
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    spent = pl.col("end") - pl.col("start")
    work = pl.col("phase_specific_work").sum()
    rows = phases.group_by("phase", maintain_order=True).agg(
        number=pl.len(), time=spent.sum(), work=work, power=work / spent.sum()
    )
    table = Table(box=None, highlight=False)
    for label in ("phase", "times", "time [s]", "work [J/kg]", "power [W/kg]"):
        table.add_column(escape(label), justify="left" if label == "phase" else "right")
    for name, *numbers in rows.iter_rows():
        table.add_row(escape(name), *(f"{number:.4g}" for number in numbers))
    Console(highlight=False).print(table)


def print_species(species: "pl.DataFrame") -> None:
    """Print who has how much of the load and of its energy of motion, a row for each species."""
    import polars as pl
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    mass, energy = pl.col("load_mass"), pl.col("kinetic_translation")
    # A load at rest has nothing to share.
    share = pl.when(energy.sum() > 0.0).then(energy / energy.sum()).otherwise(0.0)
    shares = {
        "mass_share": 100.0 * mass / mass.sum(),
        "specific": energy / mass,
        "energy_share": 100.0 * share,
    }
    rows = species.select("species", "bundle_count", "load_mass", **shares)
    table = Table(box=None, highlight=False)
    for label in ("species", "bundles", "mass [kg/m]", "[%]", "kinetic energy [J/kg]", "[%]"):
        table.add_column(escape(label), justify="left" if label == "species" else "right")
    for name, *numbers in rows.iter_rows():
        table.add_row(escape(name), *(f"{number:.4g}" for number in numbers))
    Console(highlight=False).print(table)


def print_paths(paths: Sequence[Path]) -> None:
    """Say which files were written: those of the list that are there, for a picture may have failed."""
    for path in filter(Path.exists, paths):
        sys.stdout.write(f"wrote {path}\n")
