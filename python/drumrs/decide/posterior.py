"""`Posterior`: which parameters measured numbers leave, by emulators of what the model says at other parameters.

Knows nothing of drums: a function gives values and errors of all outputs at points of a space.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drumrs.decide.emulator import Array, Emulator, one_thread
from drumrs.decide.space import Space
from drumrs.errors import ConfigError

# Walkers, steps that are forgotten, steps that are kept, and every how manyth of these.
_WALKERS, _FORGOTTEN, _KEPT, _EVERY = 32, 150, 400, 4
# Points among which walkers begin, by their likelihood.
_SPREAD = 2048
# Part of the runs that are spread over the whole space; the others follow what these leave.
_FIRST = 2 / 3


@dataclass(frozen=True, eq=False)
class Posterior:
    """What is known of parameters after a fit, all values within their ranges being equally likely before.

    Attributes
    ----------
    space
        The parameters.
    emulators
        One an output of the model; those that were measured come first.
    values, errors
        What was measured, and its standard errors with the model's discrepancy.
    samples
        Points of the space, drawn with the probability that the measurements leave, shape (n, k).
    density
        Logarithms of that probability's density, up to a constant, shape (n,).
    """

    space: Space
    emulators: tuple[Emulator, ...]
    values: Array
    errors: Array
    samples: Array
    density: Array

    @classmethod
    def of(cls, space: Space, emulators: tuple[Emulator, ...], values: Array, errors: Array) -> "Posterior":
        """Draw samples by the affine-invariant ensemble sampler of emcee (Foreman-Mackey et al. 2013)."""
        import emcee

        def density(points: Array) -> Array:
            return log_density(space, emulators, values, errors, points)

        rng = np.random.default_rng(1)
        with one_thread():
            begin = _likely(space, emulators, values, errors, _WALKERS)
            # Walkers at one point would stay on it.
            begin = np.clip(begin + 0.02 * rng.standard_normal(begin.shape), 0.001, 0.999)
            start = emcee.State(begin, random_state=np.random.RandomState(1).get_state())
            sampler = emcee.EnsembleSampler(_WALKERS, len(space), density, vectorize=True)
            sampler.run_mcmc(start, _FORGOTTEN + _KEPT, skip_initial_state_check=True)
        kept = {"discard": _FORGOTTEN, "thin": _EVERY, "flat": True}
        samples, densities = sampler.get_chain(**kept), sampler.get_log_prob(**kept)
        return cls(space, emulators, values, errors, samples, densities)

    def contains(self, point: Array, level: float = 0.9) -> bool:
        """Tell whether a point lies in the region of highest density that has a probability.

        Parameters
        ----------
        point
            Place of each parameter, from 0 to 1.
        level
            The probability.
        """
        own = log_density(self.space, self.emulators, self.values, self.errors, point[None])[0]
        return bool(own >= np.quantile(self.density, 1.0 - level))

    def quantiles(self, levels: tuple[float, ...] = (0.05, 0.5, 0.95)) -> Array:
        """Return quantiles of each parameter in its unit, shape (levels, k)."""
        return self.in_units(np.quantile(self.samples, levels, axis=0))

    def in_units(self, points: Array) -> Array:
        """Return the parameters' values at points."""
        low, high = (
            np.array([getattr(one, end) for one in self.space.parameters]) for end in ("low", "high")
        )
        found: Array = low + (high - low) * points
        return found

    def narrowing(self) -> Array:
        """Return the scatter of each parameter over what it was before anything was measured, shape (k,)."""
        scatter: Array = self.samples.std(axis=0) * np.sqrt(12.0)
        return scatter

    def correlation(self) -> Array:
        """Return the correlation of the parameters' ranks (Spearman), shape (k, k)."""
        ranks = self.samples.argsort(axis=0).argsort(axis=0)
        found: Array = np.atleast_2d(np.corrcoef(ranks.T))
        return found

    def predict(self, output: int) -> tuple[float, float, float]:
        """Return mean and scatter of an output over the posterior, and the emulator's own error."""
        means, errors = self.emulators[output].predict(self.space.features(self.samples))
        return float(means.mean()), float(means.std()), float(np.sqrt(np.mean(errors**2)))

    def information(self, output: int, error: float) -> float:
        """Return how much measuring an output would tell of the parameters, in bits.

        For normal distributions it is ½ log₂(1 + s²/e²): s the scatter of the output over the posterior, e the error of
        the measurement with the emulator's.

        Parameters
        ----------
        output
            Which one.
        error
            Standard error of the measurement, the model's discrepancy in it.
        """
        _, scatter, own = self.predict(output)
        return float(0.5 * np.log2(1.0 + scatter**2 / (error**2 + own**2)))


