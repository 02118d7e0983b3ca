"""`select`: which of a few noisy designs is best, sampled one after the other until that is sure.

A plain function of a sampling function: no simulation in sight. Smaller values are better here; `compare` turns those
round that should be great.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from drumrs.analysis import Estimate, Interval, estimate
from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError

# Seeds of every design before the first look.
FIRST = 4
# Seeds below which no design is judged.
_FEWEST = 2
# Seeds are taken for correlated where so many are common, and in one of so many cases by chance.
_FEWEST_PAIRS, _PAIRED = 6, 0.01
# No design gets more than so many times the seeds it has in one go: what is known of its noise is rough.
_GROWTH = 2.0

# A seed of a design: the numbers of both, from 0 on.
Wanted = Sequence[tuple[int, int]]
Standing = Literal["best", "worse", "equal", "open"]


@dataclass(frozen=True)
class Rival:
    """How a design stands to the best one.

    Attributes
    ----------
    standing
        "best"; "worse" than the best for sure; "equal": within the difference of the best for sure; or "open".
    behind
        By how much it is behind the best, with an interval. Those of all designs, at all looks, hold together with the
        level that was asked for.
    is_paired
        Whether the interval is of differences seed by seed.
    """

    standing: Standing
    behind: Interval
    is_paired: bool = False


@dataclass(frozen=True)
class Selection:
    """Which design is best, as far as is known.

    Attributes
    ----------
    best
        Number of the design with the least mean.
    rivals
        How each stands to it, in the order of the designs.
    estimates
        Mean of each over its seeds.
    difference
        Difference below which designs count as equal.
    looks
        How often the designs were looked at.
    """

    best: int
    rivals: tuple[Rival, ...]
    estimates: tuple[Estimate, ...]
    difference: float
    looks: int

    @property
    def is_decided(self) -> bool:
        """Whether every other design is worse for sure, or equal."""
        return all(rival.standing != "open" for rival in self.rivals)


def select(
    sample: Callable[[Wanted], Sequence[float]],
    names: Sequence[str],
    difference: Callable[[float], float],
    *,
    most: int = 1000,
    level: float = 0.95,
    on_look: Callable[[Selection, int], None] | None = None,
) -> Selection:
    """Sample designs until each is worse than the best for sure, or as good within a difference.

    After each round every design is compared with the best one by Welch's interval, or seed by seed where the values
    of common seeds are significantly positively correlated. The intervals are so wide that all of them hold together,
    at all looks: each rival has an equal part of what the level leaves to chance, the r-th look 1/(r (r + 1)) of that
    (Bonferroni). Further seeds go where they settle most: to a design in proportion to (s/goal)², with s the scatter of
    its seeds and the goal what its interval has to come down to, gap or difference less gap (optimal computing budget
    allocation, C.-H. Chen et al., Discrete Event Dyn. Syst. 10 (2000) 251).

    Parameters
    ----------
    sample
        Function from pairs of design and seed, both from 0 on, to values; the less the better. A value that is not a
        number is left out.
    names
        Names of the designs, at least two.
    difference
        Difference below which two designs count as equal, from the mean of the best one.
    most
        Greatest number of samples.
    level
        Probability that all that is said is right.
    on_look
        Called after each look with what is known then, and the number of samples.

    Returns
    -------
    Selection
        Not decided where `most` samples do not settle it.

    Raises
    ------
    ConfigError
        Where a design has no values, or there are not samples enough to begin.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.decide.selection import select
    >>> random = np.random.default_rng(1)
    >>> means = [1.0, 1.3, 2.0]
    >>> found = select(lambda wanted: [random.normal(means[k], 0.1) for k, _ in wanted], "ABC", lambda best: 0.05)
    >>> found.best, [rival.standing for rival in found.rivals]
    (0, ['best', 'worse', 'worse'])
    """
    count = len(names)
    require_enough(most, count)
    values: list[list[float]] = [[] for _ in range(count)]
    new, looks = [FIRST] * count, 0
    while True:
        wanted = [(k, len(values[k]) + seed) for k, more in enumerate(new) for seed in range(more)]
        for (k, _), value in zip(wanted, sample(wanted), strict=True):
            values[k].append(value)
        looks += 1
        _require_values(names, values)
        found = _look(values, difference, looks, level)
        sampled = sum(map(len, values))
        if on_look is not None:
            on_look(found, sampled)
        new = _further(values, found, most - sampled)
        if found.is_decided or not any(new):
            return found


def require_enough(most: int, count: int) -> None:
    """Refuse fewer samples than so many designs begin with."""
    if isinstance(most, bool) or not isinstance(most, int) or most < FIRST * count:
        limit = f"a whole number from {FIRST * count} on: {FIRST} seeds of each of {count} designs"
        raise ConfigError("most", most, limit, bound=FIRST * count)


def _look(
    values: Sequence[Sequence[float]], difference: Callable[[float], float], looks: int, level: float
) -> Selection:
    estimates = tuple(estimate(_finite(own)) for own in values)
    best = min(range(len(values)), key=lambda k: estimates[k].mean)
    equal = abs(difference(estimates[best].mean))
    confidence = 1.0 - (1.0 - level) / (looks * (looks + 1.0) * (len(values) - 1))
    rivals = []
    for k in range(len(values)):
        if k == best:
            rivals.append(Rival("best", Interval(0.0, 0.0)))
            continue
        gap, is_paired = _gap(values[k], values[best])
        behind = gap.interval(confidence)
        rivals.append(Rival(_standing(behind, equal), behind, is_paired))
    return Selection(best, tuple(rivals), estimates, equal, looks)


def _finite(values: Sequence[float]) -> list[float]:
    return [value for value in values if math.isfinite(value)]


def _require_values(names: Sequence[str], values: Sequence[Sequence[float]]) -> None:
    for name, own in zip(names, values, strict=True):
        there = len(_finite(own))
        if there < _FEWEST:
            problem = f"has a value in {there} of {len(own)} runs, but must have it in {_FEWEST} of them"
            raise ConfigError(f"the design {name}", problem=problem)


def _standing(behind: Interval, equal: float) -> Standing:
    if behind.low > 0.0:
        return "worse"
    return "equal" if max(behind.high, -behind.low) < equal else "open"


def _gap(own: Sequence[float], best: Sequence[float]) -> tuple[Estimate, bool]:
    """Return how much a design is behind the best one, and whether that was taken seed by seed."""
    common = np.array([pair for pair in zip(own, best, strict=False) if np.isfinite(pair).all()])
    if len(common) >= _FEWEST_PAIRS and _correlation_significance(common) < _PAIRED:
        return estimate(list(common[:, 0] - common[:, 1])), True
    return estimate(_finite(own)) - estimate(_finite(best)), False


def _correlation_significance(pairs: Array) -> float:
    """Return the probability of so positive a correlation between columns without any (Student's test)."""
    from scipy import special

    if not np.ptp(pairs, axis=0).all():
        return 1.0
    # As `scipy.stats.pearsonr` has it, which takes ten times as long for so few pairs.
    one, other = ((pairs - pairs.mean(axis=0)) / pairs.std(axis=0)).T
    correlation, freedom = float(np.mean(one * other)), len(pairs) - 2
    t = correlation * math.sqrt(freedom / max(1.0 - correlation**2, 1e-300))
    return float(special.stdtr(freedom, -t))


def _further(values: Sequence[Sequence[float]], found: Selection, left: int) -> list[int]:
    """Return how many further seeds each design gets: none where all is decided, or none is left."""
    counts = [len(own) for own in values]
    scatters = [
        found.estimates[k].error * math.sqrt(sum(map(math.isfinite, own))) for k, own in enumerate(values)
    ]
    wishes = [0.0] * len(counts)
    for k, rival in enumerate(found.rivals):
        if rival.standing == "open":
            error = math.hypot(found.estimates[k].error, found.estimates[found.best].error)
            goal = max(rival.behind.mean, found.difference - rival.behind.mean)
            # The quantile by which the interval is wider than its error.
            wide = rival.behind.half_width / error if error else 0.0
            wishes[k] = max(2.0 * (wide * scatters[k] / goal) ** 2, counts[k] + 1.0)
    squares = sum((wish / scatter) ** 2 for wish, scatter in zip(wishes, scatters, strict=True) if scatter)
    if any(wishes):
        wishes[found.best] = max(scatters[found.best] * math.sqrt(squares), counts[found.best] + 1.0)
    new = [
        math.ceil(min(wish, _GROWTH * count)) - count if wish > count else 0
        for wish, count in zip(wishes, counts, strict=True)
    ]
    while sum(new) > left:
        new[int(np.argmax(new))] -= 1
    return new
