"""Runs that go on until their mean power is known well enough."""

import math
from dataclasses import dataclass

from drumrs.errors import ConfigError
from drumrs.run_folder import RunFolder
from drumrs.runs import run_to_end
from drumrs.simulation import Simulation

# A longer window is asked for by the error found, and a little more; never more than twice the window at once, since
# that error is uncertain itself.
_MARGIN, _MOST = 1.1, 2.0
# Where no limit is given, so many times the duration.
LIMIT = 10.0


@dataclass(frozen=True)
class Goal:
    """How well the specific power is to be known, and how long that may take.

    Attributes
    ----------
    precision
        Standard error over the specific power.
    limit
        Simulated time at which to give up [s].
    """

    precision: float
    limit: float

    @classmethod
    def of(cls, precision: float, limit: float | None, duration: float) -> "Goal":
        """Check what was asked for; the limit is ten times the duration unless given.

        Raises
        ------
        ConfigError
            Where one of them is not accepted.
        """
        if not 0.0 < precision < 1.0:
            raise ConfigError("--until", precision, "between 0 and 1: the error over the power")
        if limit is None:
            return cls(precision, LIMIT * duration)
        if not duration <= limit < math.inf:
            raise ConfigError("--limit", limit, f"at least run.duration = {duration}", bound=duration)
        return cls(precision, limit)


def run_until_precise(
    simulation: Simulation, goal: Goal, folder: RunFolder | None = None, *, progress: bool = True
) -> str:
    """Run to the end of the duration, and on until the goal or its limit; return what was reached, in a sentence.

    When to look is decided by the results alone: a run that was interrupted ends like one that was not.

    Parameters
    ----------
    simulation
        What to run; its configuration ends where the run does.
    goal
        What to reach.
    folder
        Where to keep records and checkpoints.
    progress
        Whether to show progress.
    """
    run_to_end(simulation, folder, progress=progress)
    while (end := _next_end(simulation, goal)) is not None:
        simulation.extend_to(end)
        run_to_end(simulation, folder, label=f"on to {end:.4g} s", progress=progress)
    reached = _precision(simulation)
    found = f"{100.0 * reached:.2g} %" if math.isfinite(reached) else "not known"
    asked, time = f"{100.0 * goal.precision:.3g} %", f"t = {simulation.time:.4g} s"
    words = f"the standard error of the specific power is {found} of it"
    if reached <= goal.precision:
        return f"at {time} {words} ({asked} was asked for)"
    return f"the limit of {goal.limit:.4g} s is reached, but {words}, not {asked}"


def _precision(simulation: Simulation) -> float:
    """Return the standard error over the specific power; infinite where there is none."""
    summary = simulation.summary()
    if summary.drum_specific_power_error is None or summary.drum_specific_power == 0.0:
        return math.inf
    return summary.drum_specific_power_error / abs(summary.drum_specific_power)


def _next_end(simulation: Simulation, goal: Goal) -> float | None:
    """Return when to look again [s]; `None` where the goal or its limit is reached."""
    start, end = simulation.config.run.averaging_window
    found = _precision(simulation)
    if found <= goal.precision or end >= goal.limit:
        return None
    # Errors of means fall with the root of the time.
    factor = min(max(_MARGIN * (found / goal.precision) ** 2, _MARGIN), _MOST)
    return min(start + factor * (end - start), goal.limit)
