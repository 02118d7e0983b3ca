"""`drumrs quantities`: what drumrs measures, and under which names."""

import sys
from typing import Annotated

from cyclopts import Parameter

_WIDE = 160


def quantities(part: str = "", /, *, markdown: Annotated[bool, Parameter(negative="")] = False) -> None:
    """Print what drumrs measures: the columns of its tables and the numbers of its summaries, with units and meanings.

    Parameters
    ----------
    part
        Only what has this in its name, such as `ratio` or `power`.
    markdown
        Print the whole list as the page docs/quantities.md.
    """
    from drumrs import glossary

    if markdown:
        sys.stdout.write(glossary.page())
        return
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    shown = Table(box=None, highlight=False)
    for name in ("name", "unit", "reading", "meaning", "found in", "target"):
        shown.add_column(name, no_wrap=name in {"name", "unit"})
    for row in glossary.quantities().iter_rows(named=True):
        if part in row["name"]:
            meaning = f"{row['meaning']}{', ' if row['formula'] else ''}{row['formula']}"
            texts = (row["name"], row["unit"], row["reading"], meaning, row["found_in"], row["target"])
            shown.add_row(*map(escape, texts))
    # What goes to a file or a pipe has room for everything.
    Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE).print(shown)
