"""`Simulation`: one drum, step by step; around the compiled core."""

import json
import math
import numbers
import os
import threading
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drumrs import _core
from drumrs.checkpoint import read_checkpoint, write_checkpoint
from drumrs.config import Config, require_config
from drumrs.config.derived import Facts
from drumrs.config.hints import hints
from drumrs.config.messages import both_given
from drumrs.errors import CheckpointError, ConfigError, DrumrsError, DrumrsWarning
from drumrs.limits import (
    check_steps,
    check_threads,
    in_terms_of_fill,
    require_memory,
    require_samples,
    step_count,
)
from drumrs.parts import Parts
from drumrs.records import HasRecords, Records
from drumrs.registry import recorded
from drumrs.result import Result, Summary
from drumrs.speed import HasSpeed
from drumrs.state import State

Array = NDArray[np.float64]
Core: TypeAlias = _core.Simulation

_SIMULATE_FIRST = (
    "run() without arguments simulates all of run.duration, and summary((start, end)) averages over a part"
)


class Simulation(HasRecords, HasSpeed):
    """A load in a turning drum, stepped at will.

    Parameters
    ----------
    config
        What to simulate.
    seed
        Seed of the random start, instead of ``config.run.seed``.
    threads
        Threads that share a step; the trajectory is the same for any number.
    state
        Where to start, instead of a random packing.
    in_memory
        Whether frames stay in memory to the end; False where they are taken as they come, with `records`.

    Raises
    ------
    ConfigError
        Where no such simulation can be; the error has key, value and limit.

    Warns
    -----
    DrumrsWarning
        Where contacts stick for ever or make the time step "auto" much shorter, and where something may not be
        what was meant, as `Config.hints` tells.

    Examples
    --------
    >>> import drumrs
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1), seed=1)
    >>> simulation.run(steps=100)
    >>> simulation.step, simulation.positions.shape
    (100, (40, 2))
    """

    _core: Core

    def __init__(
        self,
        config: Config,
        seed: int | None = None,
        threads: int = 1,
        state: State | None = None,
        *,
        in_memory: bool = True,
    ) -> None:
        check_threads(threads)
        config = require_config(config)
        if state is not None and not isinstance(state, State):
            raise ConfigError("state", state, "a drumrs.State", hint="drumrs.State(positions) makes one")
        config = config if seed is None else config.replace({"run.seed": seed})
        if state is None and not config.drum.rim and config.drum.shell is None:
            limit = "true where no initial state is given"
            raise ConfigError("drum.rim", False, limit, problem=f"is false, but must be {limit}")
        arrays = None if state is None else state.arrays(config.load.names)
        if arrays is not None and len(arrays["positions"]) != config.bundle_count:
            config = config.replace({"load.count": len(arrays["positions"])})
        try:
            core = _core.Simulation(config.to_core_json(), config.run.seed, threads, arrays)
        except ConfigError as error:
            raise in_terms_of_fill(config, error) from None
        core.tell_sums_until(config.run.told_until)
        self._start(config, core)
        require_samples(config, self.time_step)
        require_memory(config, self.time_step, self._records.sizes, with_frames=in_memory)
        for message in self.warnings:
            warnings.warn(message, DrumrsWarning, stacklevel=2)

    def _start(self, config: Config, core: Core) -> None:
        self._config = config
        self._core = core
        columns = recorded(core.parts(), config.run.record)
        self._records = Records(core, config, [column.name for column in columns])
        self._stop = threading.Event()
        self._running = threading.Lock()
        self._wall_time = 0.0
        self._steps_timed = 0

    def __repr__(self) -> str:
        """Say how large and how far the simulation is."""
        return f"<Simulation of {self.count} bundles at step {self.step}, t = {self.time:.6g} s>"

    def run(
        self,
        duration: float | None = None,
        *,
        steps: int | None = None,
        on_progress: Callable[[int], None] | None = None,
    ) -> None:
        """Advance by a time or a number of steps, or else to the end of the configuration's duration.

        Ctrl-C and `stop` end the call early and leave a valid simulation, which can go on.

        Parameters
        ----------
        duration
            Simulated time [s], rounded up to whole steps.
        steps
            Number of steps.
        on_progress
            Called with the step number, some thirty times a second and at the end.

        Raises
        ------
        UnstableError
            Where the run becomes unstable; the error has bundle, step, time and place.
        DrumrsError
            Where another thread is running this simulation.
        """
        if duration is not None and steps is not None:
            raise ConfigError(**both_given("", ("duration", "steps"), {"duration": duration, "steps": steps}))
        if duration is not None:
            if not (isinstance(duration, numbers.Real) and 0.0 <= duration < math.inf):
                raise ConfigError("duration", duration, "a finite number of at least 0")
            steps = step_count("duration", float(duration), self.time_step)
        end = self.last_step if steps is None else self.step + check_steps(steps)
        self.run_to_step(end, on_progress=on_progress)

    def run_to_step(
        self, step: int, *, wall_limit: float = math.inf, on_progress: Callable[[int], None] | None = None
    ) -> bool:
        """Advance to a step number, but no longer than a time of the wall clock.

        Parameters
        ----------
        step
            Step number to reach.
        wall_limit
            Time [s] after which to return where the step is not reached yet.
        on_progress
            Called with the step number, some thirty times a second and at the end.

        Returns
        -------
        bool
            False where `stop` ended the call.
        """
        if not self._running.acquire(blocking=False):
            raise DrumrsError(
                "this simulation is being run already, by another thread or around this call; it can be read, "
                "saved and stopped meanwhile, but not run"
            )
        first, began = self.step, time.perf_counter()

        def after_slice(now: int) -> None:
            # A stop asked for before the core was under way is seen here, at the end of its first slice.
            if self._stop.is_set() or time.perf_counter() - began >= wall_limit:
                self._core.stop()
            if on_progress is not None:
                on_progress(now)

        try:
            self._core.run(max(step - first, 0), after_slice)
        finally:
            self._wall_time += time.perf_counter() - began
            self._steps_timed += self.step - first
            stopped = self._stop.is_set()
            self._stop.clear()
            self._running.release()
        return not stopped

    def stop(self) -> None:
        """End the `run` that another thread is in, or is about to enter; safe from any thread."""
        self._stop.set()
        self._core.stop()

    def extend_to(self, duration: float) -> None:
        """Let the run, and the window of its averages, end later [s]: it becomes that of the longer configuration.

        Raises
        ------
        ConfigError
            Where `duration` is shorter than the configuration's.
        """
        run = self._config.run
        if not run.duration <= duration < math.inf:
            raise ConfigError("duration", duration, f"at least run.duration = {run.duration}")
        window = (run.averaging_window[0], duration)
        self._config = self._config.replace({"run": {"duration": duration, "window": window}})
        self._core.tell_sums_until(self._config.run.told_until)

    @property
    def config(self) -> Config:
        """The configuration, with the seed, and with the number of bundles where the start was given."""
        return self._config

    @property
    def seed(self) -> int:
        """Seed of the random start."""
        return self._core.seed

    @property
    def threads(self) -> int:
        """Threads that share a step."""
        return self._core.threads

    @property
    def count(self) -> int:
        """Number of bundles n."""
        return self._core.count

    @property
    def step(self) -> int:
        """Steps since t = 0."""
        return self._core.step

    @property
    def last_step(self) -> int:
        """Step number at which the configuration's duration is reached."""
        return step_count("run.duration", self._config.run.duration, self.time_step)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._core.time

    @property
    def time_step(self) -> float:
        """Time step [s]."""
        return self._core.time_step

    @property
    def collision_time(self) -> dict[str, float]:
        """Duration of a collision with another bundle, "bundle", and with the drum, "drum" [s]."""
        return self._core.collision_times

    @property
    def drum_angle(self) -> float:
        """Angle by which the drum has turned [rad]."""
        return self._core.drum_angle

    @property
    def drum_angular_velocity(self) -> float:
        """Angular velocity of the drum [rad/s]."""
        return self._core.drum_angular_velocity

    @property
    def positions(self) -> Array:
        """Centers of the bundles [m], shape (n, 2)."""
        return self._core.positions

    @property
    def velocities(self) -> Array:
        """Velocities of the bundles [m/s], shape (n, 2)."""
        return self._core.velocities

    @property
    def angles(self) -> Array:
        """Angles by which the bundles have turned [rad], shape (n,)."""
        return self._core.angles

    @property
    def angular_velocities(self) -> Array:
        """Spins of the bundles [rad/s], shape (n,)."""
        return self._core.angular_velocities

    @property
    def radii(self) -> Array:
        """Radii of the bundles [m], shape (n,)."""
        return self._core.radii

    @property
    def masses(self) -> Array:
        """Masses of the bundles per meter of depth [kg/m], shape (n,)."""
        return self._core.masses

    @property
    def species(self) -> tuple[str, ...]:
        """Name of the species of each bundle; empty where all bundles are equal."""
        return self._records.species

    @property
    def state(self) -> State:
        """Where the bundles and the drum are now, and the contacts: a simulation started from it goes on from here.

        It may have another configuration, so a load can settle before friction or speed changes. Its time begins at 0.
        """
        return State(**self._core.state())

    @property
    def warnings(self) -> list[str]:
        """What this simulation does that one may not expect, a message each; they are warned of at the start."""
        return [*hints(self._config, self._facts), *self._core.warnings]

    @property
    def facts(self) -> str:
        """A line that places this simulation among others: Froude number, critical speed, load, resolution."""
        return self._config.facts_line(self._facts)

    @property
    def _facts(self) -> Facts:
        return Facts.read(self._core.facts)

    def summary(self, window: tuple[float, float] | None = None) -> Summary:
        """Return averages over an interval.

        Parameters
        ----------
        window
            Start and end [s]; the configuration's window unless given.

        Raises
        ------
        ConfigError
            Where the interval has not been simulated.
        """
        try:
            start, end = map(float, self._config.run.averaging_window if window is None else window)
        except (TypeError, ValueError):
            raise ConfigError("window", window, "a pair (start, end) of times") from None
        if not 0.0 <= start < end <= self.time + self.time_step:
            limit = f"within the {self.time:.6g} s simulated so far"
            hint = _SIMULATE_FIRST if window is None else ""
            raise ConfigError("window", (start, end), limit, hint=hint)
        if not self._records.has_whole_series:
            hint = "load the checkpoint where its run wrote it, beside its records"
            problem = f"is [{start}, {end}], but its samples are no longer in memory"
            raise ConfigError(
                "window", (start, end), "one whose samples are in memory", hint=hint, problem=problem
            )
        filled = self._config.drum.fill_of(self.radii)
        known = {"bundle_count": self.count, "steps": self.step, "fill": filled, "time_step": self.time_step}
        return Summary.from_mapping({**known, **self._timing(), **self._core.summary(start, end)})

    def _timing(self) -> dict[str, float | None]:
        rate = self.count * self._steps_timed / self._wall_time if self._wall_time else None
        return {"wall_time": self._wall_time, "particle_steps_per_second": rate}

    def result(self, *, keep: bool = True) -> Result:
        """Return the run so far as a `Result`.

        Parameters
        ----------
        keep
            Whether the simulation keeps its frames, too, in as much memory again.
        """
        series = self.series
        tables = self._records.contact_tables()
        return Result(self._config, self.summary(), series, self._records.frames(keep=keep), **tables)

    def save(self, path: str | Path) -> None:
        """Write a checkpoint: `load` goes on from it, bit for bit as if there had been no break."""
        write_checkpoint(path, self._config, self._core.checkpoint().data)

    @classmethod
    def load(cls, path: str | Path, threads: int = 1, *, with_records: bool = True) -> "Simulation":
        """Read a checkpoint.

        Parameters
        ----------
        path
            File that `save` or `drumrs run` wrote.
        threads
            Threads that share a step.
        with_records
            Whether to read what `drumrs run` recorded before, too, if it lies beside.

        Raises
        ------
        CheckpointError
            Where the file is truncated, damaged or of another version.
        """
        check_threads(threads)
        config, data = read_checkpoint(path)
        try:
            core = _core.Simulation.from_checkpoint(data, threads)
        except CheckpointError as error:
            raise CheckpointError(error.reason, str(path)) from None
        if json.loads(core.config) != json.loads(config.to_core_json()) or core.seed != config.run.seed:
            raise CheckpointError("its configuration is not that of its state", str(path))
        simulation = cls._around(config, core)
        if with_records and not simulation.records.are_whole:
            Parts(Path(path).parent).reload(simulation.records)
        return simulation

    @classmethod
    def _around(cls, config: Config, core: Core) -> "Simulation":
        simulation = cls.__new__(cls)
        simulation._start(config, core)  # noqa: SLF001 - a second constructor
        return simulation

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy by a checkpoint: what comes of it goes on bit for bit, on its own."""
        return _restored, (self._config, self._core.checkpoint().tobytes(), self.threads)


def _restored(config: Config, data: bytes, threads: int) -> Simulation:
    """Make a simulation of what `Simulation.__reduce__` tells."""
    return Simulation._around(config, _core.Simulation.from_checkpoint(data, threads))  # noqa: SLF001


# A fork keeps none of this process's other threads: it has to wait until none of them is inside a simulation.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=_core.close_fork_guard,
        after_in_parent=_core.open_fork_guard,
        after_in_child=_core.open_fork_guard_in_child,
    )


def info() -> dict[str, Any]:
    """Return what this copy of drumrs is: version, build profile, CPU features, physics version, target."""
    return dict(_core.info())
