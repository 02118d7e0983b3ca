"""What several commands print: summaries side by side, paths written."""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

from drumrs.result import Summary


def print_table(summaries: dict[str, Summary]) -> None:
    """Print summaries, a column each."""
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    columns = [_rows(summary) for summary in summaries.values()]
    table = Table(box=None, show_header=len(summaries) > 1, highlight=False)
    table.add_column("")
    for name in summaries:
        table.add_column(name, justify="right", no_wrap=True)
    for label in columns[0]:
        table.add_row(escape(label), *(column[label] for column in columns))
    Console(highlight=False).print(table)


def _rows(summary: Summary) -> dict[str, str]:
    """Return what the table shows of a summary, by label."""
    window = f"{summary.window_start:.4g}–{summary.window_end:.4g}"
    x, y = (f"{1e3 * value:.1f}" for value in summary.center_of_mass)
    return {
        "bundles": str(summary.bundle_count),
        "averages over t = [s]": window,
        "specific power [W/kg]": with_error(summary.specific_power, summary.specific_power_error),
        "drum power [W/m]": number(summary.drum_power),
        "torque [N m/m]": number(summary.drum_torque),
        "normal / tangential power": number(summary.normal_tangential_ratio),
        "center of mass [mm]": f"({x}, {y})",
        "contacts per bundle": number(summary.coordination),
        "greatest overlap / radius": number(summary.max_overlap_ratio),
        "energy residual": f"{summary.energy_residual:.1e}",
        "disagreement of three powers": f"{summary.power_disagreement:.1e}",
        "wall time [s]": f"{summary.wall_time:.1f}",
        "million particle-steps per second": number(summary.particle_steps_per_second, 1e-6),
    }


def number(value: float | None, scale: float = 1.0) -> str:
    """Show a value to four digits, a dash where there is none."""
    return "–" if value is None else f"{scale * value:.4g}"


def with_error(value: float, error: float | None) -> str:
    """Show a value with its standard error, both to the error's second digit."""
    if not error:
        return number(value)
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def print_paths(paths: Sequence[Path]) -> None:
    """Say which files were written."""
    for path in paths:
        sys.stdout.write(f"wrote {path}\n")
