"""Whether a load was steady: slopes within a window, and ratios that differ from one part of the run to the next."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import (
    FEWEST_BLOCKS,
    Array,
    SeriesWindow,
    longest_blocks,
    rate_with_error,
    ratio_with_error,
)
from drumrs.analysis.seeds import disagreement

if TYPE_CHECKING:
    import polars as pl

# The share of steady runs that one test calls unsteady: about one run in a study.
FALSE_ALARMS = 1e-3
# The load is steady after about that long [s], says the paper.
_SETTLED = 5.0
# Parts of the run that are compared are half as long as the window: long enough for an error of their own.
_PARTS_OF_A_WINDOW = 2


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
        """Whether a steady run would show so large a slope less than once in a thousand times."""
        return self.significance < FALSE_ALARMS


@dataclass(frozen=True)
class StateSwitching:
    """How a mean differs from one part of a run to the next.

    Attributes
    ----------
    spread
        Greatest mean less least, in the mean's unit.
    significance
        Probability of means so different in a steady run; small where the load switches slowly between states.
    """

    spread: float
    significance: float


def drift(series: "pl.DataFrame", window: tuple[float, float], column: str = "drum_work") -> Drift | None:
    """Test whether a rate drifts within a window.

    A straight line is fitted to the means over the longest blocks of which eight remain, and its slope compared with
    its standard error by Student's distribution.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Start and end [s].
    column
        A cumulative column; the drum's work unless given.

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
    rows = SeriesWindow.of(series, window)
    return _drift(rows.rates(column), rows.interval, rate_with_error(series, column, window).value)


def ratio_drift(
    series: "pl.DataFrame", numerator: str, denominator: str, window: tuple[float, float]
) -> Drift | None:
    """Test whether the ratio of two rates drifts within a window, as `drift` does for one rate.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    numerator, denominator
        Cumulative columns.
    window
        Start and end [s].

    Returns
    -------
    Drift or None
        `None` where the denominator does not change, or the window holds fewer than eight intervals.
    """
    rows, ratio = SeriesWindow.of(series, window), ratio_with_error(series, numerator, denominator, window)
    if ratio is None:
        return None
    below = rate_with_error(series, denominator, window).value
    # To first order the ratio departs from its mean by this.
    departures = (rows.rates(numerator) - ratio.value * rows.rates(denominator)) / below
    return _drift(departures, rows.interval, ratio.value)


def _drift(values: Array, interval: float, mean: float) -> Drift | None:
    # Not `scipy.stats.linregress`: that module takes every worker of a sweep a second to load.
    from scipy import special

    if len(values) < FEWEST_BLOCKS:
        return None
    blocks, length = longest_blocks(values)
    if np.ptp(blocks) == 0.0:
        return Drift(0.0, 0.0, 1.0)
    times = length * interval * np.arange(len(blocks))
    coefficients, covariance = np.polyfit(times, blocks, 1, cov=True)
    slope, error = float(coefficients[0]), max(float(covariance[0, 0]) ** 0.5, np.finfo(float).tiny)
    change = slope * interval * len(values) / abs(mean) if mean else 0.0
    return Drift(slope, change, 2.0 * float(special.stdtr(len(blocks) - 2, -abs(slope) / error)))


def state_switching(
    series: "pl.DataFrame",
    numerator: str,
    denominator: str,
    window: tuple[float, float],
    settled: float = _SETTLED,
) -> StateSwitching | None:
    """Test whether a load switches slowly between states that differ in a ratio.

    Each state may look steady over a window. So the run since the load settled is cut into parts half as long as
    the window, and their ratios are compared by their own errors (a χ² test).

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    numerator, denominator
        Cumulative columns.
    window
        Start and end [s]; the last part ends with it.
    settled
        When the first part may start [s].

    Returns
    -------
    StateSwitching or None
        `None` where there is no time but the window, or a part holds too few samples.
    """
    length = (window[1] - window[0]) / _PARTS_OF_A_WINDOW
    count = int((window[1] - settled) / length + 1e-9)
    if count <= _PARTS_OF_A_WINDOW:
        return None
    ends = [window[1] - length * k for k in range(count)]
    ratios = [ratio_with_error(series, numerator, denominator, (end - length, end)) for end in ends]
    known = [ratio for ratio in ratios if ratio is not None and ratio.error]
    if len(known) < count:
        return None
    values = [ratio.value for ratio in known]
    return StateSwitching(max(values) - min(values), disagreement(values, [ratio.error for ratio in known]))
