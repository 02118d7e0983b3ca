"""Whether a window was steady: the slope of its block means against that slope's error."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import FEWEST_BLOCKS, Stretch, longest_blocks
from drumrs.analysis.seeds import student_probability

if TYPE_CHECKING:
    import polars as pl

# One steady run in a hundred is called drifting.
_FALSE_ALARMS = 0.01


@dataclass(frozen=True)
class Drift:
    """How the mean of a window changes within it.

    Attributes
    ----------
    slope
        Slope of the straight line through the block means, in the rate's unit per second.
    change
        What the slope makes of the mean from the window's start to its end, over the mean's magnitude.
    significance
        Probability of so large a slope in a steady run; small means drift.
    drifting
        Whether it is below one in a hundred.
    """

    slope: float
    change: float
    significance: float
    drifting: bool


def drift(series: "pl.DataFrame", window: tuple[float, float], column: str = "work_drum") -> Drift | None:
    """Test whether a rate drifts within a window.

    A straight line is drawn through the means over the longest blocks of which eight remain, and its slope
    compared with its standard error by Student's distribution. A load that changes its state for good between
    two blocks gives a slope as well; one that changed before the window does not.

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
    >>> warming = pl.DataFrame({"time": time, "work_drum": time + 0.1 * time**2 + 0.01 * np.sin(40.0 * time)})
    >>> drift(warming, (0.0, 10.0)).drifting
    True
    """
    steps = Stretch.of(series, window)
    rates = steps.rates(column)
    if len(rates) < FEWEST_BLOCKS:
        return None
    blocks, length = longest_blocks(rates)
    times = length * steps.interval * (np.arange(len(blocks)) - (len(blocks) - 1) / 2.0)
    squares = float(times @ times)
    slope = float(times @ blocks) / squares
    rest = blocks - blocks.mean() - slope * times
    freedom = len(blocks) - 2
    error = float(np.sqrt(rest @ rest / freedom / squares))
    significance = _significance(slope, error, freedom)
    mean = abs(steps.rate(column))
    change = slope * steps.interval * len(rates) / mean if mean > 0.0 else 0.0
    return Drift(slope, change, significance, significance < _FALSE_ALARMS)


def _significance(slope: float, error: float, freedom: int) -> float:
    if error == 0.0:
        return 1.0 if slope == 0.0 else 0.0
    return 1.0 - student_probability(abs(slope) / error, freedom)
