"""Single quantities of a run, over its window or in the phases of its program: a mean with its error for each name.

The series tells most of them; what is measured on frames and records is in `measured`.
"""

import difflib
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from functools import cache
from typing import TYPE_CHECKING

from drumrs import registry
from drumrs.analysis import Mean, mean_with_error, rate_with_error
from drumrs.analysis.blocks import SeriesWindow
from drumrs.analysis.phases import mass_of, summary_of_rows
from drumrs.analysis.statistics import means_with_errors
from drumrs.decide import measured
from drumrs.decide.measured import Means, Value, Window
from drumrs.errors import ConfigError
from drumrs.frames import COLUMNS
from drumrs.result import Summary

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.result import Result

# How the columns end whose sum is a number of the summary.
_SUMS = {
    "kinetic_energy": ("kinetic_translation", "kinetic_rotation"),
    "drum_force_x": ("_force_x",),
    "drum_force_y": ("_force_y",),
}
# Suggestions for a name that is none.
_MOST_MEANT = 3
# What says nothing of the motion, though summary and series have it.
_NOT_ASKED = {
    *("time", "residual", "energy_residual", "numerical", "power_disagreement", "wall_time", "steps"),
    *("particle_steps_per_second", "window_start", "window_end", "drum_angle", "time_step"),
}


# Arguments of a measure, by name.
Arguments = tuple[tuple[str, Value], ...]
# What takes none.
_PLAIN = measured.Measured((), dict)
# What follows from the configuration alone, without error.
_FACTS = ("bundle_count", "fill", *registry.FACTS)
_OF_PHASES = ("phase_work", "phase_specific_work")
_OF_GROSS_WORK = ("gross_work_normal", "gross_work_tangential", "gross_work_ratio")


@cache
def names() -> tuple[str, ...]:
    """Return the names of all that can be asked of a run, but for parts of the drum beyond the first of a kind."""
    series = [column.name for column in registry.recorded(record=registry.RECORDINGS)]
    summary = [field.name for field in fields(Summary)]
    energies = [column for column in registry.recorded() if column.reading == "cumulative"]
    stems = [column.name.removesuffix("_work") for column in energies]
    powers = [f"{stem}{ending}" for stem in stems for ending in ("_power", "_specific_power")]
    more = ("specific_angular_momentum", *_FACTS, *measured.names(), *_OF_PHASES)
    return tuple(
        name
        for name in dict.fromkeys([*series, *summary, *powers, *more])
        if name not in _NOT_ASKED and not name.endswith("_error")
    )


def find(name: str) -> registry.Quantity:
    """Return what the registry says of a quantity that a run can be asked for.

    Raises
    ------
    ConfigError
        Where there is none of that name; with names that may be meant.
    """
    if name in names():
        return registry.quantity(name)
    own = registry.known([name])
    if own and name not in registry.declared() and own[0].reading in {"mean", "cumulative"}:
        return own[0]  # of a further part of the drum
    if own:
        raise ConfigError(_called(name), name, problem=_why_not(own[0]))
    raise ConfigError(_called(name), name, problem="is not the name of a quantity", hint=_meant(name))


def record_of(name: str) -> tuple[str, ...]:
    """Return what `run.record` must have for a quantity."""
    how = measured.measured(name)
    if how is not None and how.needs not in {"frames", "run.zone", ""}:
        return (how.needs,)
    return ("gross_work",) if name in _OF_GROSS_WORK else ()


def kept_for(name: str) -> tuple[str, ...]:
    """Return what a run has to keep for a quantity: frames, a record, visits to zones."""
    how = measured.measured(name)
    return (how.needs,) if how is not None and how.needs else record_of(name)


def needs_frames(name: str) -> bool:
    """Tell whether a quantity is measured on frames."""
    how = measured.measured(name)
    return how is not None and how.needs == "frames"


def bind(name: str, given: Sequence[Value], named: Mapping[str, Value]) -> Arguments:
    """Return the arguments of a quantity, by name, from those that a target gives.

    Raises
    ------
    ConfigError
        Where there is no such quantity, or it does not take these.
    """
    find(name)
    how = measured.measured(name) or _PLAIN
    return tuple(how.bind(_called(name), given, named).items())


