"""Means over seeds, with Student's intervals."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from drumrs.analysis.blocks import FEWEST_BLOCKS

LEVEL = 0.95


@dataclass(frozen=True)
class Interval:
    """A mean and the half width of its confidence interval; infinite where nothing is known of its error."""

    mean: float
    half_width: float

    @property
    def low(self) -> float:
        """Lower end."""
        return self.mean - self.half_width

    @property
    def high(self) -> float:
        """Upper end."""
        return self.mean + self.half_width


def student(
    values: Sequence[float], errors: Sequence[float | None] | None = None, *, level: float = LEVEL
) -> Interval:
    """Return the mean over seeds and the half width of Student's interval.

    One seed alone is given the error from its own blocks, which rests on eight of them or more.

    Parameters
    ----------
    values
        One mean a seed.
    errors
        Their own standard errors, which count where there is one seed only.
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
    count = len(values)
    if not count:
        raise ValueError("values is empty, but must hold the mean of at least one seed")
    mean = math.fsum(values) / count
    if count > 1:
        variance = math.fsum((value - mean) ** 2 for value in values) / (count - 1)
        return Interval(mean, student_quantile(level, count - 1) * math.sqrt(variance / count))
    error = errors[0] if errors else None
    if error is None:
        return Interval(mean, math.inf)
    return Interval(mean, student_quantile(level, FEWEST_BLOCKS - 1) * error)


def student_quantile(level: float, freedom: int) -> float:
    """Return t such that a variable of Student's distribution lies within ±t with probability `level`.

    Examples
    --------
    >>> from drumrs.analysis import student_quantile
    >>> round(student_quantile(0.95, 2), 3)
    4.303
    """
    low, high = 0.0, 1.0
    while student_probability(high, freedom) < level:
        high *= 2.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        if student_probability(middle, freedom) < level:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def student_probability(t: float, freedom: int) -> float:
    """Return the probability that a variable of Student's distribution lies within ±t.

    In closed form for whole degrees of freedom (Abramowitz & Stegun, 26.7.3 and 26.7.4).
    """
    angle = math.atan(t / math.sqrt(freedom))
    sine, cosine = math.sin(angle), math.cos(angle)
    if freedom % 2:
        term, total = cosine, cosine if freedom > 1 else 0.0
        for k in range(3, freedom, 2):
            term *= cosine * cosine * (k - 1) / k
            total += term
        return 2.0 / math.pi * (angle + sine * total)
    term = total = 1.0
    for k in range(2, freedom, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    return sine * total


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
    if len(values) <= 1 or any(not error for error in errors):
        return 1.0
    weights = [1.0 / (error or 1.0) ** 2 for error in errors]
    mean = math.fsum(w * value for w, value in zip(weights, values, strict=True)) / math.fsum(weights)
    squares = math.fsum(w * (value - mean) ** 2 for w, value in zip(weights, values, strict=True))
    return _chi_square_tail(squares, len(values) - 1)


def _chi_square_tail(square: float, freedom: int) -> float:
    """Return the probability that a χ² variable exceeds `square` (Abramowitz & Stegun, 26.4.4 and 26.4.5)."""
    half = square / 2.0
    order = 0.5 if freedom % 2 else 1.0
    tail = math.erfc(math.sqrt(half)) if freedom % 2 else math.exp(-half)
    while order < freedom / 2.0:
        tail += math.exp(order * math.log(half) - half - math.lgamma(order + 1.0)) if half > 0.0 else 0.0
        order += 1.0
    return tail
