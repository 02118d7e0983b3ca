"""Means over seeds: Student's intervals, helped by the blocks inside the runs where seeds agree."""

import math
from collections.abc import Sequence

from drumrs.analysis.blocks import FEWEST_BLOCKS
from drumrs.analysis.estimate import LEVEL, Estimate, Interval

# Blocks see nothing slower than their run: where a load passes between two states (50 % fill), the ratio's means over
# 2 s lie four of their errors from the mean of the run. So the error of one run alone is doubled.
_ALONE = 2.0
# Seeds further apart than one set in five would be, were they alike, have only their scatter for an error.
_AGREED = 0.2
_BLOCK_FREEDOM = FEWEST_BLOCKS - 1


def student(
    values: Sequence[float], errors: Sequence[float | None] | None = None, *, level: float = LEVEL
) -> Interval:
    """Return the mean over seeds and the half width of Student's interval.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their standard errors from their own blocks; see `estimate`.
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

    The error is that of the seeds' scatter. Where they are no further apart than their own errors explain, the
    blocks behind those say something too: the greater of both variances is taken, with the freedom of both.
    One seed alone has the error from its own blocks, doubled, since blocks see nothing slower than their run.
    So an interval of 95 % holds the mean so often for steady loads, and nine times in ten at the worst.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their standard errors; `None` for a run too short to have one.

    Raises
    ------
    ValueError
        Where there is no seed.
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
    """Return the probability of seeds as far apart as these, were they runs of one steady state.

    Small where single runs keep to states of their own, as a load does that lasts for long in one of two states.

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
    """
    from scipy import special

    if len(values) <= 1 or any(not error for error in errors):
        return 1.0
    weights = [1.0 / (error or 1.0) ** 2 for error in errors]
    mean = math.fsum(w * value for w, value in zip(weights, values, strict=True)) / math.fsum(weights)
    squares = math.fsum(w * (value - mean) ** 2 for w, value in zip(weights, values, strict=True))
    return float(special.chdtrc(len(values) - 1, squares))
