"""`drumrs optimize`: the best values of a few keys."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from drumrs.cli.messages import note
from drumrs.cli.options import PATH, Jobs, check_folder
from drumrs.cli.tables import print_paths

if TYPE_CHECKING:
    from drumrs.decide import Optimization

_WIDE = 160


def optimize(
    file: Path,
    /,
    *,
    out: Annotated[Path, PATH] = Path("out/optimize"),
    jobs: Jobs = None,
) -> int:
    """Find the best values of up to six keys, for one or two targets, under constraints.

    The file has `[base]` as that of `drumrs sweep`; `[ranges]`, keys with `[low, high]` each; `[axes]`, keys with
    values to choose from; and `[optimize]`: `minimize` and `maximize`, targets as `drumrs compare --by` takes them, one
    or two in all; `subject_to`, a list such as `"falls_per_turn >= 0.5"`; `tolerance`, the gain that is not worth
    another run (`"1 %"`); `runs`, how many there are at most; `batch`, how many are planned together; `confirm`, the
    number of fresh seeds on which the best are run again.

    The search ends where a further gain of more than the tolerance is less likely than 5 %. The same command goes on
    after Ctrl-C or a power cut, with the same points; what is finished is not simulated again.

    Parameters
    ----------
    file
        TOML file with `[base]`, `[ranges]`, `[axes]` and `[optimize]`.
    out
        Folder for history.parquet, optimization.png, best.toml (the winner as a case file) and runs/.
    """
    import drumrs
    from drumrs.decide import Problem

    check_folder(out)
    problem = Problem.read(file)
    goals = ", ".join(map(str, problem.goals))
    note(f"{goals}; keys: {', '.join(problem.space.keys)}; {problem.runs} runs at most")
    found = drumrs.optimize(problem, out, jobs=jobs)
    _print(found)
    print_paths([out / name for name in ("history.parquet", "optimization.png", "best.toml")])
    return 0


def _print(found: "Optimization") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from drumrs.result import with_error

    shown = Table(box=None, highlight=False)
    for key in found.problem.space.keys:
        shown.add_column(escape(key), justify="right")
    for goal in found.problem.goals:
        for when in ("expected", "on fresh seeds"):
            shown.add_column(escape(f"{goal.target.label}, {when}"), justify="right")
    for one in found.confirmed:
        pairs = zip(one.expected, one.fresh, strict=True)
        numbers = [(with_error(*expected), with_error(fresh.mean, fresh.error)) for expected, fresh in pairs]
        shown.add_row(
            *(escape(str(value)) for value in one.values.values()),
            *(text for pair in numbers for text in pair),
        )
    # What goes to a file or a pipe has room for everything.
    console = Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE)
    console.print(shown)
    console.print(found.sentence, markup=False, soft_wrap=True)
