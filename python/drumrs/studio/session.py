"""`Session`: a simulation that runs in a thread of its own, while it is looked at and changed.

One thread alone touches the simulation. It runs it by a few steps at a time, at a chosen number of simulated seconds in
a second; between them it does what was asked of it. Measures are made in another one, of what was taken from it.
Whatever is asked, the run is that of `Session.case` from its start on, bit for bit: reading changes nothing, and a
change of speed becomes part of the case.
"""

import math
import queue
import threading
import time
import warnings
from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Self, TypeVar

from drumrs.config import Config
from drumrs.errors import ConfigError, DrumrsError, DrumrsWarning, UnstableError
from drumrs.simulation import Simulation
from drumrs.studio.measures import RecentFrames, Sample
from drumrs.studio.scene import frame_now, pack_start
from drumrs.studio.trades import TRADES
from drumrs.studio.view import View

if TYPE_CHECKING:
    import polars as pl

    from drumrs.frames import Frames

T = TypeVar("T")

# Length of the ramp to another speed, in simulated time [s].
RAMP = 0.1
# Time of a picture [s], within which steps are done before anything else is looked at: half of a screen's, so that
# there is always one that is new.
_PICTURE = 1.0 / 120.0
# Measures are made anew after this time [s], and after so many times as long as it took to make the last ones.
_MEASURE_EVERY, _MEASURE_SHARE = 0.5, 6.0
# What the series of a session may grow to, in simulated time [s]; some tens of megabytes.
LONGEST = 600.0
# A simulation that is behind its time by more than this [s] does not try to catch up.
_LATE = 0.1