def check(config: "Config", name: str, phase: str | None, arguments: Arguments = ()) -> None:
    """Refuse, before it is run, a configuration whose run will not have a quantity.

    Raises
    ------
    ConfigError
        Where there is no such phase, part or zone, or too few frames for what is measured on them.
    """
    if name in _FACTS:
        return
    how = measured.measured(name)
    if how is not None and how.check is not None:
        how.check(config, **dict(arguments))
    windows = windows_of(config, name, phase, config.run.duration)
    counts = {"baffle": config.drum.baffles.count, "rail": config.drum.liner.rail.count}
    part = re.match(rf"({'|'.join(counts)})_(\d+)_", name)
    if part is not None and int(part[2]) > counts[part[1]]:
        raise not_there(config, name)
    start, end = windows[0]
    every, slack = config.run.frame_every, 1e-3 * (end - start)
    if needs_frames(name) and math.floor((end + slack) / every) <= math.ceil((start - slack) / every):
        limit = f"small enough for two frames from {start:.4g} to {end:.4g} s: {name} is measured on them"
        raise ConfigError("run.frame_every", every, limit)


def windows_of(config: "Config", name: str, phase: str | None, ended: float) -> list[Window]:
    """Return the windows over which a quantity is taken of a run that has ended at a time.

    Raises
    ------
    ConfigError
        Where there is no such phase, or the quantity is not that of one, or of nothing else.
    """
    if phase is None:
        if name in _OF_PHASES:
            raise ConfigError(_called(name), name, problem="is that of a phase", hint=f"write {name}[PHASE]")
        return [config.run.averaging_window]
    called, intervals, how = _called(f"{name}[{phase}]"), config.rotation.intervals, measured.measured(name)
    if how is not None and how.since:
        problem = (
            f"is that of a whole run from {how.since} on, not of a phase: {how.needs!r} adds up all of it"
        )
        raise ConfigError(called, phase, problem=problem)
    if not intervals:
        raise ConfigError(called, phase, problem="is that of a phase, but the run has no rotation.phase")
    wanted = [each for each in intervals if each.name == phase]
    if not wanted and phase.isdigit() and 0 < int(phase) <= len(intervals):
        wanted = [intervals[int(phase) - 1]]
    windows = [(each.start, min(each.end, ended)) for each in wanted if each.start < ended]
    if not windows:
        known = ", ".join(dict.fromkeys(each.name for each in intervals))
        limit = f"in a phase that the run has gone through: {known}"
        raise ConfigError(called, phase, problem=f"must be {limit}")
    return windows


def not_there(config: "Config", name: str) -> ConfigError:
    """Return the error that the drum of a run does not have the part that a quantity is of."""
    problem = f"is of a part that the drum of this run does not have ({config.drum.fittings})"
    return ConfigError(_called(name), name, problem=problem)


def _why_not(quantity: registry.Quantity) -> str:
    """Say why a quantity is no target."""
    if quantity.reading == "error":
        return f"is the error of {quantity.name.removesuffix('_error')}, which comes with it"
    if quantity.name in COLUMNS:
        return "is a column of frames, not a number of a run"
    return "tells how a run was made or how steady it was, not what it does"


def _meant(name: str) -> str:
    words = set(name.split("_"))
    close = difflib.get_close_matches(name, names(), n=_MOST_MEANT)
    # Those that have all the words come first: `specific_power` may be `drum_specific_power`.
    having = [one for one in names() if words <= set(one.split("_"))]
    meant = [*dict.fromkeys([*having, *close])][:_MOST_MEANT]
    if not meant:
        return "drumrs quantities lists what a run is asked for"
    return f"did you mean {' or '.join([', '.join(meant[:-1]), meant[-1]] if meant[1:] else meant)}?"


def _called(name: str) -> str:
    return f"the target {name}"


