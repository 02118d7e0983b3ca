"""Evidence: numbers made of what is observed in our runs, held against what a sentence lets one expect."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# D/d of the paper's Table 1.
TABLE_1 = 20.0
# Degrees of freedom of Student's distribution, in which residuals are likely: tolerances are guesses themselves, and a
# sentence that no shape fits should not decide among shapes.
_FREEDOM = 4.0


class Observable(NamedTuple):
    """A mean of our runs: which quantity, at which fill and D/d, with baffles or without."""

    quantity: str
    fill: float
    size: float = TABLE_1
    baffles: bool = True


Means = Mapping[Observable, tuple[Array, Array]]
"""Means and their errors, each an array over shapes, or one number for the bare drum."""


@dataclass(frozen=True)
class Part:
    """One number of a sentence.

    Attributes
    ----------
    name
        What it is, in words.
    of
        What it is made of.
    value
        Function of the means of `of`.
    tolerance
        Standard deviation of the reading, in the unit of the value.
    expected
        What it should equal, or be at least.
    at_least
        Whether more is as good.
    """

    name: str
    of: tuple[Observable, ...]
    value: Callable[..., Any]
    tolerance: float
    expected: float
    at_least: bool = False

    def estimate(self, known: Means) -> tuple[Array, Array]:
        """Return the number and its standard error, from independent errors of what it is made of."""
        means, errors = zip(*(known[one] for one in self.of), strict=True)
        center = np.asarray(self.value(*means))
        steps = [
            np.asarray(self.value(*means[:k], means[k] + errors[k], *means[k + 1 :])) - center
            for k in range(len(means))
        ]
        return center, np.sqrt(sum(step**2 for step in steps))

    def residual(self, known: Means) -> tuple[Array, Array]:
        """Return the number less what is expected over the tolerance, and its standard error."""
        value, error = self.estimate(known)
        return (value - self.expected) / self.tolerance, error / self.tolerance

    def log_likelihood(self, known: Means, factor: float = 1.0) -> Array:
        """Return the logarithm of the likelihood, 0 at best, with the tolerance times a factor."""
        from scipy import special

        residual, error = self.residual(known)
        scatter = np.sqrt(factor**2 + error**2)
        if self.at_least:
            met: Array = np.log(special.stdtr(_FREEDOM, residual / scatter))
            return met
        bell: Array = -0.5 * (_FREEDOM + 1.0) * np.log1p((residual / scatter) ** 2 / _FREEDOM)
        return bell - np.log(scatter / factor)


@dataclass(frozen=True)
class Sentence:
    """A sentence of the paper, which counts once: by the part that fits it worst.

    Attributes
    ----------
    name
        What it says, in a few words.
    quote
        What the paper says.
    parts
        Its numbers.
    """

    name: str
    quote: str
    parts: tuple[Part, ...]

    def log_likelihood(self, known: Means, factor: float = 1.0) -> Array:
        """Return the logarithm of the likelihood, with all tolerances times a factor."""
        parts = [part.log_likelihood(known, factor) for part in self.parts]
        worst: Array = np.min(np.broadcast_arrays(*parts), axis=0)
        return worst

    def worst(self, known: Means) -> tuple[Part, float]:
        """Return the part that fits worst, and its residual, where each mean is one number."""
        part = min(self.parts, key=lambda part: float(np.max(part.log_likelihood(known))))
        return part, float(np.max(part.residual(known)[0]))