class Session:
    """A simulation in a thread, with what can be done to it.

    Parameters
    ----------
    config
        What to simulate.
    threads
        Threads that share a step; nothing depends on their number but how fast it goes.
    playing
        Whether it runs from the start on.
    rate
        Simulated seconds in a second; ``math.inf`` for as many as can be.

    Raises
    ------
    ConfigError
        Where no such simulation can be.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.studio import Session
    >>> with Session(drumrs.baseline(fill=0.1), playing=False) as session:
    ...     session.advance(100)
    ...     session.set_speed(60.0)
    ...     session.case().rotation.program
    ((0.0, 54.0), (0.001, 54.0), (0.101, 60.0))
    """

    _simulation: Simulation
    _base: Config
    # Times of the wall clock and of the simulation from which time passes at the rate, and from which the factor is
    # taken.
    _due_from: tuple[float, float]
    _factor_from: tuple[float, float]
    _factor: float
    _about: tuple[str, str]
    _load: "Frames"
    _scene: dict[str, Any]
    _measures: dict[str, Any]
    _measure_at: float
    _wanted_speed: float | None

    def __init__(self, config: Config, *, threads: int = 1, playing: bool = True, rate: float = 1.0) -> None:
        self._threads = threads
        self._asked: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._changed = threading.Condition()
        self._playing, self._rate, self._closing = playing, _checked_rate(rate), False
        self._steps_per_second = 0.0
        self._starts = self._pictures = self._measured = 0
        self._said: tuple[str, ...] = ()
        self._trade = next(iter(TRADES))
        self._measurer = ThreadPoolExecutor(1, "drumrs studio measures")
        self._begin(config)
        self._thread = threading.Thread(target=self._run, name="drumrs studio", daemon=True)
        self._thread.start()

    def __enter__(self) -> Self:
        """Use the session within a block."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it at the end of the block."""
        self.close()

    def close(self) -> None:
        """End the thread, at the end of the steps under way."""
        self._closing = True
        self._simulation.stop()
        self._asked.put(lambda: None)
        self._thread.join()
        self._measurer.shutdown(cancel_futures=True)

    @property
    def view(self) -> View:
        """What is to be shown now."""
        return self._view

    def wait(self, number: int, timeout: float) -> View:
        """Return a view with a picture later than that of a number, or the present one after a time [s]."""
        with self._changed:
            self._changed.wait_for(lambda: self._view.number > number or self._closing, timeout)
        return self._view

    def play(self) -> None:
        """Go on."""
        self._ask(lambda: self._set_playing(True))

    def pause(self) -> None:
        """Stand still."""
        self._ask(lambda: self._set_playing(False))

    def set_rate(self, rate: float) -> None:
        """Let so many simulated seconds pass in a second; fewer pass where the core cannot do more."""
        rate = _checked_rate(rate)
        self._ask(lambda: self._set_rate(rate))

    def set_trade(self, name: str) -> None:
        """Measure what a trade wants to know: a key of `TRADES`.

        Raises
        ------
        ConfigError
            Where there is no such trade.
        """
        if name not in TRADES:
            raise ConfigError("trade", name, f"one of {', '.join(TRADES)}")
        self._ask(lambda: self._set_trade(name))

    def advance(self, steps: int) -> None:
        """Do so many steps and stand still."""
        self._ask(lambda: self._advance(steps))

    def set_speed(self, rpm: float) -> None:
        """Let the drum change to another speed now, by a ramp of 0.1 s; it becomes part of the case.

        While the drum is on a ramp the change waits for its end, and a later one takes its place.

        Raises
        ------
        ConfigError
            Where the drum cannot have this speed.
        """
        self._ask(lambda: self._set_speed(rpm))

    def change(self, changes: Mapping[str, Any]) -> None:
        """Start anew, from the same seed and at the present speed, with some keys changed.

        Raises
        ------
        ConfigError
            Where a key or a value is not accepted; the session stays as it was.
        """
        self._ask(lambda: self._restart(self._base.replace(changes), changes))

    def load(self, config: Config) -> None:
        """Start anew with another case."""
        self._ask(lambda: self._restart(config, {}))

    def reset(self) -> None:
        """Start anew, from the same seed and at the present speed."""
        self._ask(lambda: self._restart(self._base, {}))

    def show(self) -> None:
        """Show the present state once more, as a new picture: for who wants to see more of it."""
        self._ask(self._show)

    def case(self) -> Config:
        """Return the configuration whose run this session is, bit for bit; it lasts as long as the session at least."""
        return self._ask(self._case)

    def series(self) -> "pl.DataFrame":
        """Return what was recorded since the start, one row a sample."""
        return self._ask(lambda: self._simulation.series)

    def _ask(self, act: Callable[[], T]) -> T:
        """Let the session's thread do something between two steps; return its result or raise its error."""
        answer: Future[T] = Future()

        def do() -> None:
            try:
                answer.set_result(act())
            except BaseException as error:  # noqa: BLE001 - it is raised where it was asked for
                answer.set_exception(error)

        if self._closing:
            raise DrumrsError("the session is closed, and nothing can be asked of it: make another one")
        self._asked.put(do)
        return answer.result()

    def _run(self) -> None:
        while not self._closing:
            with suppress(queue.Empty):
                # Nothing to do without being asked while the simulation stands still.
                while not self._closing:
                    self._asked.get(block=not self._playing)()
            if not self._closing:
                self._go_on()
        with self._changed:
            self._changed.notify_all()
        with suppress(queue.Empty):
            while True:
                self._asked.get_nowait()()

    def _go_on(self) -> None:
        """Do the steps of a picture and show it, or wait until the next step is due."""
        simulation, now = self._simulation, time.perf_counter()
        due = self._due_from[1] + self._rate * (now - self._due_from[0])
        if not math.isfinite(due) or due - simulation.time > _LATE * max(self._rate, 1.0):
            # The core cannot keep up: what is behind is not made up for.
            self._due_from = (now, simulation.time)
            due = simulation.time + min(self._rate, 1e9) * _PICTURE
        steps = math.floor((due - simulation.time) / simulation.time_step)
        if steps < 1:
            time.sleep(min(_PICTURE / 4.0, simulation.time_step / self._rate))
            return
        most = math.ceil(max(self._steps_per_second * _PICTURE, 1.0))
        self._take(min(steps, most))
        took = time.perf_counter() - now
        # Where more is due, there is no time to rest.
        if steps <= most and took < _PICTURE:
            time.sleep(_PICTURE - took)

    def _take(self, steps: int) -> None:
        """Do so many steps and show where they led."""
        simulation, began = self._simulation, time.perf_counter()
        before = simulation.step
        try:
            simulation.run(steps=steps)
        except UnstableError as error:
            self._set_playing(False)
            self._say(f"The run became unstable: {error}. Reset, or change something.")
        took = time.perf_counter() - began
        rate = (simulation.step - before) / max(took, 1e-9)
        # Enough of the past that one slow picture does not count, and the first one does not count for long.
        self._steps_per_second += 0.3 * (rate - self._steps_per_second)
        self._recent.take_from(simulation)
        self._follow_speed()
        if simulation.time >= LONGEST and self._playing:
            self._set_playing(False)
            self._say(
                f"The session has reached {LONGEST:g} s. Reset, or copy the case and run it with drumrs run."
            )
        self._note_factor()
        self._show()

    def _note_factor(self) -> None:
        now = time.perf_counter()
        began, at = self._factor_from
        if now - began > 1.0:
            self._factor = (self._simulation.time - at) / (now - began)
            self._factor_from = (now, self._simulation.time)

    def _show(self) -> None:
        """Put what is to be seen where others find it."""
        if time.perf_counter() >= self._measure_at:
            self._measure()
        self._pictures += 1
        view = View(
            start=self._starts,
            config=self._base,
            title=self._about[0],
            facts=self._about[1],
            scene=self._scene,
            now=frame_now(self._simulation, self._load),
            spin=self._simulation.drum_angular_velocity,
            factor=self._factor,
            number=self._pictures,
            measures=self._measures,
            playing=self._playing,
            rate=self._rate,
            speed=self._speed,
            trade=self._trade,
            said=self._said,
        )
        with self._changed:
            self._view = view
            self._changed.notify_all()

    def _measure(self) -> None:
        """Let measures be made beside the simulation, of where it is now."""
        began, start = time.perf_counter(), self._starts
        # Not again before these are there.
        self._measure_at = math.inf
        sample = Sample.of(self._simulation, self._trade, self._recent, self._since)

        def put(made: Future[dict[str, Any]]) -> None:
            if start != self._starts:
                return
            if (error := made.exception()) is not None:
                self._say(f"No measures could be made: {error}")
            else:
                self._measured += 1
                self._measures = {"number": self._measured, **made.result()}
            now = time.perf_counter()
            self._measure_at = now + max(_MEASURE_EVERY, _MEASURE_SHARE * (now - began))
            self._show()

        with suppress(RuntimeError):  # of a session that is being closed
            job = self._measurer.submit(sample.measures)
            job.add_done_callback(lambda made: self._asked.put(lambda: put(made)))

    def _say(self, sentence: str) -> None:
        self._said = (*self._said[-20:], sentence)

    def _begin(self, config: Config, said: str = "") -> None:
        with warnings.catch_warnings():
            # They are said on the page.
            warnings.simplefilter("ignore", DrumrsWarning)
            simulation = Simulation(config, threads=self._threads, in_memory=False)
        self._simulation, self._base = simulation, config
        self._about = (config.title, config.facts)
        self._recent, self._since = RecentFrames(), 0.0
        self._wanted_speed = None
        self._speed = simulation.drum_angular_velocity * 30.0 / math.pi
        self._measures = {}
        self._measure_at, self._factor = 0.0, 0.0
        self._starts += 1
        self._load = simulation.records.none()
        self._scene = pack_start(frame_now(simulation, self._load))
        for sentence in (*(f"Note that {warning}" for warning in simulation.warnings), said):
            if sentence:
                self._say(sentence)
        self._set_clock()
        self._show()

    def _set_clock(self) -> None:
        """Let time pass from here on, not from where it was."""
        self._due_from = self._factor_from = (time.perf_counter(), self._simulation.time)

    def _set_playing(self, playing: bool) -> None:
        self._playing = playing
        if not playing:
            # Who stops to look is to see the measures of this moment.
            self._measure()
        self._set_clock()
        self._show()

    def _set_rate(self, rate: float) -> None:
        self._rate = rate
        self._set_clock()
        self._show()

    def _set_trade(self, name: str) -> None:
        self._trade = name
        self._measure()
        self._show()

    def _advance(self, steps: int) -> None:
        self._playing = False
        self._take(steps)

    def _set_speed(self, rpm: float) -> None:
        self._base, self._speed = self._base.replace({"rotation.rpm": rpm}), rpm
        self._about = (self._base.title, self._base.facts)
        self._wanted_speed = rpm
        self._follow_speed()
        self._show()

    def _follow_speed(self) -> None:
        """Begin to change to the speed that is wanted, unless the drum is still on its last ramp."""
        simulation, rpm = self._simulation, self._wanted_speed
        if rpm is None or simulation.time < self._since:
            return
        self._wanted_speed = None
        begin = simulation.set_speed(rpm, RAMP)
        self._since = begin + RAMP
        if begin > simulation.time + RAMP:
            self._say(f"The drum is on a ramp; it changes to {rpm:g} rpm at its end, at t = {begin:.6g} s.")

    def _restart(self, config: Config, changes: Mapping[str, Any]) -> None:
        changed = ", ".join(f"{key} = {value}" for key, value in changes.items())
        self._begin(
            config, f"Started anew from seed {config.run.seed}{f', with {changed}' if changed else ''}."
        )

    def _case(self) -> Config:
        config, time = self._simulation.config, self._simulation.time
        if time <= config.run.duration:
            return config
        # A window that is not given is the last third, whatever the duration.
        return config.replace({"run.duration": math.ceil(1e3 * time) / 1e3})


def _checked_rate(rate: float) -> float:
    if not rate > 0.0:
        raise ConfigError("rate", rate, "a positive number of simulated seconds in a second")
    return float(rate)
