"""Means over a window with their standard errors, from block averages. The core computes them, as for the summary."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import _core

if TYPE_CHECKING:
    import polars as pl

Array = NDArray[np.float64]

# Fewest blocks from which a standard error is taken.
FEWEST_BLOCKS = _core.FEWEST_BLOCKS


@dataclass(frozen=True)
class BlockError:
    """The standard error of a mean over correlated samples.

    Attributes
    ----------
    error
        Standard error of the mean, in the unit of the values.
    correlation_time
        Integrated correlation time, in the unit of the interval.
    blocks
        Number of blocks that the error was taken from.
    """

    error: float
    correlation_time: float
    blocks: int


@dataclass(frozen=True)
class Mean:
    """A mean over a window; `error` is its standard error, `None` where the window holds too few samples."""

    value: float
    error: float | None


def block_error(values: ArrayLike, interval: float) -> BlockError | None:
    """Return the standard error of the mean of correlated samples.

    Blocks are doubled in length while eight remain, and the greatest error found is kept: short blocks are
    correlated and tell too little (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461).

    Parameters
    ----------
    values
        Samples at equal intervals, shape (n,).
    interval
        Time between them [s].

    Returns
    -------
    BlockError or None
        `None` where there are fewer than eight samples.

    Examples
    --------
    >>> from drumrs.analysis import block_error
    >>> found = block_error([1.0, 3.0] * 8, interval=0.5)
    >>> round(found.error, 3), found.blocks
    (0.258, 16)
    """
    found = _core.block_error(_plain(values), interval)
    return BlockError(*found) if found is not None else None


def mean_with_error(values: ArrayLike, interval: float) -> Mean:
    """Return the mean of samples at equal intervals, with its standard error.

    Parameters
    ----------
    values
        Samples, shape (n,), one at least.
    interval
        Time between them [s].

    Examples
    --------
    >>> from drumrs.analysis import mean_with_error
    >>> mean_with_error([1.0, 2.0, 6.0], interval=0.5)
    Mean(value=3.0, error=None)
    """
    return _mean(*_core.mean_sampled(_plain(values), interval))


def rate_with_error(series: "pl.DataFrame", column: str, window: tuple[float, float]) -> Mean:
    """Return the mean rate of a cumulative column over a window, with its standard error.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    column
        An integral since t = 0 such as ``"drum_work"`` [J/m].
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
    >>> series = pl.DataFrame({"time": [0.0, 1.0, 2.0], "drum_work": [0.0, 3.0, 4.0]})
    >>> rate_with_error(series, "drum_work", (0.0, 2.0))
    Mean(value=2.0, error=None)
    """
    rows = SeriesWindow.of(series, window)
    return _mean(*_core.mean_rate(rows.times, rows.column(column)))


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
        Cumulative columns, such as ``"dissipated_normal"`` and ``"dissipated_sliding"`` [J/m].
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the denominator does not change.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two samples.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.analysis import ratio_with_error
    >>> series = pl.DataFrame({"time": [0.0, 1.0], "normal": [0.0, 3.0], "sliding": [1.0, 3.0]})
    >>> ratio_with_error(series, "normal", "sliding", (0.0, 1.0))
    Mean(value=1.5, error=None)
    """
    rows = SeriesWindow.of(series, window)
    found = _core.mean_ratio(rows.times, rows.column(numerator), rows.column(denominator))
    return _mean(*found) if found is not None else None


def summary_of(
    rows: "pl.DataFrame", parts: Sequence[str], record: Sequence[str], mass: float
) -> dict[str, float | None]:
    """Return the numbers of a `Summary` that a part of a series tells, from its first row to its last.

    Parameters
    ----------
    rows
        Two rows at least, with the columns that are recorded, in their order.
    parts
        The drum's parts, as columns name them.
    record
        What is recorded on request.
    mass
        Mass of the load per meter of depth [kg/m].
    """
    values = np.ascontiguousarray(rows.to_numpy(), dtype=np.float64)
    return _core.summary(list(parts), "gross_work" in record, values, mass)


def ratio_of_sums(numerators: Array, denominators: Array) -> Mean | None:
    """Return the ratio of two sums over equal intervals, with the error that `ratio_with_error` takes."""
    sums = (np.concatenate([[0.0], np.cumsum(terms)]) for terms in (numerators, denominators))
    found = _core.mean_ratio(np.arange(len(numerators) + 1.0), *sums)
    return _mean(*found) if found is not None else None


def longest_blocks(values: Array) -> tuple[Array, int]:
    """Return the means over the longest blocks of which eight remain, and how many values make a block."""
    length = 1 << max((len(values) // FEWEST_BLOCKS).bit_length() - 1, 0)
    count = len(values) // length
    blocks: Array = values[: count * length].reshape(count, length).mean(axis=1)
    return blocks, length


@dataclass(frozen=True, eq=False)
class SeriesWindow:
    """The rows of a series within a window, from the sample nearest to its start to that nearest to its end."""

    rows: "pl.DataFrame"

    @classmethod
    def of(cls, series: "pl.DataFrame", window: tuple[float, float]) -> "SeriesWindow":
        """Choose the rows.

        Raises
        ------
        ConfigError
            Where they are fewer than two.
        """
        first, last = _core.window(_plain(series["time"]), *window)
        return cls(series[first : last + 1])

    @property
    def times(self) -> Array:
        """Times of the rows [s]."""
        return self.column("time")

    @property
    def interval(self) -> float:
        """Mean time between rows [s]."""
        times = self.times
        return float(times[-1] - times[0]) / (len(times) - 1)

    def column(self, name: str) -> Array:
        """Values of a column, shape (rows,)."""
        return _plain(self.rows[name])

    def rates(self, cumulative: str) -> Array:
        """Mean rates of a cumulative column from row to row, shape (rows − 1,)."""
        return np.diff(self.column(cumulative)) / np.diff(self.times)


def _mean(value: float, found: tuple[float, float, int] | None) -> Mean:
    return Mean(value, found[0] if found is not None else None)


def _plain(values: ArrayLike) -> Array:
    """Return numbers as the core takes them: in a row, of double precision."""
    return np.ascontiguousarray(values, dtype=np.float64)
