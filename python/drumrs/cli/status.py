"""`drumrs status`: how far a sweep is."""

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.sweep import Status
from drumrs.sweep import status as status_of

_FAILED = 1
_LEFT = 4
_MOST_NAMED = 10


def status(out: Path, /, *, json_: Annotated[bool, Parameter(name="--json", negative="")] = False) -> int:
    """Tell how far the sweep of a folder is: on whatever machine it runs, while it runs and afterwards.

    Cases are finished, failed, or left. Of those left, the ones with a checkpoint have been begun: while it is fresh,
    younger than two `run.checkpoint_every` and a minute, somebody works on the case; an older one was left behind, and
    the case goes on from there once the sweep is run again. The first checkpoint comes after `run.checkpoint_every`, so
    that cases which take less are never seen under way. Core-hours left are those of one core at the speed of the
    finished cases; what those under way have done is not taken off.

    Counted is the last sweep that was run or planned in the folder, whose list of cases is there (plan.parquet); the
    sweep file is not needed.

    Exit status: 0, all cases are finished; 1, some failed and the others are finished; 4, cases are left; 2, it is not
    the folder of a sweep.

    Parameters
    ----------
    out
        Folder of the sweep, packed or not.
    json_
        Print an object with all numbers and with the ids of cases that failed, are under way or were left behind.
    """
    found = status_of(out)
    if json_:
        sys.stdout.write(f"{json.dumps(asdict(found), indent=2)}\n")
    else:
        sys.stdout.writelines(f"{line}\n" for line in _lines(found))
    if found.left or found.running or found.stopped:
        return _LEFT
    return _FAILED if found.failed else 0


def _lines(found: Status) -> list[str]:
    """Say it in words."""
    of = "" if found.planned is None else f" of {found.planned}"
    lines = [f"{found.finished}{of} cases are finished"]
    if found.packed:
        lines.append(f"{found.packed} finished cases are packed")
    if found.others:
        lines.append(f"{found.others} finished cases are of other sweeps")
    lines += _named(dict.fromkeys(found.failed, ""), "failed, see ID.error.json")
    lines += _named({case: _ago(age) for case, age in found.running.items()}, "under way")
    lines += _named(
        {case: _ago(age) for case, age in found.stopped.items()},
        "stopped, and go on from there when run again",
    )
    if found.left is None:
        lines.append("how many are left is not known here: the folder has no list of a sweep's cases")
    else:
        lines.append(f"{found.left} left{_hours(found)}")
    return lines


def _hours(found: Status) -> str:
    if not found.left:
        return ""
    return "" if found.core_hours_left is None else f", {found.core_hours_left:.3g} core-hours"


def _named(cases: dict[str, str], what: str) -> list[str]:
    """Count cases, and name the first few."""
    if not cases:
        return []
    named = [f"  {case}{words}" for case, words in list(cases.items())[:_MOST_NAMED]]
    more = [f"  … and {len(cases) - _MOST_NAMED} more"] if len(cases) > _MOST_NAMED else []
    return [f"{len(cases)} {what}", *named, *more]


def _ago(age: float) -> str:
    return f", checkpoint {age:.0f} s old"
