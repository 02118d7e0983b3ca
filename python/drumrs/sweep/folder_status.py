"""How far the sweep of a folder is, from the folder alone: it may run on other machines, or its file may be gone."""

import os
import time
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from drumrs.config import Config
from drumrs.sweep.case import is_id
from drumrs.sweep.plan import read_plan
from drumrs.sweep.runner import ENDING as RUNNER
from drumrs.sweep.runner import is_at_work
from drumrs.sweep.store import Store

# So many finished cases tell how fast cases are.
_SAMPLE = 200
# One of another machine is fresh while it is younger than two intervals between checkpoints and a minute [s].
_MINUTE = 60.0
_HOUR = 3600.0


@dataclass(frozen=True)
class Status:
    """How far a sweep is.

    Attributes
    ----------
    planned
        Cases of the last sweep in the folder; `None` where it has left no list of them.
    finished
        Those that are finished; without a list, all finished ones of the folder.
    packed
        How many of the folder's finished cases are packed.
    failed
        Ids of those that failed and are not finished.
    running
        Age of the checkpoint [s] of those that are under way, by id.
    stopped
        The same for those on which nobody works: they were stopped, or the process is no more. Of a process on
        another machine the age of the checkpoint has to tell.
    left
        Cases neither finished nor failed, those under way included; `None` where nobody knows.
    others
        Finished cases in the folder that are not of the last sweep.
    core_hours_left
        What is left at the speed of the finished cases, those under way in full [h]; `None` where nobody knows.
    """

    planned: int | None
    finished: int
    packed: int
    failed: tuple[str, ...]
    running: dict[str, float]
    stopped: dict[str, float]
    left: int | None
    others: int
    core_hours_left: float | None


def status(folder: str | Path) -> Status:
    """Tell how far the last sweep in a folder is; it may run meanwhile.

    Parameters
    ----------
    folder
        A sweep's folder, packed or not.

    Raises
    ------
    ConfigError
        Where it is not the folder of a sweep, or the list of its cases is damaged.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.sweep import status
    >>> folder = tempfile.mkdtemp()
    >>> base = drumrs.baseline().replace({"run.duration": 0.05})
    >>> outcome = drumrs.Sweep(base, {"load.fill": [0.05, 5.0]}).run(folder, progress=False)
    >>> found = status(folder)
    >>> found.planned, found.finished, len(found.failed), found.left
    (2, 1, 1, 0)
    """
    store = Store(folder)
    store.require_sweep()
    plan = read_plan(store.folder)
    intervals = {} if plan is None else dict(zip(plan["case"], plan["checkpoint_every"], strict=True))
    rows, errors, checkpoints, marks = _files(store.folder)
    packed = store.packs.ids()
    finished = rows | packed
    planned = finished | errors | checkpoints.keys() if plan is None else set(plan["case"])
    failed = errors & planned - finished
    left = planned - finished - failed
    running: dict[str, float] = {}
    stopped: dict[str, float] = {}
    for case in sorted(checkpoints.keys() - finished):
        age = _age(checkpoints[case])
        if age is None:
            continue
        works = is_at_work(store.folder / f"{case}.{RUNNER}") if case in marks else False
        if works is None:
            works = age < 2.0 * intervals.get(case, Config().run.checkpoint_every) + _MINUTE
        (running if works else stopped)[case] = age
    rest = (
        None if plan is None else float(plan.filter(plan["case"].is_in(list(left)))["particle_steps"].sum())
    )
    return Status(
        planned=None if plan is None else len(planned),
        finished=len(finished & planned),
        packed=len(packed),
        failed=tuple(sorted(failed)),
        running=running,
        stopped=stopped,
        left=None if plan is None else len(left),
        others=len(finished - planned),
        core_hours_left=_core_hours(rest, store, finished),
    )


def _files(folder: Path) -> "tuple[set[str], set[str], dict[str, os.DirEntry[str]], set[str]]":
    """Return which cases of a folder have a row, which an error, their checkpoints, and which are someone's."""
    rows: set[str] = set()
    marks: set[str] = set()
    errors: set[str] = set()
    checkpoints: dict[str, os.DirEntry[str]] = {}
    with os.scandir(folder) as entries:
        for entry in entries:
            case, _, ending = entry.name.partition(".")
            if not is_id(case):
                continue
            if ending == "parquet":
                rows.add(case)
            elif ending == "error.json":
                errors.add(case)
            elif ending == "checkpoint.bin":
                checkpoints[case] = entry
            elif ending == RUNNER:
                marks.add(case)
    return rows, errors, checkpoints, marks


def _age(file: "os.DirEntry[str]") -> float | None:
    """Return the age of a file [s], `None` where it has gone meanwhile."""
    try:
        return max(time.time() - file.stat().st_mtime, 0.0)
    except OSError:
        return None


def _core_hours(particle_steps: float | None, store: Store, finished: set[str]) -> float | None:
    """Return how long one core takes for particle-steps [h], at the speed of some finished cases."""
    if particle_steps is None:
        return None
    if particle_steps == 0.0:
        return 0.0
    # Ids are digests, so that the first of them are any.
    sample = (store.facts(case) for case in islice(sorted(finished), _SAMPLE))
    times, done = 0.0, 0.0
    for facts in sample:
        wall_time, speed = facts.get("wall_time"), facts.get("particle_steps_per_second")
        if isinstance(wall_time, float) and isinstance(speed, float):
            times, done = times + wall_time, done + wall_time * speed
    return particle_steps / done * times / _HOUR if done else None
