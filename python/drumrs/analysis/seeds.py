"""Means over seeds with Student's intervals; where seeds agree, the blocks inside the runs count, too."""

import math
from collections.abc import Sequence

from drumrs.analysis.blocks import FEWEST_BLOCKS
from drumrs.analysis.estimate import LEVEL, Estimate, Interval

# Blocks see nothing slower than their run: where a load switches between two states (50 % fill), the means of N/T over
# 2 s lie four of their errors from the mean of the run. So the error of one run alone is doubled.
_ALONE = 2.0
# Where fewer than one set of equal seeds in five would lie so far apart, their scatter alone gives the error.
_AGREED = 0.2
# Degrees of freedom of the error of one run.
_BLOCK_FREEDOM = FEWEST_BLOCKS - 1


def student(
    values: Sequence[float], errors: Sequence[float | None] | None = None, *, level: float = LEVEL
) -> Interval:
    """Return the mean over seeds with its confidence interval, that of `estimate`.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their standard errors, each from the blocks of its own run.
    level
        Probability that the interval holds the true mean.

    Returns
    -------
    Interval
        Of infinite width where there is one seed without an error.

    Examples
    --------
    >>> from drumrs.analysis import student
    >>> interval = student([1.0, 2.0, 3.0])
    >>> interval.mean, round(interval.half_width, 3)
    (2.0, 2.484)
    """
    return estimate(values, errors).interval(level)


def estimate(values: Sequence[float], errors: Sequence[float | None] | None = None) -> Estimate:
    """Return the mean over seeds with its error and degrees of freedom.

    The error follows from the scatter of the seeds, s²/n. Where that is no greater than the errors of the single
    runs explain (`disagreement`), those count, too: the greater of both variances is taken, with the degrees of
    freedom of both. One seed alone has the error of its run, doubled, since blocks see nothing slower than their run.
    An interval of 95 % then holds the true mean 95 times in 100 for steady loads, and 90 times at the worst.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their standard errors, each from the blocks of its own run; `None` for a run too short to have one.

    Raises
    ------
    ValueError
        Where there is no seed.

    Examples
    --------
    >>> from drumrs.analysis import estimate
    >>> found = estimate([4.0, 4.2, 3.9], errors=[0.2, 0.2, 0.2])
    >>> round(found.mean, 3), round(found.error, 3), found.freedom
    (4.033, 0.115, 23)
    """
    count = len(values)
    if not count:
        raise ValueError("values is empty, but must hold the mean of at least one seed")
    known = [error for error in errors or () if error is not None]
    mean = math.fsum(values) / count
    if count == 1:
        return Estimate(mean, _ALONE * known[0] if known else math.inf, _BLOCK_FREEDOM)
    variance = math.fsum((value - mean) ** 2 for value in values) / (count - 1)
    if len(known) < count or disagreement(values, known) < _AGREED:
        return Estimate(mean, math.sqrt(variance / count), count - 1)
    inside = math.fsum(error**2 for error in known) / count
    freedom = count - 1 + _BLOCK_FREEDOM * count
    return Estimate(mean, math.sqrt(max(variance, inside) / count), freedom)


def disagreement(values: Sequence[float], errors: Sequence[float | None]) -> float:
    """Return the probability of means as far apart as these, were they all of one steady state (a χ² test).

    It is small where each run stays in a state of its own, as a load does that seldom switches between two.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their own standard errors.

    Returns
    -------
    float
        1 where there is one seed only, or an error is not known or 0.

    Examples
    --------
    >>> from drumrs.analysis import disagreement
    >>> round(disagreement([1.0, 1.1], [0.1, 0.1]), 2), disagreement([1.0, 2.0], [0.1, 0.1]) < 1e-6
    (0.48, True)
    """
    from scipy import special

    if len(values) <= 1 or any(not error for error in errors):
        return 1.0
    weights = [1.0 / (error or 1.0) ** 2 for error in errors]
    mean = math.fsum(w * value for w, value in zip(weights, values, strict=True)) / math.fsum(weights)
    squares = math.fsum(w * (value - mean) ** 2 for w, value in zip(weights, values, strict=True))
    return float(special.chdtrc(len(values) - 1, squares))
