"""Means over a window with their standard errors, from block averages."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    import polars as pl

Array = NDArray[np.float64]

# Fewest blocks from which a standard error is taken.
FEWEST_BLOCKS = 8


@dataclass(frozen=True)
class Spread:
    """The uncertainty of a mean over correlated samples.

    Attributes
    ----------
    error
        Standard error of the mean, in the unit of the values.
    correlation_time
        Integrated correlation time, in the unit of the interval.
    blocks
        Number of independent blocks that the error rests on.
    """

    error: float
    correlation_time: float
    blocks: int


@dataclass(frozen=True)
class Mean:
    """A mean over a window; `error` is its standard error, `None` where the window holds too few samples."""

    value: float
    error: float | None


def block_error(values: ArrayLike, interval: float) -> Spread | None:
    """Return the standard error of the mean of correlated samples, by the method of the core.

    Blocks are doubled in length while eight remain, and the greatest error found is kept: short blocks are
    correlated and tell too little (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461).

    Parameters
    ----------
    values
        Samples at equal intervals.
    interval
        Time between them [s].

    Returns
    -------
    Spread or None
        `None` where there are fewer than eight samples.

    Examples
    --------
    >>> from drumrs.analysis import block_error
    >>> spread = block_error([1.0, 3.0] * 8, interval=0.5)
    >>> round(spread.error, 3), spread.blocks
    (0.258, 16)
    """
    blocks = np.asarray(values, dtype=np.float64)
    if len(blocks) < FEWEST_BLOCKS:
        return None
    plain = greatest = _squared_error(blocks)
    count = len(blocks)
    while len(blocks) // 2 >= FEWEST_BLOCKS:
        blocks = _halved(blocks)
        squared = _squared_error(blocks)
        if squared > greatest:
            greatest, count = squared, len(blocks)
    inflation = greatest / plain if plain > 0.0 else 1.0
    return Spread(float(np.sqrt(greatest)), 0.5 * inflation * interval, count)


def _halved(blocks: Array) -> Array:
    """Return blocks of twice the length; an odd one at the end is left out."""
    pairs: Array = blocks[: len(blocks) // 2 * 2].reshape(-1, 2).mean(axis=1)
    return pairs


def _squared_error(values: Array) -> float:
    """Return the squared standard error of the mean of independent values."""
    return float(values.var(ddof=1)) / len(values)


def longest_blocks(values: Array) -> tuple[Array, int]:
    """Return the means over the longest blocks of which eight remain, and how many values make a block."""
    blocks, length = values, 1
    while len(blocks) // 2 >= FEWEST_BLOCKS:
        blocks, length = _halved(blocks), 2 * length
    return blocks, length


def rate_with_error(series: "pl.DataFrame", column: str, window: tuple[float, float]) -> Mean:
    """Return the mean rate of a running integral over a window, with its standard error.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    column
        A running integral such as ``"work_drum"`` [J/m].
    window
        Start and end [s]; they snap to the samples nearest to them.

    Returns
    -------
    Mean
        The rate [W/m], exact for any sampling.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two samples.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.analysis import rate_with_error
    >>> series = pl.DataFrame({"time": [0.0, 1.0, 2.0], "work_drum": [0.0, 3.0, 4.0]})
    >>> rate_with_error(series, "work_drum", (0.0, 2.0))
    Mean(value=2.0, error=None)
    """
    steps = Stretch.of(series, window)
    spread = block_error(steps.rates(column), steps.interval)
    return Mean(steps.rate(column), spread.error if spread is not None else None)


def ratio_with_error(
    series: "pl.DataFrame", numerator: str, denominator: str, window: tuple[float, float]
) -> Mean | None:
    """Return the ratio of two mean rates over a window, with its standard error.

    With R the ratio of the means, the error is that of the mean of a − R b over the mean of b: both rates enter
    block by block, and so does their covariance (the ratio estimator of sample surveys, to first order).

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    numerator, denominator
        Running integrals, such as ``"dissipated_normal"`` and ``"dissipated_sliding"`` [J/m].
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the denominator does not change.
    """
    steps = Stretch.of(series, window)
    below = steps.rate(denominator)
    if below == 0.0:
        return None
    ratio = steps.rate(numerator) / below
    spread = block_error(steps.rates(numerator) - ratio * steps.rates(denominator), steps.interval)
    return Mean(ratio, spread.error / abs(below) if spread is not None else None)


@dataclass(frozen=True, eq=False)
class Stretch:
    """The rows of a series within a window, and what happens between them."""

    rows: "pl.DataFrame"

    @classmethod
    def of(cls, series: "pl.DataFrame", window: tuple[float, float]) -> "Stretch":
        """Choose the rows from the sample nearest to the window's start to that nearest to its end."""
        times = series["time"].to_numpy()
        first, last = (int(np.abs(times - time).argmin()) if len(times) else 0 for time in window)
        if not first < last:
            raise ConfigError("window", window, "one that holds at least two samples of the run")
        return cls(series[first : last + 1])

    @property
    def times(self) -> Array:
        """Times of the rows [s]."""
        return self.rows["time"].to_numpy()

    @property
    def interval(self) -> float:
        """Mean time between rows [s]."""
        times = self.times
        return float(times[-1] - times[0]) / (len(times) - 1)

    def rates(self, column: str) -> Array:
        """Mean rates of a running integral between the rows."""
        return np.diff(self.rows[column].to_numpy()) / np.diff(self.times)

    def rate(self, column: str) -> float:
        """Mean rate of a running integral over the whole."""
        values, times = self.rows[column].to_numpy(), self.times
        return float((values[-1] - values[0]) / (times[-1] - times[0]))

    def values(self, column: str) -> Array:
        """Values that close the intervals: all rows but the first."""
        return self.rows[column].to_numpy()[1:]
