"""The engine: which cases are to be run, in which order, and what becomes of them."""

from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from drumrs.errors import ConfigError
from drumrs.files import NO_ROOM
from drumrs.progress import Board, Campaign, board
from drumrs.sweep.case import Case
from drumrs.sweep.crew import Crew, crew
from drumrs.sweep.store import Store
from drumrs.sweep.worker import Report

# How often progress is shown; a Ctrl-C is seen at once.
_TICK = 0.25
_MOST_NAMED = 10


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
class Order:
    """How to run: who, how many at once, which part, whether to try failed cases again."""

    executor: Executor | str | None = None
    jobs: int | None = None
    shard: tuple[int, int] | None = None
    retry: bool = False
    progress: bool = True


@dataclass
class _Tally:
    """What is known of the cases, by id."""

    finished: set[str] = field(default_factory=set)
    failed: dict[str, Failure] = field(default_factory=dict)
    replaced: list[str] = field(default_factory=list)
    computed: int = 0
    settled: int = 0
    cost: float = 0.0


def run_cases(cases: Sequence[Case], folder: Path, order: Order) -> Outcome:
    """Run what is not finished yet, long cases first.

    Raises
    ------
    ConfigError
        Where the order or the folder is not accepted; nothing has been simulated then.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.
    """
    ordered = sorted(cases, key=lambda case: (-case.cost, case.id))
    mine = shard_of(ordered, order.shard)
    store, tally = Store(folder), _Tally()
    with _clear_words(store, tally), crew(order.executor, order.jobs) as workers:
        store.open()
        waiting = _take_stock(mine, store, tally, retry=order.retry)
        with board(show=order.progress) as shown:
            _name_replaced(tally.replaced, shown)
            _hand_out(waiting, workers, store, tally, shown)
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


def _name_replaced(sentences: Sequence[str], shown: Board) -> None:
    for sentence in sentences[:_MOST_NAMED]:
        shown.note(f"{sentence}; it is computed again")
    if len(sentences) > _MOST_NAMED:
        shown.note(f"… and {len(sentences) - _MOST_NAMED} more are computed again")


@contextmanager
def _clear_words(store: Store, tally: _Tally) -> Iterator[None]:
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


def _take_stock(cases: Sequence[Case], store: Store, tally: _Tally, *, retry: bool) -> list[Case]:
    """Enter what is known of the cases, and return those to be run."""
    waiting = []
    for case in cases:
        store.require_names(case)
        fault = store.fault(case)
        error = None if retry else store.error(case)
        if fault is None:
            tally.finished.add(case.id)
        elif error is not None:
            tally.failed[case.id] = Failure(case, str(error.get("error")), str(error.get("message")))
        else:
            waiting.append(case)
            if fault:
                tally.replaced.append(fault)
    return waiting


def _hand_out(waiting: Sequence[Case], workers: Crew, store: Store, tally: _Tally, shown: Board) -> None:
    """Keep the crew busy until every case is settled."""
    report = shown.add_campaign(Campaign(len(waiting), sum(case.cost for case in waiting)))
    queue = iter(waiting)
    flying: dict[Future[Report], Case] = {}
    try:
        while True:
            while len(flying) < workers.limit and (case := next(queue, None)) is not None:
                flying[workers.submit(case, str(store.folder))] = case
            if not flying:
                return
            done, _ = wait(flying, timeout=_TICK, return_when=FIRST_COMPLETED)
            for future in done:
                case = flying.pop(future)
                _enter(case, _told(future, case, store), tally)
            report(tally.settled, tally.cost + workers.particle_steps())
    except BaseException:
        for future in flying:
            future.cancel()
        workers.stop()
        raise


def _told(future: "Future[Report]", case: Case, store: Store) -> Report:
    """Return what the worker reports, or that it was lost with the case."""
    try:
        told = future.result()
    except (OSError, BrokenExecutor):
        raise
    except Exception as error:  # noqa: BLE001 - executors say in classes of their own that a worker died
        store.write_error(case, error)
        return Report(case.id, "failed", type(error).__name__, str(error))
    if told.case != case.id:
        problem = "has workers with another version of drumrs, but must have workers with this one"
        raise ConfigError("executor", problem=problem)
    return told


def _enter(case: Case, told: Report, tally: _Tally) -> None:
    tally.settled += 1
    tally.cost += case.cost
    if told.status == "finished":
        tally.computed += 1
        tally.finished.add(case.id)
        tally.failed.pop(case.id, None)
    elif told.status == "failed":
        tally.failed[case.id] = Failure(case, told.error, told.message)
