"""Student's and the χ² distribution, in closed form for whole degrees of freedom."""

import math
from functools import cache


@cache
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
    for _ in range(60):
        middle = 0.5 * (low + high)
        if student_probability(middle, freedom) < level:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def student_probability(t: float, freedom: int) -> float:
    """Return the probability that a variable of Student's distribution lies within ±t.

    After Abramowitz & Stegun, Handbook of Mathematical Functions, 26.7.3 and 26.7.4.
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


def chi_square_tail(square: float, freedom: int) -> float:
    """Return the probability that a χ² variable exceeds `square` (the same book, 26.4.4 and 26.4.5)."""
    half = square / 2.0
    order = 0.5 if freedom % 2 else 1.0
    tail = math.erfc(math.sqrt(half)) if freedom % 2 else math.exp(-half)
    while order < freedom / 2.0:
        tail += math.exp(order * math.log(half) - half - math.lgamma(order + 1.0)) if half > 0.0 else 0.0
        order += 1.0
    return tail
