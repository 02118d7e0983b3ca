"""Specific power from the balance of moments, in any code: gravity's torque and the change of angular momentum."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis import Estimate, Mean, block_error

Array = NDArray[np.float64]

GRAVITY = 9.81
# Two codes are at odds where their difference leaves the interval that holds it so often.
LEVEL = 0.99


@dataclass(frozen=True, eq=False)
class Trace:
    """What a run tells, interval by interval.

    Attributes
    ----------
    times
        Ends of the intervals [s], shape (n + 1,).
    power
        Mean specific power of each interval [W/kg], shape (n,): Ω (g x + dL/dt), L the angular momentum per mass.
    x, y
        Mean center of mass of each interval [m], shape (n,).
    """

    times: Array
    power: Array
    x: Array
    y: Array

    @classmethod
    def of_samples(cls, times: Array, samples: Array, angular_velocity: float) -> "Trace":
        """Take samples of x, y [m] and of the angular momentum per mass about the axis [m²/s], shape (n + 1, 3)."""
        x, y = (0.5 * (samples[1:, axis] + samples[:-1, axis]) for axis in (0, 1))
        change = np.diff(samples[:, 2]) / np.diff(times)
        return cls(times, angular_velocity * (GRAVITY * x + change), x, y)


@dataclass(frozen=True)
class Measured:
    """Means over a window with their standard errors: specific power [W/kg] and center of mass [m]."""

    power: Mean
    x: Mean
    y: Mean

    @classmethod
    def over(cls, trace: Trace, window: tuple[float, float]) -> "Measured":
        """Average over the intervals that lie in a window [s]."""
        slack = 0.5 * float(trace.times[1] - trace.times[0])
        start, end = window
        if trace.times[0] > start + slack or trace.times[-1] < end - 2.0 * slack:
            raise ValueError(
                f"the run covers {trace.times[0]:.4g} to {trace.times[-1]:.4g} s, not {window} s"
            )
        inside = (trace.times[:-1] > start - slack) & (trace.times[1:] < end + slack)
        interval = 2.0 * slack
        return cls(*(_mean(values[inside], interval) for values in (trace.power, trace.x, trace.y)))


def _mean(values: Array, interval: float) -> Mean:
    spread = block_error(values, interval)
    return Mean(float(values.mean()), spread.error if spread is not None else None)


def agree(ours: Estimate, theirs: Estimate) -> bool:
    """Say whether two codes agree within the errors of both.

    Examples
    --------
    >>> from drumrs.analysis import Estimate
    >>> agree(Estimate(4.1, 0.05, 20), Estimate(4.0, 0.05, 20))
    True
    >>> agree(Estimate(4.5, 0.05, 20), Estimate(4.0, 0.05, 20))
    False
    """
    difference = (ours - theirs).interval(LEVEL)
    return difference.low <= 0.0 <= difference.high
