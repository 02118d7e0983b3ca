"""Whole runs: from the start to the end of the configuration's duration, with progress and checkpoints."""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Protocol

from drumrs.config import Config, require_config
from drumrs.progress import Task, with_prefix
from drumrs.result import Result
from drumrs.simulation import Simulation


class Keeper(Protocol):
    """Where records and checkpoints of a run are kept: its folder, or the file of a case."""

    def flush(self, simulation: Simulation) -> None:
        """Write what was recorded since, where that is much."""

    def save(self, simulation: Simulation) -> None:
        """Write a checkpoint."""


# From so many bundles on the packing takes seconds, and is shown.
_LARGE_LOAD = 20_000


def run(
    config: Config | str | Path, seed: int | None = None, *, threads: int = 1, progress: bool = True
) -> Result:
    """Simulate the configuration's duration and average over its window.

    Parameters
    ----------
    config
        What to simulate: a configuration, or the name of a file that is laid over the baseline, as `Config.read`.
    seed
        Seed of the random start, instead of ``config.run.seed``.
    threads
        Threads that share a step; the result is the same for any number.
    progress
        Whether to show progress, as a `drumrs.Task` does.

    Returns
    -------
    Result
        Summary, series and frames.

    Raises
    ------
    ConfigError
        Where no such simulation can be.
    UnstableError
        Where the run leaves the range in which the model means anything.

    Examples
    --------
    >>> import drumrs
    >>> config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
    >>> result = drumrs.run(config, seed=1, progress=False)
    >>> result.frames.positions.shape[1:]
    (40, 2)
    """
    config = require_config(Config.read(config) if isinstance(config, (str, Path)) else config)
    with packing(config, show=progress):
        simulation = Simulation(config, seed, threads)
    run_to_end(simulation, progress=progress)
    return simulation.result(keep=False)


def packing(config: Config, *, show: bool) -> Task:
    """Return the task within which a simulation of the configuration is to be made, shown where the load is large."""
    count = config.bundle_count
    return Task(f"packing {count} bundles", 0, show=show and count >= _LARGE_LOAD)


def run_to_end(
    simulation: Simulation, folder: Keeper | None = None, *, label: str = "", progress: bool = True
) -> None:
    """Run to the end of the duration as `advance_to_end` does, and show how far it is."""
    with progress_of(simulation, label, show=progress) as on_progress:
        advance_to_end(simulation, on_progress, folder)


@contextmanager
def progress_of(
    simulation: Simulation, label: str = "", *, show: bool = True
) -> Iterator[Callable[[int], None]]:
    """Show how far a simulation is on its way to the end of its duration, as who runs it says with its step number."""
    count, last, time_step = simulation.count, simulation.last_step, simulation.time_step
    size = f"{count} bundle{'s' if count > 1 else ''}, {with_prefix(last)}steps"
    name = f"{label}: {size}" if label else size
    with Task(name, last * count, "particle-steps", done=simulation.step * count, show=show) as task:

        def on_progress(step: int) -> None:
            task.update(step * count, f"{step * time_step:.2f} of {last * time_step:.2f} s")

        on_progress(simulation.step)
        yield on_progress


def advance_to_end(
    simulation: Simulation,
    on_progress: Callable[[int], None] | None = None,
    folder: Keeper | None = None,
) -> bool:
    """Run to the end of the duration, writing records as they come, and a checkpoint at once, every so often, and last.

    Parameters
    ----------
    simulation
        What to run.
    on_progress
        Called with the step number.
    folder
        Where to keep records and checkpoints. An unstable run leaves the last good one, Ctrl-C one of that moment,
        and so does a run that finds no memory.

    Returns
    -------
    bool
        False where `Simulation.stop` ended the run.
    """
    pause = simulation.config.run.checkpoint_every if folder is not None else float("inf")

    def after_slice(step: int) -> None:
        if folder is not None:
            folder.flush(simulation)
        if on_progress is not None:
            on_progress(step)

    _save(simulation, folder)
    going = True
    while going and simulation.step < simulation.last_step:
        try:
            going = simulation.run_to_step(simulation.last_step, wall_limit=pause, on_progress=after_slice)
        except (KeyboardInterrupt, MemoryError):
            _save(simulation, folder)
            raise
        _save(simulation, folder)
    if on_progress is not None:
        on_progress(simulation.step)
    return going


def _save(simulation: Simulation, folder: Keeper | None) -> None:
    if folder is not None:
        folder.save(simulation)


def run_side_by_side(cases: Mapping[str, Config], *, progress: bool = True) -> dict[str, Result]:
    """Run several configurations at once, each on a thread of its own.

    Parameters
    ----------
    cases
        Configurations by label.
    progress
        Whether to show progress.

    Returns
    -------
    dict
        Results by label, in the order of `cases`.
    """
    simulations = {label: Simulation(config) for label, config in cases.items()}
    with ExitStack() as tasks, ThreadPoolExecutor(len(simulations)) as pool:
        runs = [
            pool.submit(
                advance_to_end,
                simulation,
                tasks.enter_context(progress_of(simulation, label, show=progress)),
            )
            for label, simulation in simulations.items()
        ]
        try:
            for task in runs:
                task.result()
        except BaseException:
            # Threads cannot be interrupted from outside; the simulations can.
            for simulation in simulations.values():
                simulation.stop()
            raise
    return {label: simulation.result(keep=False) for label, simulation in simulations.items()}
