"""Executors of a sweep: threads of this process, spawned processes, or one that was given; and how to stop them."""

import multiprocessing
import signal
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from multiprocessing.synchronize import Event

from drumrs.errors import ConfigError
from drumrs.jobs import MOST_JOBS, effective_jobs
from drumrs.sweep.case import Case
from drumrs.sweep.worker import CaseOutcome, Running, run_case, stop_with

# Enough to keep a worker busy until the next case is handed out.
_SPARE = 2


@dataclass(frozen=True)
class Workers:
    """An executor, how many cases it gets at once, and how to stop those under way.

    Attributes
    ----------
    executor
        Whom the cases are submitted to.
    limit
        Cases submitted and not finished, at most; a few more than can run, so that stopping loses little time.
    running
        The simulations under way, where they run in this process.
    halt
        Set to stop those in processes of ours.
    """

    executor: Executor
    limit: int
    running: Running | None = None
    halt: Event | None = None

    def submit(self, case: Case, folder: str) -> "Future[CaseOutcome]":
        """Hand out a case.

        Raises
        ------
        ConfigError
            Where the executor takes no work.
        """
        arguments = (case.config.model_dump_json(), folder)
        extra = () if self.running is None else (self.running,)
        try:
            with _children_without_interrupts() if self.halt is not None else nullcontext():
                return self.executor.submit(run_case, *arguments, *extra)
        except Exception as error:  # every executor has a class of its own for it
            if self.halt is not None and isinstance(error, BrokenExecutor):
                raise
            raise ConfigError("executor", problem=f"takes no work, but must be open: {error}") from None

    def particle_steps(self) -> float:
        """Return the particle-steps of the simulations under way, 0 where they cannot be seen."""
        return 0.0 if self.running is None else self.running.particle_steps()

    def stop(self) -> None:
        """Stop what is under way; with an executor that was given, what has begun elsewhere comes to its end."""
        if self.running is not None:
            self.running.stop()
        if self.halt is not None:
            self.halt.set()


@contextmanager
def _children_without_interrupts() -> Iterator[None]:
    """Hold Ctrl-C back for a moment: a process started meanwhile never hears it, not even while it imports."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def open_workers(executor: Executor | str | None, jobs: int | None) -> Iterator[Workers]:
    """Open an executor, and shut it down at the end unless it was given.

    Parameters
    ----------
    executor
        `None` or "threads", "processes" (spawned, for a fork does not go with polars), or any executor.
    jobs
        Cases at once: by default one a usable core, or with an executor that was given, as many as it takes.

    Raises
    ------
    ConfigError
        Where there is no such executor, or its processes end before they work.
    """
    count = effective_jobs(jobs)
    if executor is None or executor == "threads":
        with ThreadPoolExecutor(count, thread_name_prefix="drumrs") as pool:
            yield Workers(pool, count + _SPARE, Running())
    elif executor == "processes":
        with _processes(count) as workers:
            yield workers
    elif isinstance(executor, Executor):
        _refuse_fork(executor)
        running = Running() if isinstance(executor, ThreadPoolExecutor) else None
        yield Workers(executor, jobs or MOST_JOBS, running)
    else:
        raise ConfigError("executor", executor, "'threads', 'processes' or an Executor")


@contextmanager
def _processes(count: int) -> Iterator[Workers]:
    """Spawn processes, each of which imports the script that runs the sweep."""
    # Set in a process while it imports that script, as multiprocessing itself asks: the process that started it has
    # the sentence, and what is raised here would be one traceback more.
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise SystemExit(1)
    context = multiprocessing.get_context("spawn")
    halt, begun = context.Event(), context.Event()
    try:
        with ProcessPoolExecutor(count, context, stop_with, (halt, begun)) as processes:
            yield Workers(processes, count + _SPARE, halt=halt)
    except BrokenExecutor:
        if begun.is_set():
            raise
        problem = "starts processes that end before they work"
        hint = (
            "each of them imports the script that runs the sweep: let what it does stand under "
            'if __name__ == "__main__":'
        )
        raise ConfigError("executor", hint=hint, problem=problem) from None


def _refuse_fork(executor: Executor) -> None:
    context = getattr(executor, "_mp_context", None)
    if context is not None and context.get_start_method() == "fork":
        problem = "forks its workers, but must spawn them, for a fork does not go with polars' threads"
        hint = "ProcessPoolExecutor(mp_context=multiprocessing.get_context('spawn')) does"
        raise ConfigError("executor", hint=hint, problem=problem)