class Readings:
    """The quantities of one run; what a function measures at once is measured once.

    Parameters
    ----------
    result
        The run.

    Attributes
    ----------
    result : Result
        The run.
    """

    def __init__(self, result: "Result") -> None:
        self.result = result
        self._measured = cache(lambda how, window, arguments: how.of(result, window, **dict(arguments)))
        self._rows = cache(lambda window: SeriesWindow.of(result.series, window).rows)
        self._mass = cache(lambda: mass_of(result.config, result.series))

    def mean(self, name: str, phase: str | None = None, arguments: Arguments = ()) -> Mean:
        """Return a quantity over the window, or over a phase of the program each time that it comes.

        A phase that comes again is averaged over its time; what is greatest is so over all of it, and energies are
        added. A value that is none, such as the drop of falls where nothing falls, is not a number.

        Raises
        ------
        ConfigError
            Where the run has no such phase, or not recorded what the quantity is made of.
        """
        for record in record_of(name):
            if record not in self.result.config.run.record:
                problem = f"lacks {record!r}, which {name} is made of"
                raise ConfigError("run.record", problem=problem, hint=f"add {record!r} to it and run again")
        if name in _FACTS:
            return self._fact(name)
        windows = windows_of(self.result.config, name, phase, float(self.result.series["time"][-1]))
        means = [self._over(name, window, arguments) for window in windows]
        return _together(means, windows, registry.quantity(name).reading, name)

    def _fact(self, name: str) -> Mean:
        config, summary = self.result.config, self.result.summary
        found = getattr(summary, name) if hasattr(summary, name) else getattr(config.derived, name)
        return Mean(math.nan if found is None else float(found), 0.0)

    def _over(self, name: str, window: Window, arguments: Arguments) -> Mean:
        how = measured.measured(name)
        found = (
            self._of_series(name, window) if how is None else self._of_measures(how, name, window, arguments)
        )
        if found is None:
            return Mean(math.nan, None)
        return found if isinstance(found, Mean) else Mean(found, None)

    def _of_measures(
        self, how: measured.Measured, name: str, window: Window, arguments: Arguments
    ) -> Mean | float | None:
        means: Means = self._measured(how, window, arguments)
        if name not in means:
            raise not_there(self.result.config, name)
        return means[name]

    def _of_series(self, name: str, window: Window) -> Mean | None:
        rows = self._rows(window)
        times = rows["time"].to_numpy()
        window = (float(times[0]), float(times[-1]))
        if name in _OF_PHASES:
            work = self._rate("drum_work", window, window[1] - window[0])
            return work if name == "phase_work" else self._of_load(work)
        told = means_with_errors(rows, window, self._mass())
        if name in told:
            value = told[name]
            return None if value is None else Mean(value, told[f"{name}_error"])
        flow = name.removesuffix("_power").removesuffix("_specific")
        for energy in (flow, f"{flow}_work"):
            if name != flow and energy in rows.columns:
                power = self._rate(energy, window)
                return self._of_load(power) if name == f"{flow}_specific_power" else power
        if name in rows.columns:
            return self._of_column(name, window)
        summary = summary_of_rows(self.result.config, rows, self._mass())
        if name not in summary:
            raise not_there(self.result.config, name)
        value = summary[name]
        return None if value is None else Mean(value, self._error_of_sum(name, window))

    def _error_of_sum(self, name: str, window: Window) -> float | None:
        """Return the error of what the summary adds up from columns of the series; `None` where it does not."""
        if name == "energy_balance_power":
            return self._rate("drum_work", window).error  # the same power by another way
        rows = SeriesWindow.of(self.result.series, window)
        terms = _SUMS.get(name, ())
        columns = [rows.column(column)[1:] for column in rows.rows.columns if column.endswith(terms)]
        return mean_with_error(sum(columns), rows.interval).error if columns else None

    def _of_column(self, name: str, window: Window) -> Mean:
        rows = SeriesWindow.of(self.result.series, window)
        reading = registry.quantity(name).reading
        if reading == "cumulative":
            return self._rate(name, window, window[1] - window[0])
        values = rows.column(name)[1:]
        if reading == "greatest":
            return Mean(float(values.max()), None)
        return mean_with_error(values, rows.interval)

    def _rate(self, energy: str, window: Window, factor: float = 1.0) -> Mean:
        return _scaled(rate_with_error(self.result.series, energy, window), factor)

    def _of_load(self, mean: Mean) -> Mean:
        return _scaled(mean, 1.0 / self._mass())


def _scaled(mean: Mean, factor: float) -> Mean:
    return Mean(mean.value * factor, None if mean.error is None else mean.error * factor)


def _together(means: Sequence[Mean], windows: Iterable[Window], reading: str, name: str) -> Mean:
    """Return what several windows tell together."""
    if len(means) == 1:
        return means[0]
    if reading == "greatest":
        return Mean(max(mean.value for mean in means), None)
    lengths = [end - start for start, end in windows]
    is_sum = reading == "cumulative" or name in _OF_PHASES
    weights = [1.0 if is_sum else length / math.fsum(lengths) for length in lengths]
    value = math.fsum(weight * mean.value for weight, mean in zip(weights, means, strict=True))
    errors = [
        weight * mean.error for weight, mean in zip(weights, means, strict=True) if mean.error is not None
    ]
    return Mean(value, math.hypot(*errors) if len(errors) == len(means) else None)
