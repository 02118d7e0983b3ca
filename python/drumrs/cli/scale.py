"""`drumrs scale`: a machine of another size, the groups that this changes, and the laws that are known."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from drumrs.cli.options import NUMBER, PATH, Settings, layered
from drumrs.cli.tables import print_paths
from drumrs.files import write_whole

if TYPE_CHECKING:
    from rich.table import Table

    from drumrs.config import Config

_WIDE = 120


def scale(
    case: Annotated[Path | None, PATH] = None,
    /,
    *,
    factor: Annotated[float, NUMBER],
    keep: Literal["groups", "bundle"] = "groups",
    out: Annotated[Path | None, PATH] = None,
    set_: Settings = None,
) -> None:
    """Make a machine larger or smaller, and say which dimensionless groups that changes.

    Froude number and fill stay. `--keep groups` lets bundles, stiffness, adhesion and time step follow, so that the
    motion is the same; `--keep bundle` fills the larger drum with more of the same bundles. Beside the groups stand
    the laws by which what is measured goes with the size, and the speeds that other rules ask for.

    Parameters
    ----------
    case
        Case file; the baseline without it.
    factor
        What the drum's lengths are multiplied with.
    keep
        What is kept: all groups, or the bundle.
    out
        Case file to write; none is written without it.
    """
    before = layered(case, set_, None)
    after = before.scaled(factor, keep)
    _print(before, after, factor)
    if out is not None:
        write_whole(out, after.to_toml().encode())
        print_paths([out])


def _print(before: "Config", after: "Config", factor: float) -> None:
    from rich.console import Console

    from drumrs.decide import LAWS, groups, speed_rules

    # What goes to a file or a pipe has room for everything.
    console = Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE)
    console.print(f"from {before.title}\nto   {after.title}\n", markup=False, soft_wrap=True)
    shown = _table("group", "", "before", "after", "")
    for group in groups(before, after):
        kept = "[dim]kept[/]" if group.is_kept else "[yellow]changes[/]"
        shown.add_row(group.name, group.symbol, f"{group.before:.4g}", f"{group.after:.4g}", kept)
    console.print(shown)
    laws = _table("goes with the size", "power of D", "× here", "")
    for law in LAWS:
        laws.add_row(law.name, f"{law.power:g}", f"{factor**law.power:.4g}", law.holds)
    console.print()
    console.print(laws)
    rules = _table("speed by the rule", "rpm")
    for rule in speed_rules(before, after):
        rules.add_row(rule.name, f"{rule.rpm:.4g}")
    console.print()
    console.print(rules)


def _table(*columns: str) -> "Table":
    from rich.table import Table

    table = Table(box=None, highlight=False)
    for number, column in enumerate(columns):
        table.add_column(column, justify="left" if not number or not column else "right", no_wrap=True)
    return table
