"""A whole run: from the start to the end of the configuration's duration, with progress and checkpoints."""

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from drumrs.config import Config
from drumrs.progress import Board, Journey, board
from drumrs.result import Result
from drumrs.run_folder import RunFolder
from drumrs.simulation import Simulation


def run(
    config: Config | str | Path, seed: int | None = None, *, threads: int = 1, progress: bool = True
) -> Result:
    """Simulate the configuration's duration and average over its window.

    Parameters
    ----------
    config
        What to simulate: a configuration, or the name of a TOML file that is laid over the baseline.
    seed
        Seed of the random start, instead of ``config.run.seed``.
    threads
        Threads that share a step; the result is the same for any number.
    progress
        Whether to show progress: a bar in a terminal or notebook, else a line a minute on standard error.

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
    config = Config.read(config) if isinstance(config, (str, Path)) else config
    simulation = Simulation(config, seed, threads)
    with board(show=progress) as shown:
        finish(simulation, announce(shown, simulation))
    return simulation.result(keep=False)


def announce(shown: Board, simulation: Simulation, label: str = "") -> Callable[[int], None]:
    """Put a simulation on a board of progress."""
    journey = Journey(label, simulation.step, simulation.last_step, simulation.time_step, simulation.count)
    return shown.add(journey)


def finish(
    simulation: Simulation, report: Callable[[int], None] | None = None, folder: RunFolder | None = None
) -> bool:
    """Run to the end of the duration, writing records as they come, and a checkpoint at once, every so often, and last.

    Parameters
    ----------
    simulation
        What to run.
    report
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
        if report is not None:
            report(step)

    _save(simulation, folder)
    going = True
    while going and simulation.step < simulation.last_step:
        try:
            going = simulation.run_until(simulation.last_step, wall_limit=pause, progress=after_slice)
        except (KeyboardInterrupt, MemoryError):
            _save(simulation, folder)
            raise
        _save(simulation, folder)
    if report is not None:
        report(simulation.step)
    return going


def _save(simulation: Simulation, folder: RunFolder | None) -> None:
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
    with board(show=progress) as shown, ThreadPoolExecutor(len(simulations)) as pool:
        tasks = [
            pool.submit(finish, simulation, announce(shown, simulation, label))
            for label, simulation in simulations.items()
        ]
        try:
            for task in tasks:
                task.result()
        except BaseException:
            # Threads cannot be interrupted from outside; the simulations can.
            for simulation in simulations.values():
                simulation.stop()
            raise
    return {label: simulation.result(keep=False) for label, simulation in simulations.items()}
