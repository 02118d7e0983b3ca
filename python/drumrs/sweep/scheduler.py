"""The scheduler: which cases are to be run, in which order, and what becomes of them."""

import logging
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from drumrs.errors import ConfigError
from drumrs.files import NO_ROOM
from drumrs.progress import Task
from drumrs.sweep.case import Case
from drumrs.sweep.executors import Workers, open_workers
from drumrs.sweep.plan import write_plan
from drumrs.sweep.store import Store
from drumrs.sweep.worker import CaseOutcome

_LOG = logging.getLogger("drumrs.sweep")
# How often progress is shown; a Ctrl-C is seen at once.
_TICK = 0.25
_MOST_NAMED = 10
# Reading what is finished takes seconds from so many cases on, and is shown.
_MANY = 500


@dataclass(frozen=True)
class Failure:
    """A case that failed: its error's class and sentence."""

    case: Case
    error: str
    message: str


@dataclass(frozen=True)
class Outcome:
    """What a sweep has come to.

    Attributes
    ----------
    folder
        Where the results are.
    finished
        Cases with results, from this run or an earlier one.
    computed
        Cases that this run has simulated.
    failures
        Cases without results that have an error, from this run or an earlier one.
    left
        Cases left to other shards and not settled yet.
    replaced
        Sentences on damaged or foreign files that were found and computed anew.
    """

    folder: Path
    finished: int
    computed: int
    failures: tuple[Failure, ...]
    left: int
    replaced: tuple[str, ...]


@dataclass(frozen=True)
class RunOptions:
    """How to run a sweep: the arguments of `Sweep.run`, and whether it is whole."""

    executor: Executor | str | None = None
    jobs: int | None = None
    shard: tuple[int, int] | None = None
    retry: bool = False
    progress: bool = True
    # Whether these are all cases of the sweep: the folder then gets their list, and is cleared of what was left behind.
    whole: bool = True


@dataclass
class _Tally:
    """What is known of the cases, by id."""

    finished: set[str] = field(default_factory=set)
    failed: dict[str, Failure] = field(default_factory=dict)
    replaced: list[str] = field(default_factory=list)
    computed: int = 0
    settled: int = 0
    cost: float = 0.0


def run_cases(cases: Sequence[Case], folder: Path, options: RunOptions) -> Outcome:
    """Run what is not finished yet, long cases first.

    Raises
    ------
    ConfigError
        Where an option or the folder is not accepted; nothing has been simulated then.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.
    """
    ordered = sorted(cases, key=lambda case: (-case.cost, case.id))
    mine = shard_of(ordered, options.shard)
    store, tally = Store(folder), _Tally()
    with _say_what_is_kept(store, tally), open_workers(options.executor, options.jobs) as workers:
        store.open(tidy=options.whole)
        if options.whole:
            write_plan(folder, cases)
        show = options.progress and len(mine) >= _MANY
        with Task("looking for finished cases", len(mine), "cases", show=show) as task:
            waiting = []
            for case in mine:
                if _is_waiting(case, store, tally, retry=options.retry):
                    waiting.append(case)
                task.advance()
        with _task(waiting, tally, show=options.progress) as task:
            _name_replaced(tally.replaced, task)
            _schedule(waiting, workers, store, tally, task)
    own = {case.id for case in mine}
    left = [case for case in ordered if case.id not in own and not store.is_settled(case)]
    return Outcome(
        folder=folder,
        finished=len(tally.finished),
        computed=tally.computed,
        failures=tuple(tally.failed[case.id] for case in cases if case.id in tally.failed),
        left=len(left),
        replaced=tuple(tally.replaced),
    )


def _task(waiting: Sequence[Case], tally: _Tally, *, show: bool) -> Task:
    settled = len(tally.finished) + len(tally.failed)
    label = f"sweep, {settled} cases settled before" if settled else "sweep"
    cost = sum(case.cost for case in waiting)
    return Task(
        label, cost, "particle-steps", detail=f"0 of {len(waiting)} cases", show=show and bool(waiting)
    )


