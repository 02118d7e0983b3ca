"""What matters most: Morris's effects and Sobol's indices of noisy functions, freed of the noise.

Plain functions of points within 0 … 1 and values; `screen` runs machines at the points.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from drumrs.analysis import Interval
from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError

# Trajectories go over four levels, two of which are left at a time: every level comes equally often.
_LEVELS, STEP = 4, 2.0 / 3.0
# A factor is dead whose effect is within so many of its spreads of what noise alone makes.
_SPREADS = 2.0
_FEWEST = 2
_RESAMPLES = 400
_LEVEL = 0.95


def trajectories(count: int, keys: int, seed: int = 1) -> Array:
    """Return points along which one factor after the other is changed, shape (count, keys + 1, keys).

    M. D. Morris, Technometrics 33 (1991) 161: four levels, steps of two thirds of the range, either way, factors in
    random order.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.decide.sensitivity import trajectories
    >>> points = trajectories(2, 3)
    >>> np.count_nonzero(np.diff(points, axis=1), axis=2)
    array([[1, 1, 1],
           [1, 1, 1]])
    """
    random = np.random.default_rng(seed)
    points = np.empty((count, keys + 1, keys))
    for path in points:
        path[:] = random.integers(0, _LEVELS, keys) / (_LEVELS - 1.0)
        for row, key in enumerate(random.permutation(keys), 1):
            path[row:, key] += STEP if path[0, key] < 0.5 else -STEP  # noqa: PLR2004 - half of the levels
    return points


@dataclass(frozen=True)
class Effect:
    """What one factor does on its way through its range, by Morris.

    Attributes
    ----------
    mean
        Mean change of the value over the range of the factor, with its sign.
    size
        Mean of its absolute value, μ*.
    scatter
        Its standard deviation: great where the factor acts together with others, or bends.
    floor
        What noise alone makes of μ*: 2 s/(Δ √π), with the noise s of a run and Δ the step.
    spread
        Standard deviation of μ* less the floor by noise alone, which is known from a few pairs of runs only.
    """

    mean: float
    size: float
    scatter: float
    floor: float
    spread: float

    @property
    def is_dead(self) -> bool:
        """Whether it cannot be told from noise: μ* is within two spreads of the floor."""
        return self.size <= self.floor + _SPREADS * self.spread


def morris(points: Array, values: Array, noise: float, pairs: int) -> list[Effect]:
    """Return the effect of each factor.

    Parameters
    ----------
    points
        Those of `trajectories`.
    values
        The function there, shape (count, keys + 1); what is not a number is left out.
    noise
        Standard deviation of a value at the same point.
    pairs
        Number of pairs of values that it is known from.

    Raises
    ------
    ConfigError
        Where a factor has fewer than two effects.
    """
    moves, changes = np.diff(points, axis=1), np.diff(values, axis=1)
    effects = []
    for key in range(points.shape[2]):
        moved = moves[:, :, key] != 0.0
        own = (changes[moved] * np.sign(moves[moved][:, key])) / STEP
        own = own[np.isfinite(own)]
        if len(own) < _FEWEST:
            problem = (
                f"gives {len(own)} effects of factor {key + 1}, but must give {_FEWEST}: runs have no value"
            )
            raise ConfigError("the screening", problem=problem)
        of_noise = math.sqrt(2.0) * noise / STEP
        floor = of_noise * math.sqrt(2.0 / math.pi)
        by_chance = of_noise * math.sqrt((1.0 - 2.0 / math.pi) / len(own))
        effects.append(
            Effect(
                mean=float(own.mean()),
                size=float(np.abs(own).mean()),
                scatter=float(own.std(ddof=1)),
                floor=floor,
                spread=math.hypot(by_chance, floor / math.sqrt(2.0 * pairs)),
            )
        )
    return effects


def noise_of(values: Array, again: Array) -> float:
    """Return the standard deviation of a value from pairs of values at the same points, with other seeds.

    Raises
    ------
    ConfigError
        Where there are fewer than two pairs with values.
    """
    apart = (values - again)[np.isfinite(values - again)]
    if len(apart) < _FEWEST:
        problem = f"has {len(apart)} points with two values, but must have {_FEWEST} to know the noise"
        raise ConfigError("the screening", problem=problem)
    return math.sqrt(float((apart**2).mean()) / 2.0)


def saltelli(count: int, keys: int, seed: int = 1) -> Array:
    """Return the points of Sobol's indices, shape (keys + 2, count, keys): A, B, and A with a column of B each.

    Parameters
    ----------
    count
        Points of A, a power of 2.
    keys
        Number of factors.
    seed
        Seed of the scrambling.
    """
    from scipy.stats import qmc

    pairs = qmc.Sobol(2 * keys, rng=seed).random(count)
    a, b = pairs[:, :keys], pairs[:, keys:]
    points = np.repeat(a[None], keys + 2, axis=0)
    points[1] = b
    for key in range(keys):
        points[key + 2, :, key] = b[:, key]
    return points


@dataclass(frozen=True)
class Indices:
    """How much of the spread of a value each factor explains.

    Attributes
    ----------
    first
        By itself: Sobol's index of first order, for each factor, with its interval.
    total
        With all that it does together with others: the total index.
    chance
        Share of the spread of single runs that is noise.
    """

    first: tuple[Interval, ...]
    total: tuple[Interval, ...]
    chance: Interval


def sobol(values: Array, pairs: tuple[Array, Array], seed: int = 1) -> Indices:
    """Return Sobol's indices, freed of the noise of runs, with bootstrap intervals.

    Noise s² adds to the variance V and to ½ E (f_A − f_AB)² alike: V = Var f − s², and the total index of a factor is
    (½ E (f_A − f_AB)² − s²)/V; the estimator of first order has nothing but its denominator to correct (A. Saltelli et
    al., Comput. Phys. Commun. 181 (2010) 259; estimators of `scipy.stats.sobol_indices`).

    Parameters
    ----------
    values
        The function at the points of `saltelli`, shape (keys + 2, count). Columns with a value that is not a number are
        left out, and more, until their number is a power of 2.
    pairs
        Array at the same points with different seeds, which tell the noise.
    seed
        Seed of the resampling.

    Raises
    ------
    ConfigError
        Where fewer than two columns have values, or nothing but noise makes them differ.
    """
    there = values[:, np.isfinite(values).all(axis=0)]
    if there.shape[1] < _FEWEST:
        problem = f"has {there.shape[1]} points with values, but must have {_FEWEST}"
        raise ConfigError("the screening", problem=problem)
    there = there[:, : 2 ** int(math.log2(there.shape[1]))]
    apart = (pairs[0] - pairs[1])[np.isfinite(pairs[0] - pairs[1])]
    found = _indices(there, float((apart**2).mean()) / 2.0)
    random = np.random.default_rng(seed)
    again = np.array(
        [
            _indices(
                there[:, random.integers(0, there.shape[1], there.shape[1])],
                float((random.choice(apart, len(apart)) ** 2).mean()) / 2.0,
            )
            for _ in range(_RESAMPLES)
        ]
    )
    errors = _half_widths(again, found)
    intervals = [Interval(float(one), float(error)) for one, error in zip(found, errors, strict=True)]
    keys = len(values) - 2
    return Indices(tuple(intervals[:keys]), tuple(intervals[keys : 2 * keys]), intervals[-1])


def _indices(values: Array, noise: float) -> Array:
    """Return the indices of first order, the total ones, and the share of noise in the variance."""
    from scipy.stats import sobol_indices

    count = values.shape[1]
    variance = float(values[:2].var())
    if not variance > 0.0:
        return np.full(2 * (len(values) - 2) + 1, 0.0)
    # A single factor counts twice, for scipy must have two.
    keys = len(values) - 2
    changed = values[2:, None] if keys > 1 else np.repeat(values[2:, None], 2, axis=0)
    function: Any = {"f_A": values[[0]], "f_B": values[[1]], "f_AB": changed}
    raw = sobol_indices(func=function, n=count)
    # Never below a hundredth: where nothing but noise is left, there is nothing to divide by.
    signal = max(variance - noise, 0.01 * variance)
    first = np.ravel(raw.first_order)[:keys] * variance / signal
    total = (np.ravel(raw.total_order)[:keys] * variance - noise) / signal
    return np.concatenate([first, total, [min(noise / variance, 1.0)]])


def _half_widths(resampled: Array, found: Array) -> Array:
    """Return the distance from each value that holds 95 % of the resampled ones."""
    widths: Array = np.quantile(np.abs(resampled - found), _LEVEL, axis=0)
    return widths
