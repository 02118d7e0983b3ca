"""`drumrs reproduce`: the paper's study, from the first run to the report."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from drumrs.cli.messages import complain, note, tell_failures
from drumrs.cli.options import PATH, Jobs, check_folder
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.paper import Reproduction, ReproductionResult

_FAILED = 1
_STYLES = {"holds": "green", "holds in part": "cyan", "does not hold": "red", "undecided": "yellow"}

Flag = Annotated[bool, Parameter(negative="")]


def reproduce(
    *,
    quick: Flag = False,
    full: Flag = False,
    baffle: Flag = False,
    out: Annotated[Path, PATH] = Path("out"),
    jobs: Jobs = None,
    retry: Flag = False,
) -> int:
    """Run the paper's whole study, judge its claims, draw its figures, and write a report of one HTML file.

    The same command goes on after Ctrl-C or a power cut; what is finished is not simulated again.

    Parameters
    ----------
    quick
        Short windows, few points, power by softer springs: minutes. What that cannot decide stays undecided.
    full
        Ten seeds instead of three.
    baffle
        Instead of the study, infer the shape of the paper's baffle, whose drawing is lost, from what the text says.
    out
        Folder for report.html, summary.md, table.parquet, figures/ and runs/; with --baffle for baffle.md,
        baffle.parquet, figures/ and runs/.
    retry
        Run cases again that failed before.
    """
    from drumrs.paper import Reproduction

    if quick and full:
        raise ConfigError("--quick", problem="and --full are both given, but only one of them may be")
    if baffle and (quick or full or retry):
        raise ConfigError(
            "--baffle", problem="is given with --quick, --full or --retry, which it does not have"
        )
    check_folder(out)
    if baffle:
        return _infer_baffle(out, jobs)
    reproduction = Reproduction("quick" if quick else "full" if full else "default", out, jobs)
    _announce(reproduction)
    done = reproduction.run(retry=retry)
    _print_verdicts(done)
    print_paths([*sorted({done.table, done.summary, out / "figures"}), done.report])
    return _tell_failures(done)


def _infer_baffle(out: Path, jobs: int | None) -> int:
    from drumrs.jobs import effective_jobs
    from drumrs.paper import infer_baffle
    from drumrs.paper.baffle import Plan
    from drumrs.progress import format_duration
    from drumrs.sweep.throughput import measure_speed

    jobs, plan = effective_jobs(jobs), Plan()
    spent = format_duration(plan.cost / measure_speed(jobs))
    note(f"inference of the baffle: {plan.cost:.2g} particle-steps in all, about {spent} at most")
    found = infer_baffle(out, plan, jobs)
    height, base, tip = (f"{100.0 * length:.3g}" for length in found.best.lengths)
    sys.stdout.write(f"inferred baffle: height {height} cm, base {base} cm, tip {tip} cm\n")
    for failure in found.failures:
        complain(f"case {failure.case.id} ({failure.case.config.title}) failed: {failure.message}")
    print_paths([out / "baffle.parquet", out / "figures", out / "baffle.md"])
    return _FAILED if found.failures else 0


def _announce(reproduction: "Reproduction") -> None:
    from drumrs.progress import format_duration

    count, waiting = len(reproduction.sweep), len(reproduction.waiting)
    done = f", {count - waiting} of them settled already" if waiting < count else ""
    cores = f"{reproduction.jobs} core{'s' if reproduction.jobs > 1 else ''}"
    note(
        f"{reproduction.scale} study: {count} cases{done}, {reproduction.cost:.2g} particle-steps to do, "
        f"about {format_duration(reproduction.expected_time())} on {cores}"
    )


def _print_verdicts(done: "ReproductionResult") -> None:
    from rich.console import Console
    from rich.markup import escape

    console = Console(highlight=False)
    wide = max(map(len, _STYLES))
    for verdict in done.data.verdicts:
        shown = f"[{_STYLES[verdict.verdict]}]{verdict.verdict:<{wide}}[/]"
        # One line a claim, so that all of them fit on a screen.
        line = f"{verdict.claim:<3}  {shown}  {escape(verdict.statement)}"
        console.print(line, no_wrap=True, overflow="ellipsis")
    for picture in done.pictures:
        if picture.reason:
            sys.stdout.write(f"{picture.figure.number} is not drawn. {picture.reason}\n")


def _tell_failures(done: "ReproductionResult") -> int:
    failures = done.data.failures
    tell_failures(failures, len(done.data.sweep))
    return _FAILED if failures else 0
