"""`drumrs validate`: drums that others published, simulated anew and compared."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note, tell_failures
from drumrs.cli.options import PATH, Jobs, check_folder
from drumrs.cli.tables import print_paths

if TYPE_CHECKING:
    from drumrs.validation.study import ValidationResult

_FAILED = 1
_WIDE = 160
_STYLES = {"agrees": "green", "differs": "red", "undecided": "yellow", "shown": "dim"}

Flag = Annotated[bool, Parameter(negative="")]


def validate(
    name: Annotated[str | None, Parameter(name="NAME")] = None,
    /,
    *,
    out: Annotated[Path, PATH] = Path("out"),
    jobs: Jobs = None,
    retry: Flag = False,
) -> int:
    """Simulate drums that others published, and set their numbers beside ours.

    `tracer` is a drum of glass beads whose velocity profile was measured in three dimensions (Alizadeh et al. 2013),
    `layer` are half-full drums in two dimensions and how thick their flowing layer is (Oba & Otsuki 2024), `mill` is a
    ball mill, what friction does to its power (Cleary 2001), and its toe and shoulder beside Morrell's C-model.

    Each comparison says within what tolerance it agrees; what differs is reported, not fitted, and the page says what
    a slice of discs can and cannot match. The same command goes on after Ctrl-C or a power cut; what is finished is not
    simulated again. Takes some ten minutes on two cores.

    Parameters
    ----------
    name
        The drum: tracer, layer or mill. All three unless given.
    out
        Folder for README.md, table.parquet, figures/ and runs/.
    retry
        Run cases again that failed before.
    """
    from drumrs.validation import Validation

    check_folder(out)
    validation = Validation(out, [name] if name is not None else [], jobs)
    done = len(validation.sweep) - len(validation.waiting)
    settled = f", {done} of them settled already" if done else ""
    note(f"{len(validation.sweep)} cases{settled}, {validation.cost:.2g} particle-steps to do")
    found = validation.run(retry=retry)
    _print(found)
    print_paths([found.table, out / "figures", found.page])
    tell_failures(found.failures, len(validation.sweep))
    return _FAILED if found.failures else 0


def _print(found: "ValidationResult") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    shown = Table(box=None, highlight=False)
    for column in ("drum", "quantity", "published", "simulated", "agrees within", "verdict"):
        shown.add_column(column, no_wrap=column != "quantity")
    for name, checks in found.checks.items():
        for check in checks:
            words = (check.quantity, check.published, check.measured_text, check.tolerated_text)
            style = _STYLES[check.verdict]
            shown.add_row(name, *map(escape, words), f"[{style}]{check.verdict}[/]")
    # What goes to a file or a pipe has room for everything.
    Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE).print(shown)
