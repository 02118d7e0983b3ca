"""Which shapes the paper's sentences leave: weights over shapes, from what an emulator predicts of each."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drumrs.decide.emulator import Emulator
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.sentences import CIRCULATION, OBSERVABLES, POWER, RATIO, log_likelihood
from drumrs.paper.shape import BASES, HEIGHTS, ROOM, Shape, shares_of_drum

Array = NDArray[np.float64]
# What softer springs change in proportion; shares and indices of motion they change by so much.
_IN_PROPORTION = (POWER, RATIO, CIRCULATION)
# By how much, as long as no shape was run at full stiffness, and how much that may differ between shapes where one was.
_UNKNOWN, _UNKNOWN_RATIO = 0.05, 0.10
# Shapes that are worth a run at full stiffness, so many m apart in height, base and tip.
_GRID = 0.005


class Correction(NamedTuple):
    """What full stiffness changes about an observable with softer springs.

    Attributes
    ----------
    value
        A factor where `in_proportion`, else what is added.
    error
        Its standard error, the scatter between shapes included.
    in_proportion
        Which of the two it is.
    """

    value: float
    error: float
    in_proportion: bool

    def apply(self, mean: Array, error: Array) -> tuple[Array, Array]:
        """Return mean and standard error at full stiffness."""
        if self.in_proportion:
            return self.value * mean, np.hypot(self.value * error, self.error * mean)
        return mean + self.value, np.hypot(error, self.error)


Corrections = Mapping[Observable, Correction]
NONE = Correction(1.0, 0.0, in_proportion=True)


@dataclass(frozen=True, eq=False)
class Posterior:
    """Weights over shapes that were spread evenly.

    Attributes
    ----------
    shapes
        Rows of height, base and tip [m].
    weights
        Their weights, which sum to 1.
    """

    shapes: Array
    weights: Array

    @property
    def effective(self) -> float:
        """How many shapes of equal weight would tell as much."""
        return float(1.0 / np.sum(self.weights**2))

    def quantiles(self, values: Array, levels: tuple[float, ...] = (0.16, 0.5, 0.84)) -> list[float]:
        """Return quantiles of a quantity that has a value for each shape."""
        order = np.argsort(values)
        below = np.cumsum(self.weights[order]) - 0.5 * self.weights[order]
        return [float(x) for x in np.interp(levels, below, values[order])]

    def narrowing(self, values: Array) -> float:
        """Return the scatter of a quantity over what it was before anything was known."""
        mean = self.weights @ values
        return float(np.sqrt(self.weights @ (values - mean) ** 2) / values.std())

    def correlation(self, first: Array, second: Array) -> float:
        """Return the correlation of two quantities."""
        a, b = first - self.weights @ first, second - self.weights @ second
        return float(self.weights @ (a * b) / np.sqrt((self.weights @ a**2) * (self.weights @ b**2)))

    @property
    def bits(self) -> float:
        """Return how much was learned: the divergence from equal weights, in bits."""
        some = self.weights[self.weights > 0.0]
        return float(np.sum(some * np.log2(some * len(self.weights))))


def posterior(shapes: Array, known: Means, factor: float = 1.0) -> Posterior:
    """Weigh shapes by the likelihood of the sentences; before, all shapes of the region are equally likely.

    Parameters
    ----------
    shapes
        Rows of height, base and tip [m], spread evenly over the region.
    known
        Means and errors of all observables at these shapes.
    factor
        Multiplies all tolerances.
    """
    return weigh(shapes, log_likelihood(known, factor))


def weigh(shapes: Array, logarithms: Array) -> Posterior:
    """Return the posterior of a logarithm of the likelihood."""
    weights = np.exp(logarithms - logarithms.max())
    return Posterior(shapes, weights / weights.sum())


def predict(
    emulators: Mapping[Observable, Emulator], shapes: Array, bare: Means, corrections: Corrections
) -> Means:
    """Return means and errors of all observables at full stiffness, those of the bare drum included.

    Parameters
    ----------
    emulators
        Emulators of the observables with softer springs.
    shapes
        Rows of height, base and tip [m].
    bare
        What is known of the bare drum at full stiffness.
    corrections
        What full stiffness changes.
    """
    found = dict(bare)
    for one, emulator in emulators.items():
        found[one] = corrections.get(one, NONE).apply(*emulator.predict(shapes))
    return found


def provisional_corrections() -> dict[Observable, Correction]:
    """Return what full stiffness may change, as long as no shape has been run with it: nothing known, errors alone."""
    found = {}
    for one in OBSERVABLES:
        in_proportion = one.quantity in _IN_PROPORTION
        error = _UNKNOWN_RATIO if one.quantity == RATIO else _UNKNOWN
        found[one] = Correction(1.0 if in_proportion else 0.0, error, in_proportion)
    return found


def measured_corrections(soft: Means, stiff: Means) -> dict[Observable, Correction]:
    """Return corrections as means over shapes, observable by observable.

    Parameters
    ----------
    soft, stiff
        Means and errors at the same shapes, arrays of shape (n,).

    Returns
    -------
    dict
        The error is that of the mean with the scatter between shapes beyond what noise explains, which a single shape
        cannot tell: it is then 5 %.
    """
    found = {}
    for one in stiff.keys() & soft.keys():
        (before, before_error), (after, after_error) = soft[one], stiff[one]
        in_proportion = one.quantity in _IN_PROPORTION
        if in_proportion:
            changes = after / before
            noise = changes * np.hypot(before_error / before, after_error / after)
        else:
            changes, noise = after - before, np.hypot(before_error, after_error)
        explained = float(np.mean(noise**2))
        beyond = max(0.0, float(changes.var(ddof=1)) - explained) if len(changes) > 1 else _UNKNOWN**2
        error = float(np.sqrt(beyond + explained / len(changes)))
        found[one] = Correction(float(changes.mean()), error, in_proportion)
    return found


def round_shapes() -> list[Shape]:
    """Return the shapes of the region whose lengths are whole multiples of 5 mm."""
    heights, bases = (np.arange(low, high + 0.5 * _GRID, _GRID) for low, high in (HEIGHTS, BASES))
    tips = np.arange(0.0, BASES[1] + 0.5 * _GRID, _GRID)
    grid = np.stack(np.meshgrid(heights, bases, tips, indexing="ij"), axis=-1).reshape(-1, 3)
    inside = (grid[:, 2] <= grid[:, 1] + 1e-9) & (shares_of_drum(grid) <= ROOM)
    # Multiples of 5 mm as one writes them.
    return [Shape(*(round(x, 4) for x in row)) for row in grid[inside].tolist()]


def spread_over(shapes: list[Shape], logarithms: Array, count: int) -> list[Shape]:
    """Choose likely shapes that are not neighbors.

    The likeliest comes first; each further one has the greatest product of likelihood and squared distance to those
    chosen before it, so that fewer are always the first of more.
    """
    places = np.array([shape.lengths for shape in shapes])
    likelihood = np.exp(logarithms - logarithms.max())
    chosen = [int(np.argmax(likelihood))]
    distance = np.full(len(shapes), np.inf)
    while len(chosen) < min(count, len(shapes)):
        distance = np.minimum(distance, ((places - places[chosen[-1]]) ** 2).sum(axis=1))
        chosen.append(int(np.argmax(likelihood * distance)))
    return [shapes[k] for k in chosen]
