"""Whether a load was steady: slopes within a window, and means that differ from one stretch of time to the next."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import FEWEST_BLOCKS, Array, Stretch, longest_blocks, ratio_with_error
from drumrs.analysis.quantiles import student_probability
from drumrs.analysis.seeds import disagreement

if TYPE_CHECKING:
    import polars as pl

# So seldom is a steady run called unsteady by one test: about once in a study.
FALSE_ALARMS = 1e-3
# The load is steady after about that long [s], says the paper.
_SETTLED = 5.0
# Stretches of time that are compared are half as long as the window: long enough for an error of their own.
_PER_WINDOW = 2


@dataclass(frozen=True)
class Drift:
    """How a mean changes within its window.

    Attributes
    ----------
    slope
        Slope of the straight line through the block means, in the mean's unit per second.
    change
        What the slope makes of the mean from the window's start to its end, over the mean's magnitude.
    significance
        Probability of so large a slope in a steady run; small means drift.
    drifting
        Whether it is below one in a thousand.
    """

    slope: float
    change: float
    significance: float

    @property
    def drifting(self) -> bool:
        """Whether a steady run would hardly do this."""
        return self.significance < FALSE_ALARMS


@dataclass(frozen=True)
class Wandering:
    """How a mean differs from one stretch of time to the next.

    Attributes
    ----------
    spread
        Greatest less least.
    significance
        Probability of means so different in a steady run; small means that the load passes between states.
    """

    spread: float
    significance: float


def drift(series: "pl.DataFrame", window: tuple[float, float], column: str = "drum_work") -> Drift | None:
    """Test whether a rate drifts within a window.

    A straight line is drawn through the means over the longest blocks of which eight remain, and its slope
    compared with its standard error by Student's distribution.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Start and end [s].
    column
        A running integral; the drum's work unless given.

    Returns
    -------
    Drift or None
        `None` where the window holds fewer than eight intervals.

    Examples
    --------
    >>> import numpy as np, polars as pl
    >>> from drumrs.analysis import drift
    >>> time = np.linspace(0.0, 10.0, 501)
    >>> warming = pl.DataFrame({"time": time, "drum_work": time + 0.1 * time**2 + 0.01 * np.sin(40.0 * time)})
    >>> drift(warming, (0.0, 10.0)).drifting
    True
    """
    stretch = Stretch.of(series, window)
    return _drift(stretch.rates(column), stretch.interval, stretch.rate(column))


def ratio_drift(
    series: "pl.DataFrame", numerator: str, denominator: str, window: tuple[float, float]
) -> Drift | None:
    """Test whether the ratio of two rates drifts within a window, as `drift` does for one."""
    stretch = Stretch.of(series, window)
    below = stretch.rate(denominator)
    if below == 0.0:
        return None
    ratio = stretch.rate(numerator) / below
    # To first order the ratio departs from its mean by this.
    departures = (stretch.rates(numerator) - ratio * stretch.rates(denominator)) / below
    return _drift(departures, stretch.interval, ratio)


def _drift(values: Array, interval: float, mean: float) -> Drift | None:
    if len(values) < FEWEST_BLOCKS:
        return None
    blocks, length = longest_blocks(values)
    times = length * interval * (np.arange(len(blocks)) - (len(blocks) - 1) / 2.0)
    squares = float(times @ times)
    slope = float(times @ blocks) / squares
    rest = blocks - blocks.mean() - slope * times
    freedom = len(blocks) - 2
    error = float(np.sqrt(rest @ rest / freedom / squares))
    change = slope * interval * len(values) / abs(mean) if mean else 0.0
    return Drift(slope, change, _significance(slope, error, freedom))


def _significance(slope: float, error: float, freedom: int) -> float:
    if error == 0.0:
        return 1.0 if slope == 0.0 else 0.0
    return 1.0 - student_probability(abs(slope) / error, freedom)


def wandering(
    series: "pl.DataFrame",
    numerator: str,
    denominator: str,
    window: tuple[float, float],
    settled: float = _SETTLED,
) -> Wandering | None:
    """Test whether a ratio differs from one stretch of time to the next.

    A load may pass slowly between states, each of them steady over a window. So the time since it settled is
    cut into stretches half as long as the window, and their ratios are compared by their own errors.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    numerator, denominator
        Running integrals.
    window
        Start and end [s]; the last stretch ends with it.
    settled
        When the first may start [s].

    Returns
    -------
    Wandering or None
        `None` where there is no time but the window, or too few samples.
    """
    length = (window[1] - window[0]) / _PER_WINDOW
    count = int((window[1] - settled) / length + 1e-9)
    if count <= _PER_WINDOW:
        return None
    ends = [window[1] - length * k for k in range(count)]
    ratios = [ratio_with_error(series, numerator, denominator, (end - length, end)) for end in ends]
    known = [ratio for ratio in ratios if ratio is not None and ratio.error]
    if len(known) < count:
        return None
    values = [ratio.value for ratio in known]
    return Wandering(max(values) - min(values), disagreement(values, [ratio.error for ratio in known]))
