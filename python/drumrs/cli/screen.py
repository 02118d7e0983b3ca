"""`drumrs screen`: which keys of a machine matter."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note
from drumrs.cli.options import PATH, WHOLE, Jobs, check_folder
from drumrs.cli.tables import print_paths

if TYPE_CHECKING:
    from drumrs.decide import Screening, ScreeningPlan

Flag = Annotated[bool, Parameter(negative="")]
_DECLINED = 1
_WIDE = 120


def screen(
    file: Annotated[Path, PATH],
    /,
    *,
    by: Annotated[list[str] | None, Parameter(negative="")] = None,
    trajectories: Annotated[int | None, WHOLE] = None,
    points: Annotated[int | None, WHOLE] = None,
    out: Annotated[Path, PATH] = Path("out/screen"),
    jobs: Jobs = None,
    yes: Flag = False,
) -> int:
    """Find out which keys of a machine matter.

    First each key is changed on its own along trajectories through the ranges (Morris); keys that make no difference
    that can be told from noise are left out. Then the spread is shared out among the others (Sobol). The number of runs
    is said beforehand, with the time that they take, and asked for in a terminal. The same command goes on after Ctrl-C
    or a power cut; more trajectories or points add to those that are there.

    Parameters
    ----------
    file
        TOML file with `[base]`, as a sweep file has it, `[ranges]` with `key = [low, high]`, `[axes]` with choices, and
        `[screen]` with `targets`, `trajectories` and `points`.
    by
        What the keys are screened for, in place of the file's targets; may be repeated. A quantity that
        `drumrs quantities` lists, or an expression of several.
    trajectories
        How often each key is changed on its own; 10 unless given.
    points
        Points of Sobol's design, a power of 2, 64 unless given; 0 leaves it at Morris.
    out
        Folder for table.parquet, figures and runs/.
    yes
        Begin without asking.
    """
    import drumrs
    from drumrs.decide import ScreeningPlan

    check_folder(out)
    plan = ScreeningPlan.read(file, by or (), trajectories=trajectories, points=points)
    _announce(plan, jobs)
    if not yes and not _is_confirmed():
        return _DECLINED
    found = drumrs.screen(plan, out=out, jobs=jobs)
    for each in found:
        _print(each)
    print_paths([out / "table.parquet", *sorted(out.glob("screening*.png"))])
    return 0


def _announce(plan: "ScreeningPlan", jobs: int | None) -> None:
    from drumrs.jobs import effective_jobs
    from drumrs.progress import format_duration
    from drumrs.sweep.throughput import measure_speed

    count = effective_jobs(jobs)
    spent = format_duration(plan.cost / measure_speed(count))
    further = f", then at most {plan.most_runs - plan.first_runs} for Sobol's indices" if plan.points else ""
    note(
        f"{', '.join(plan.space.keys)}: {plan.first_runs} runs for Morris's effects{further}; {plan.cost:.2g} "
        f"particle-steps in all, about {spent} at most on {count} core{'s' if count > 1 else ''}"
    )


def _is_confirmed() -> bool:
    """Ask in a terminal whether to begin; elsewhere nobody can answer."""
    if not sys.stdin.isatty():
        return True
    sys.stderr.write("begin? [Y/n] ")
    sys.stderr.flush()
    return sys.stdin.readline().strip().lower() in {"", "y", "yes"}


def _print(found: "Screening") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    shown = Table(box=None, highlight=False)
    for column in ("key", f"effect on {found.target.label}", "of which noise", "by itself", "in all"):
        shown.add_column(escape(column), justify="left" if column == "key" else "right")
    for factor in found.factors:
        effect = factor.effect
        shares = [
            "–" if share is None else f"{100.0 * share.mean:.0f} ± {100.0 * share.half_width:.0f} %"
            for share in (factor.first, factor.total)
        ]
        cells = (factor.key, f"{effect.mean:+.3g}", f"{effect.floor:.2g}", *shares)
        shown.add_row(*map(escape, cells), style="dim" if effect.is_dead else None)
    console = Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE)
    console.print(shown)
    for sentence in found.sentences:
        console.print(sentence, markup=False, soft_wrap=True)
