"""What several commands print: summaries side by side, paths written."""

import sys
from collections.abc import Sequence
from pathlib import Path

from drumrs.result import Summary


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


def print_paths(paths: Sequence[Path]) -> None:
    """Say which files were written."""
    for path in paths:
        sys.stdout.write(f"wrote {path}\n")
