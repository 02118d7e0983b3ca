"""`drumrs verify`: the proof, run by whoever wants to know."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from drumrs.cli.options import PATH, Jobs, check_folder
from drumrs.cli.tables import print_paths

if TYPE_CHECKING:
    from drumrs.verification import Trial, Verification

_FAILED = 1
# Width of the table without its sources, and one that holds them in full, in characters.
_NUMBERS = 96
_WIDE = 172


def verify(
    *,
    only: Annotated[
        list[str] | None, Parameter(negative="", help="Name of a case to run; may be repeated.")
    ] = None,
    html: Annotated[Path | None, PATH] = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    jobs: Jobs = None,
) -> int:
    """Hold drumrs against formulas, identities and its own promises, and print what came of it.

    Each case compares measured numbers with expected ones, within a tolerance that follows from the order of the
    scheme; of each the table shows the number that is nearest to failing, or fails by most. Takes a minute or two. The
    exit status is 1 where a case fails.

    Parameters
    ----------
    html
        File of a page with a plot a case.
    json
        Print one JSON object with every number instead of the table.
    """
    from drumrs.verification import verify as run

    if html is not None:
        from drumrs.pages import check_page

        check_page(html, "--html")
        check_folder(html.parent, "--html")
    found = run(only, jobs=jobs)
    if html is not None:
        html.parent.mkdir(parents=True, exist_ok=True)
        found.save(html)
    if json:
        sys.stdout.write(f"{found.to_json()}\n")
    else:
        _print(found)
        print_paths([html] if html is not None else [])
    return 0 if found.passed else _FAILED


def _print(found: "Verification") -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from drumrs.progress import format_duration

    # A file or a pipe takes the full width.
    console = Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE)
    shown = Table(box=None, highlight=False)
    shown.add_column("test", no_wrap=True)
    shown.add_column("source", no_wrap=True, overflow="ellipsis", max_width=max(console.width - _NUMBERS, 8))
    for name in ("expected", "measured", "tolerance"):
        shown.add_column(name, justify="right", no_wrap=True, min_width=len(name))
    shown.add_column("unit", no_wrap=True, min_width=len("unit"))
    shown.add_column("verdict", no_wrap=True, min_width=len("verdict"))
    for trial in found.trials:
        verdict = "[green]passed[/]" if trial.passed else "[red]failed[/]"
        shown.add_row(trial.case.name, escape(trial.case.source), *_numbers(trial), verdict)
    console.print(shown)
    for trial in found.failures:
        sys.stdout.write(f"{trial.case.name} failed: {_reason(trial)}\n")
    count = len(found.trials)
    passed = count - len(found.failures)
    sys.stdout.write(f"{passed} of {count} cases passed, in {format_duration(found.wall_time)}\n")


def _numbers(trial: "Trial") -> tuple[str, str, str, str]:
    """Return expected, measured, tolerance and unit of the check that is nearest to failing."""
    if trial.evidence is None:
        return ("–",) * 4
    worst = trial.evidence.worst
    return f"{worst.expected:.6g}", f"{worst.measured:.6g}", f"{worst.tolerance:.2g}", worst.unit


def _reason(trial: "Trial") -> str:
    if trial.evidence is None:
        return trial.error or "no reason given"
    worst, failed = trial.evidence.worst, sum(not check.passed for check in trial.evidence.checks)
    unit = "" if worst.unit == "1" else f" {worst.unit}"
    return (
        f"{failed} of {len(trial.evidence.checks)} numbers, worst the {worst.quantity}: {worst.measured:.6g}{unit}, "
        f"expected {worst.expected:.6g} ± {worst.tolerance:.2g}"
    )