def log_density(
    space: Space, emulators: tuple[Emulator, ...], values: Array, errors: Array, points: Array
) -> Array:
    """Return the logarithm of the likelihood at points, shape (n,); minus infinity outside the ranges.

    Measurements are independent and normal, their variance being that of the measurement, of the model's discrepancy
    and of the emulator together.
    """
    found = np.zeros(len(points))
    for emulator, value, error in zip(emulators, values, errors, strict=False):
        mean, own = emulator.predict(space.features(points))
        variance = error**2 + own**2
        found -= 0.5 * ((value - mean) ** 2 / variance + np.log(variance))
    return np.where(((points >= 0.0) & (points <= 1.0)).all(axis=1), found, -np.inf)


def fewest_runs(parameters: int) -> int:
    """Return how many runs are enough: the first of them must do for an emulator, those that follow for what it finds.

    Examples
    --------
    >>> from drumrs.decide.posterior import fewest_runs
    >>> [fewest_runs(parameters) for parameters in (1, 2, 5)]
    [6, 9, 20]
    """
    return max(4 * parameters, math.ceil(_fewest_points(parameters) / _FIRST))


def _fewest_points(parameters: int) -> int:
    return 2 * parameters + 2


def fit(
    space: Space,
    evaluate: Callable[[Array, int], tuple[Array, Array]],
    values: Array,
    errors: Array,
    runs: int,
) -> Posterior:
    """Find out which parameters measured numbers leave.

    Two thirds of the runs are spread over the space; the others are where what these tell leaves parameters, so that
    emulators are good where it matters.

    Parameters
    ----------
    space
        The parameters.
    evaluate
        Gives values and errors of all outputs, those that were measured first, at points; the second argument is the
        number of the first point. What is not a number failed.
    values, errors
        What was measured, and its standard errors with the model's discrepancy.
    runs
        Points to evaluate.

    Raises
    ------
    ConfigError
        Where an output has numbers at too few points.
    """
    points = space.exact(space.spread(round(_FIRST * runs)))
    found = [evaluate(points, 0)]
    emulators = _emulators(space, points, found)
    drawn = _likely(space, emulators, values, errors, runs - len(points))
    more = space.exact(space.rounded(drawn))
    found.append(evaluate(more, len(points)))
    emulators = _emulators(space, np.vstack([points, more]), found)
    return Posterior.of(space, emulators, values, errors)


def _likely(space: Space, emulators: tuple[Emulator, ...], values: Array, errors: Array, count: int) -> Array:
    """Draw points of an even spread by their likelihood, none twice where there are enough."""
    spread = space.spread(_SPREAD)
    weights = log_density(space, emulators, values, errors, spread)
    # A little for every point: there must be as many with a weight as are drawn.
    weights = np.exp(weights - weights.max()) + 1e-12
    drawn: Array = np.random.default_rng(1).choice(spread, count, replace=False, p=weights / weights.sum())
    return drawn


def _emulators(space: Space, points: Array, found: list[tuple[Array, Array]]) -> tuple[Emulator, ...]:
    means, noise = (np.vstack([each[k] for each in found]) for k in range(2))
    emulators = []
    for output in range(means.shape[1]):
        there = np.isfinite(means[:, output])
        if there.sum() < _fewest_points(len(space)):
            least = _fewest_points(len(space))
            problem = (
                f"has a number in {there.sum()} of {len(there)} runs, but must have one in {least} at least"
            )
            raise ConfigError(
                f"measured[{output}]", problem=problem, hint="narrow the ranges, or give calibrate.runs"
            )
        known = means[there, output], noise[there, output]
        emulators.append(Emulator.fit(space.features(points[there]), *known, space.feature_ranges))
    return tuple(emulators)