def _name_replaced(sentences: Sequence[str], task: Task) -> None:
    for sentence in sentences[:_MOST_NAMED]:
        task.note(f"{sentence}; it is computed again")
    if len(sentences) > _MOST_NAMED:
        task.note(f"… and {len(sentences) - _MOST_NAMED} more are computed again")


@contextmanager
def _say_what_is_kept(store: Store, tally: _Tally) -> Iterator[None]:
    """Say, where a sweep is broken off, what is kept and how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        count = len(tally.finished)
        raise KeyboardInterrupt(
            f"interrupted; {count} cases are finished and kept, and the same sweep goes on with the others"
        ) from None
    except OSError as error:
        if error.errno not in NO_ROOM:
            raise
        told = OSError(
            f"cannot write to {str(store.folder)!r}: {error.strerror}; {len(tally.finished)} cases are finished and "
            "kept, and the same sweep goes on with the others once there is room"
        )
        told.errno = error.errno
        raise told from None


def shard_of(ordered: Sequence[Case], shard: tuple[int, int] | None) -> list[Case]:
    """Return every n-th case from the k-th on, so that each shard has its part of the long ones.

    Raises
    ------
    ConfigError
        Where `shard` is no pair (k, n) with 1 <= k <= n.
    """
    if shard is None:
        return list(ordered)
    part, parts = shard
    if not 1 <= part <= parts:
        raise ConfigError("shard", f"{part}/{parts}", "k/n with 1 <= k <= n")
    return list(ordered[part - 1 :: parts])


def _is_waiting(case: Case, store: Store, tally: _Tally, *, retry: bool) -> bool:
    """Enter what is known of a case, and tell whether it is to be run."""
    store.require_names(case)
    fault = store.fault(case)
    error = None if retry else store.error(case)
    if fault is None:
        tally.finished.add(case.id)
    elif error is not None:
        tally.failed[case.id] = Failure(case, str(error.get("error")), str(error.get("message")))
    elif fault:
        tally.replaced.append(fault)
    return fault is not None and error is None


def _schedule(waiting: Sequence[Case], workers: Workers, store: Store, tally: _Tally, task: Task) -> None:
    """Keep the workers busy until every case is settled."""
    queue = iter(waiting)
    in_flight: dict[Future[CaseOutcome], Case] = {}
    try:
        while True:
            while len(in_flight) < workers.limit and (case := next(queue, None)) is not None:
                in_flight[workers.submit(case, str(store.folder))] = case
            if not in_flight:
                return
            done, _ = wait(in_flight, timeout=_TICK, return_when=FIRST_COMPLETED)
            for future in done:
                case = in_flight.pop(future)
                _count(case, _outcome_of(future, case, store), tally)
            cost = tally.cost + workers.particle_steps()
            task.update(cost, f"{tally.settled} of {len(waiting)} cases")
    except BaseException:
        for future in in_flight:
            future.cancel()
        workers.stop()
        raise


def _outcome_of(future: "Future[CaseOutcome]", case: Case, store: Store) -> CaseOutcome:
    """Return what the worker reports, or that it was lost with the case."""
    try:
        told = future.result()
    except (OSError, BrokenExecutor):
        raise
    except Exception as error:  # noqa: BLE001 - executors say in classes of their own that a worker died
        store.write_error(case, error)
        return CaseOutcome(case.id, "failed", type(error).__name__, str(error))
    if told.case != case.id:
        problem = "has workers with another version of drumrs, but must have workers with this one"
        raise ConfigError("executor", problem=problem)
    return told


def _count(case: Case, told: CaseOutcome, tally: _Tally) -> None:
    level = logging.WARNING if told.status == "failed" else logging.INFO
    fields = told._asdict()
    fields["reason"] = fields.pop("message")
    _LOG.log(level, "case %s %s", case.id, told.status, extra={"fields": fields})
    tally.settled += 1
    tally.cost += case.cost
    if told.status == "finished":
        tally.computed += 1
        tally.finished.add(case.id)
        tally.failed.pop(case.id, None)
    elif told.status == "failed":
        tally.failed[case.id] = Failure(case, told.error, told.message)
