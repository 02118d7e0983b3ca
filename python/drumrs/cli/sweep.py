"""`drumrs sweep`: the cases of a sweep file, each run once."""

import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from drumrs.cli.messages import tell_failures
from drumrs.cli.options import PATH, WHOLE, Jobs, check_folder
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError
from drumrs.registry import quantity
from drumrs.result import number, with_error
from drumrs.sweep import Case, Outcome, Sweep, read_sweep
from drumrs.sweep.plan import planned_case
from drumrs.sweep.scheduler import RunOptions, run_cases

_FAILED = 1
# Columns of the table that are keys under another name.
_KEYS = {"seed": "run.seed"}
# What is printed of each run; the table has more.
_POWER, _RATIO = "drum_specific_power", "dissipation_ratio"
_HEAD_WIDTH = 14
_MOST_ROWS = 40
_MOST_COLUMNS = 6
_WIDE = 160


def sweep(
    file: Path,
    /,
    *,
    out: Annotated[Path | None, PATH] = None,
    jobs: Jobs = None,
    shard: str | None = None,
    case: Annotated[list[str] | None, Parameter(negative="")] = None,
    plan: Annotated[bool, Parameter(negative="")] = False,
    retry: Annotated[bool, Parameter(negative="")] = False,
    seeds: Annotated[int | None, WHOLE] = None,
) -> int:
    """Run the cases of a sweep file that are not finished yet, and write the table of all that are.

    The file has `[base]`, keys of `drumrs config` laid over the baseline, or over the case file that its key `file`
    names (`base = "case.toml"` is short for that alone); `[axes]`, a list of values for each key to vary, every
    combination of which is a case; and `seeds`, a list of seeds or their number. The same command goes on after Ctrl-C,
    a power cut or a change of the file; what is finished is not simulated again. Of every case the series is kept, by
    `run.sample_every`, and the frames where `run.frame_every` is smaller than `run.duration`.

    The table that is printed begins with the case's id, as short as tells the cases of the folder apart; W/kg is the
    power over the load's mass, N/T the power that goes into normal contacts over that into tangential ones. Where a
    run has not settled, "drifting" stands behind its numbers. `drumrs view OUT/ID` plays a case that kept frames.

    On a cluster, a job array takes `--shard`; a workflow engine takes the ids from `--plan` and runs each with
    `--case`, any number at the same time on machines that see the folder. `drumrs status OUT` tells how far all of it
    is, `drumrs pack OUT` puts many files into few.

    Parameters
    ----------
    file
        TOML file with `[base]`, `[axes]` and `seeds`.
    out
        Folder of the results: a few files a case, and table.parquet.
    shard
        K/N runs the K-th of N equal parts, for job arrays; who finds all cases settled writes the table.
    case
        Run only the case with this id, or beginning of an id; may be repeated. It is kept as OUT/ID.parquet and others;
        where that is there, nothing is done. Writes no table: `drumrs sweep` without it does, once all are finished.
    plan
        Run nothing, and print a line a case: its id and the keys that vary, with tabs between them. With `--out`, each
        case's file is written as OUT/ID.toml, so that `--case` need not make all cases to find one.
    retry
        Run cases again that failed before.
    seeds
        Number of seeds for every combination, instead of the file's: 0 … N − 1.
    """
    if plan and (case or shard or retry):
        raise ConfigError("--plan", problem="runs nothing, so --case, --shard and --retry do not go with it")
    if case and shard:
        raise ConfigError("--case", case[0], "given without --shard")
    if plan:
        return _plan(read_sweep(file, seeds), out)
    if out is None:
        raise ConfigError("--out", problem="is missing", hint="give the folder of the results: --out FOLDER")
    check_folder(out)
    if case:
        return _run_cases(file, out, case, seeds, RunOptions(jobs=jobs, retry=retry, whole=False))
    part = _shard(shard)
    planned = read_sweep(file, seeds)
    outcome = planned.run(out, jobs=jobs, shard=part, retry=retry)
    if outcome.left:
        sys.stdout.write(
            f"{outcome.left} cases are left to the other shards; the last one writes the table\n"
        )
    else:
        path = planned.write_table()
        _print_results(planned)
        print_paths([path])
    _tell_failures(planned, outcome)
    return _FAILED if outcome.failures else 0


