"""`Estimate`: a mean with its error and degrees of freedom, and what may be calculated with it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

# Probability that an interval holds the true mean, unless another is asked for.
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


@dataclass(frozen=True)
class Estimate:
    """A mean with its standard error; means of independent runs may be subtracted and divided.

    Attributes
    ----------
    mean
        The mean.
    error
        Its standard error; infinite where nothing is known of it.
    freedom
        Degrees of freedom of that error.

    Examples
    --------
    >>> from drumrs.analysis import Estimate
    >>> difference = Estimate(4.0, 0.3, 2) - Estimate(3.0, 0.4, 2)
    >>> difference.mean, difference.error, difference.freedom
    (1.0, 0.5, 3)
    """

    mean: float
    error: float
    freedom: int

    def interval(self, level: float = LEVEL) -> Interval:
        """Return the confidence interval by Student's distribution: it holds the true mean with probability `level`."""
        from scipy import special

        if not self.error:
            return Interval(self.mean, 0.0)
        return Interval(self.mean, float(special.stdtrit(self.freedom, 0.5 + 0.5 * level)) * self.error)

    def __sub__(self, other: "Estimate") -> "Estimate":
        """Return the difference of two independent means."""
        return combine(self.mean - other.mean, [(1.0, self), (-1.0, other)])

    def __truediv__(self, other: "Estimate") -> "Estimate":
        """Return the ratio of two independent means, to first order in their errors.

        Raises
        ------
        ZeroDivisionError
            Where the other mean is 0.
        """
        ratio = self.mean / other.mean
        return combine(ratio, [(1.0 / other.mean, self), (-ratio / other.mean, other)])


def combine(mean: float, parts: Sequence[tuple[float, Estimate]]) -> Estimate:
    """Return the estimate of a function of independent means, to first order in their errors.

    Parameters
    ----------
    mean
        Value of the function.
    parts
        Derivative of the function by each mean, and the mean.

    Returns
    -------
    Estimate
        Errors add in squares; degrees of freedom are those of Welch and Satterthwaite, rounded down.

    Examples
    --------
    >>> from drumrs.analysis import Estimate, combine
    >>> a, b = Estimate(2.0, 0.3, 5), Estimate(3.0, 0.1, 5)
    >>> round(combine(a.mean * b.mean, [(b.mean, a), (a.mean, b)]).error, 2)
    0.92
    """
    shares = [(weight * part.error) ** 2 if weight else 0.0 for weight, part in parts]
    total = math.fsum(shares)
    if not math.isfinite(total):
        return Estimate(mean, math.inf, 1)
    squares = math.fsum(share**2 / part.freedom for share, (_, part) in zip(shares, parts, strict=True))
    freedom = int(total**2 / squares * (1.0 + 1e-12)) if squares else min(part.freedom for _, part in parts)
    return Estimate(mean, math.sqrt(total), max(freedom, 1))


def mean_of(estimates: Sequence[Estimate]) -> Estimate:
    """Return the mean of independent estimates, all of equal weight."""
    count = len(estimates)
    mean = math.fsum(one.mean for one in estimates) / count
    return combine(mean, [(1.0 / count, one) for one in estimates])
