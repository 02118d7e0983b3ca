"""One case, run to its end and kept: what every executor is handed, on threads and on other machines alike."""

import json
import multiprocessing
import os
import platform
import signal
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.synchronize import Event
from pathlib import Path
from typing import NamedTuple

from drumrs.config import Config
from drumrs.errors import CheckpointError
from drumrs.runs import advance_to_end
from drumrs.simulation import Simulation, info
from drumrs.sweep.case import Case
from drumrs.sweep.runner import Runner
from drumrs.sweep.store import Store

# A case that has taken less is sooner simulated again [s].
_WORTH = 5.0


class CaseOutcome(NamedTuple):
    """What became of a case: "finished", "failed" with the error's class and sentence, or "stopped"; where; seconds."""

    case: str
    status: str
    error: str = ""
    message: str = ""
    host: str = ""
    seconds: float = 0.0


class Running:
    """The simulations under way in this process: how far they are together, and a way to stop them all."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._particle_steps: dict[Simulation, float] = {}
        self._stopped = False

    def begin(self, simulation: Simulation) -> Callable[[int], None]:
        """Add a simulation; the function returned is to be called with its step number."""
        # Asked for now: once it runs, a simulation answers after a slice of its run only, and others would wait.
        count = simulation.count
        with self._lock:
            self._particle_steps[simulation] = 0.0
            if self._stopped:
                simulation.stop()

        def on_progress(step: int) -> None:
            self._particle_steps[simulation] = float(count * step)

        return on_progress

    def end(self, simulation: Simulation) -> None:
        """Take a simulation out."""
        with self._lock:
            self._particle_steps.pop(simulation, None)

    def particle_steps(self) -> float:
        """Return the particle-steps that the simulations under way have done."""
        with self._lock:
            return sum(self._particle_steps.values())

    def stop(self) -> None:
        """Stop all, those to come included."""
        with self._lock:
            self._stopped = True
            for simulation in self._particle_steps:
                simulation.stop()


# Those of a process that works for a sweep elsewhere.
_here = Running()


def stop_with(halt: Event, begun: Event) -> None:
    """Make this process one that works for a sweep elsewhere: it says so, and stops when told so, not by Ctrl-C.

    Where the process that it works for is no more, killed for instance, it ends at once.
    """
    begun.set()
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def wait() -> None:
        halt.wait()
        _here.stop()

    def end_with_parent() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    for watch in (wait, end_with_parent):
        threading.Thread(target=watch, daemon=True).start()


def run_case(config_json: str, folder: str, running: Running | None = None) -> CaseOutcome:
    """Simulate a case and keep its results, or its error, in a sweep's folder.

    Parameters
    ----------
    config_json
        The configuration as JSON, every key given, seed included.
    folder
        The sweep's folder, which exists and is reached under this name wherever the function runs.
    running
        Where to enter the simulation, so that another thread can stop it.

    Returns
    -------
    CaseOutcome
        What became of the case; a failure is reported, not raised.

    Raises
    ------
    OSError
        Where the results cannot be written: no fault of the case's.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> from drumrs.sweep import run_case
    >>> config = drumrs.baseline(fill=0.05).replace({"run.duration": 0.05})
    >>> run_case(config.model_dump_json(), tempfile.mkdtemp()).status
    'finished'
    """
    case = Case(Config.model_validate(json.loads(config_json)))
    store = Store(folder)
    # Another sweep may have finished it while it stood in the queue; an older version may have left it all but its row.
    if store.fault(case) is None or store.renew(case):
        return CaseOutcome(case.id, "finished")
    began, error = time.perf_counter(), None
    try:
        status = "finished" if _simulate(case, store, running or _here) else "stopped"
    except OSError:
        raise
    except Exception as raised:  # noqa: BLE001 - whatever is wrong with one case, the others go on
        store.write_error(case, raised)
        status, error = "failed", raised
    told = (type(error).__name__, str(error)) if error is not None else ("", "")
    return CaseOutcome(case.id, status, *told, platform.node(), time.perf_counter() - began)


def _simulate(case: Case, store: Store, running: Running) -> bool:
    runner = Runner(store.runner(case))
    simulation = _begin(case, store, runner)
    on_progress = running.begin(simulation)
    try:
        if not advance_to_end(simulation, on_progress, _Checkpoint(store.checkpoint(case), runner)):
            return False
        store.write(case, simulation.result(keep=False), _facts())
    finally:
        running.end(simulation)
        runner.clear()
    return True


def _begin(case: Case, store: Store, runner: Runner) -> Simulation:
    """Go on from the checkpoint of a case that was stopped, or begin."""
    path = store.checkpoint(case)
    if path.exists():
        # One that is damaged, or of another version, is of no use.
        with suppress(CheckpointError):
            simulation = Simulation.load(path)
            if simulation.config.digest == case.config.digest:
                runner.mark()
                return simulation
    return Simulation(case.config)


class _Checkpoint:
    """Where a case keeps how far it is, once it has taken long enough for that to be worth a file."""

    def __init__(self, path: Path, runner: Runner) -> None:
        self._path, self._runner = path, runner
        self._began = time.monotonic()

    def flush(self, simulation: Simulation) -> None:
        """Leave records in memory: a checkpoint holds them."""

    def save(self, simulation: Simulation) -> None:
        """Write a checkpoint."""
        if time.monotonic() - self._began >= _WORTH and simulation.step < simulation.last_step:
            self._runner.mark()
            simulation.save(self._path)


def _facts() -> dict[str, object]:
    about = info()
    return {
        "drumrs": about["version"],
        "machine": platform.node(),
        "target": about["target"],
        "cpu_features": about["cpu_features"],
        "python": platform.python_version(),
    }