def _plan(planned: Sweep, out: Path | None) -> int:
    """Print the cases, and write them where a folder is given."""
    if out is not None:
        check_folder(out)
        planned.write_plan(out)
    for one, settings in planned.settings().items():
        words = (f"{_KEYS.get(key, key)}={value}" for key, value in settings.items() if value is not None)
        sys.stdout.write("\t".join([one, *words]) + "\n")
    return 0


def _run_cases(file: Path, out: Path, wanted: list[str], seeds: int | None, options: RunOptions) -> int:
    """Run some cases, beside others that run the rest at the same time."""
    # The file that --plan has left of a case spares making all others, which takes a millisecond each.
    cases = [found for one in wanted if (found := planned_case(out, one)) is not None]
    if len(cases) < len(wanted):
        cases = _chosen(read_sweep(file, seeds), file, wanted)
    outcome = run_cases(cases, out, options)
    failed = {failure.case.id for failure in outcome.failures}
    sys.stdout.writelines(f"{case.id} is finished\n" for case in cases if case.id not in failed)
    tell_failures(outcome.failures, len(cases))
    return _FAILED if outcome.failures else 0


def _chosen(planned: Sweep, file: Path, wanted: list[str]) -> list[Case]:
    chosen: dict[str, Case] = {}
    for one in wanted:
        found = [case for case in planned.cases if one and case.id.startswith(one)]
        if len(found) != 1:
            limit = f"the id of one case of {file}, or its beginning"
            problem = f"is {one!r}, but must be {limit}: {len(found)} of {len(planned)} cases have such an id"
            raise ConfigError("--case", one, limit, problem=problem, hint="--plan lists them")
        chosen[found[0].id] = found[0]
    return list(chosen.values())


def _shard(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    part, _, parts = text.partition("/")
    if not (part.isdecimal() and parts.isdecimal()):
        raise ConfigError("--shard", text, "K/N with 1 <= K <= N")
    return int(part), int(parts)


def _print_results(planned: Sweep) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    found = planned.table().collect()
    varied = planned.varied()[:_MOST_COLUMNS]
    shown = Table(box=None, highlight=False)
    shown.add_column("case", no_wrap=True)
    results = (textwrap.fill(quantity(name).label, _HEAD_WIDTH) for name in (_POWER, _RATIO))
    for name in (*_short(varied), *results, ""):
        shown.add_column(escape(name), justify="right", no_wrap=True)
    ids = planned.short_ids()
    for row in found.head(_MOST_ROWS).iter_rows(named=True):
        shown.add_row(ids[row["case"]], *(escape(_show(row[key])) for key in varied), *_numbers(row))
    # What goes to a file or a pipe has room for everything.
    Console(highlight=False, width=None if sys.stdout.isatty() else _WIDE).print(shown)
    if found.height > _MOST_ROWS:
        sys.stdout.write(f"… and {found.height - _MOST_ROWS} more\n")


def _short(keys: list[str]) -> list[str]:
    """Return the ends of dotted keys, two parts at least, as short as tells them apart."""

    def ends(key: str) -> Iterator[str]:
        parts = key.split(".")
        return (".".join(parts[-length:]) for length in range(min(2, len(parts)), len(parts) + 1))

    return [
        next(
            end
            for end in ends(key)
            if end == key or sum(f".{other}".endswith(f".{end}") for other in keys) == 1
        )
        for key in keys
    ]


def _numbers(row: dict[str, Any]) -> tuple[str, str, str]:
    """Return specific power, N/T, and whether they drift."""
    power = with_error(row[_POWER], row[f"{_POWER}_error"])
    return power, number(row[_RATIO]), "drifting" if row["drifting"] else ""


def _show(value: Any) -> str:
    return "–" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def _tell_failures(planned: Sweep, outcome: Outcome) -> None:
    if not outcome.failures:
        return
    settings = planned.settings()
    failed = [settings[failure.case.id] for failure in outcome.failures]
    names = [", ".join(f"{key} = {_show(value)}" for key, value in each.items()) for each in failed]
    tell_failures(outcome.failures, len(planned), names)
