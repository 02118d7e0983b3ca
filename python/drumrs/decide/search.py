"""The search for the best points: what the runs so far tell, where to run next, and when to stop.

Knows nothing of drums: a function gives values and errors at points of a space. The first columns of the values, one
or two, are to be minimized; of all others, which are constraints, values up to 0 are accepted.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from drumrs.decide.emulator import Array, Emulator, one_thread
from drumrs.decide.gain import Mask, clearly_non_dominated, expected_improvement, hypervolume
from drumrs.decide.space import Space

Accept = Callable[[Array], bool]
# Values and errors at points, not-a-number where a run failed; the second argument is the number of the first point.
Evaluate = Callable[[Array, int], tuple[Array, Array]]

# Points at which the expected improvement is looked at first; then, about the best of them, at smaller distances.
_SPREAD, _KEPT, _AROUND, _DISTANCES = 512, 8, 24, (0.1, 0.03, 0.01, 0.003)
# Functions drawn for the chance of a gain, and points at which they are looked at beside the best candidates.
_DRAWN, _LOOKED_AT = 256, 192
# More is not tried once a gain beyond the tolerance is less likely than this.
ENOUGH = 0.05
# A point is taken to meet the constraints where that is more likely than not.
_LIKELY = 0.5
# What lies beyond the front counts a little, so that its ends are sought, too: part of its extent.
_MARGIN, _COARSE = 0.1, 0.02


@dataclass(frozen=True, eq=False)
class Model:
    """What is known of objectives and constraints after some runs.

    Attributes
    ----------
    space
        Where points lie.
    points
        Those that were run, shape (n, k).
    failed
        Which of them gave no values; they count as the worst that was seen, so that the search keeps off.
    emulators
        One a column of the values.
    objectives
        How many columns are to be minimized.
    accept
        Tells which points can be run.
    """

    space: Space
    points: Array
    failed: Mask
    emulators: tuple[Emulator, ...]
    objectives: int
    accept: Accept

    @classmethod
    def fit(
        cls,
        space: Space,
        points: Array,
        found: tuple[Array, Array],
        objectives: int,
        accept: Accept = lambda _: True,
    ) -> "Model":
        """Fit an emulator to every column of the values and errors that were found, shape (n, columns) each."""
        values, errors = found
        failed: Mask = np.isnan(values).sum(axis=1) > 0
        features = space.features(points)
        emulators = []
        for column, error in zip(values.T, errors.T, strict=True):
            worst, scatter = np.max(column[~failed]), np.std(column[~failed])
            known, noise = np.where(failed, worst, column), np.where(failed, scatter, error)
            emulators.append(Emulator.fit(features, known, noise, space.feature_ranges))
        return cls(space, points, failed, tuple(emulators), objectives, accept)

    def predict(self, points: Array) -> tuple[Array, Array]:
        """Return means and errors of all columns at points, shape (n, columns)."""
        found = [emulator.predict(self.space.features(points)) for emulator in self.emulators]
        return np.array([mean for mean, _ in found]).T, np.array([error for _, error in found]).T

    def feasibility(self, points: Array) -> Array:
        """Return the probability that points meet all constraints, shape (n,)."""
        from scipy.special import ndtr

        means, errors = (both[:, self.objectives :] for both in self.predict(points))
        found: Array = np.prod(ndtr(-means / np.maximum(errors, 1e-100)), axis=1)
        return found

    @cached_property
    def feasible(self) -> Mask:
        """Tell which of the points that were run are more likely than not to meet all constraints."""
        met: Mask = (self.feasibility(self.points) >= _LIKELY) & ~self.failed
        return met

    @cached_property
    def ranked(self) -> list[int]:
        """Return the points that are not dominated among those that meet the constraints, the best one first.

        Of one objective these are all points that meet the constraints; of two, the front, by the first objective.
        """
        means = self.predict(self.points)[0][:, : self.objectives]
        there = np.flatnonzero(self.feasible)
        if self.objectives > 1:
            there = there[clearly_non_dominated(means[there])]
        return [int(k) for k in there[np.argsort(means[there, 0], kind="stable")]]

    def propose(self, count: int) -> Array:
        """Return the next points to run together.

        Each has the greatest expected improvement over the best mean, times the probability of meeting the
        constraints. Those after the first take it for granted that the earlier ones give what is expected of them
        (the kriging believer of Ginsbourger, Le Riche & Carraro 2010).
        """
        model, chosen = self, np.zeros((0, len(self.space)))
        with one_thread():
            for _ in range(count):
                best = model._candidates[:1]
                chosen = np.vstack([chosen, best])
                model = model._believing(best)
        return self.space.exact(chosen)

    def chance_of_gain(self, tolerance: float, *, relative: bool) -> float:
        """Return the probability that a run at some further point would gain more than a tolerance.

        Parameters
        ----------
        tolerance
            Of one objective in its unit or, if relative, over the best value; of two over the hypervolume.
        relative
            Whether the tolerance is a share.
        """
        best = self.ranked[: 1 if self.objectives == 1 else None]
        if not best:
            return 1.0
        rng, own = np.random.default_rng(len(self.points)), len(best)
        with one_thread():
            spread = self.space.spread(_LOOKED_AT, seed=len(self.points) + 1)
            likely = self.promising_front
            looked = np.vstack([spread, self._candidates, likely[:: len(likely) // _LOOKED_AT + 1]])
            # The points known are what would be reported; a point that comes twice would make the covariance singular.
            looked = np.vstack([self.points[best], np.unique(looked, axis=0)])
            features = self.space.features(looked)
            drawn = np.stack([one.sample(features, _DRAWN, rng) for one in self.emulators], axis=-1)
            reference, first = self.reference, self.predict(self.points[best[:1]])[0][0, 0]
        wanted = drawn[..., : self.objectives]
        met: Mask = (drawn[..., self.objectives :] > 0.0).sum(axis=-1) == 0
        gained = 0
        for values, possible in zip(wanted, met, strict=True):
            gains = expected_improvement(values, np.zeros_like(values), values[:own], reference)
            before = abs(first) if self.objectives == 1 else hypervolume(values[:own], reference)
            gained += (gains * possible).max() > (tolerance * before if relative else tolerance)
        return gained / len(drawn)

    @cached_property
    def uncertainty_of_front(self) -> float:
        """Return the standard error of the hypervolume of the points known, over itself: what the noise of runs leaves.

        The rule to stop does not take it into account: many gains below it add up. It says whether longer runs, which
        are less noisy, would help more than further ones.
        """
        points = self.points[self.ranked]
        features, rng = self.space.features(points), np.random.default_rng(len(self.points))
        with one_thread():
            drawn = [one.sample(features, _DRAWN, rng) for one in self.emulators[: self.objectives]]
        volumes = [hypervolume(values, self.reference) for values in np.stack(drawn, axis=-1)]
        return float(np.std(volumes) / (np.mean(volumes) or 1.0))

    def _optimistic(self, points: Array) -> Array:
        means, errors = self.predict(points)
        optimistic: Array = (means - errors)[:, : self.objectives]
        return optimistic

    @cached_property
    def promising_front(self) -> Array:
        """Return the points anywhere in the space that are not dominated if each is better by its error.

        Points that are not likely to meet the constraints are left out.
        """
        rng = np.random.default_rng(len(self.points))
        points = np.vstack([self.space.spread(_SPREAD), self.points[self.ranked]])
        for distance in (*_DISTANCES, None):
            points = points[self.feasibility(points) >= _LIKELY]
            points = points[clearly_non_dominated(self._optimistic(points))]
            if distance is not None:
                around = np.repeat(points[:_SPREAD], _KEPT, axis=0)
                steps = distance * rng.standard_normal(around.shape)
                points = np.vstack([points, self.space.rounded(around + steps)])
        return points

    @cached_property
    def reference(self) -> Array:
        """Return where the hypervolume ends: a little beyond the front that is promising; of one objective nowhere."""
        if self.objectives == 1:
            return np.array([np.inf])
        front = self._optimistic(self.promising_front)
        # Coarsely: a point that may be better by little in one objective must not move the end of the other far out.
        front = front[clearly_non_dominated(front, _COARSE)]
        reference: Array = front.max(axis=0) + _MARGIN * np.ptp(front, axis=0)
        return reference

    @cached_property
    def _candidates(self) -> Array:
        """Return promising points, the one with the greatest expected improvement first."""
        best = self.ranked
        front = self.predict(self.points[best])[0][:, : self.objectives]
        reference = self.reference if best else np.full(self.objectives, np.inf)

        def worth(points: Array) -> Array:
            chance = self.feasibility(points)
            if not best:
                return chance
            means, errors = (both[:, : self.objectives] for both in self.predict(points))
            return chance * expected_improvement(means, errors, front, reference)

        rng = np.random.default_rng(len(self.points))
        pool = np.vstack([self.space.spread(_SPREAD, seed=len(self.points)), self.points[best[:_KEPT]]])
        for distance in (None, *_DISTANCES):
            if distance is not None:
                around = np.repeat(pool, _AROUND, axis=0)
                pool = np.vstack(
                    [pool, self.space.rounded(around + distance * rng.standard_normal(around.shape))]
                )
            pool = _first_accepted(np.unique(pool, axis=0), worth, self.accept)
        return pool

    def _believing(self, points: Array) -> "Model":
        means = self.predict(points)[0]
        features = self.space.features(points)
        emulators = tuple(
            one.with_points(features, column) for one, column in zip(self.emulators, means.T, strict=True)
        )
        failed = np.append(self.failed, np.zeros(len(points), dtype=bool))
        return replace(self, points=np.vstack([self.points, points]), failed=failed, emulators=emulators)


def _first_accepted(pool: Array, worth: Callable[[Array], Array], accept: Accept) -> Array:
    kept: list[Array] = []
    for k in np.argsort(-worth(pool), kind="stable"):
        if accept(pool[k]):
            kept.append(pool[k])
        if len(kept) == _KEPT:
            break
    return np.array(kept)


@dataclass(eq=False)
class Search:
    """A search under way.

    Attributes
    ----------
    space, objectives, accept
        Where points lie, how many objectives there are, which points can be run.
    tolerance, relative
        As of `Model.chance_of_gain`.
    batches
        The points of each batch, those of an earlier search that was broken off included.
    found
        Values and errors of each batch that has been run.
    chances
        Probability of a gain beyond the tolerance, after each batch.
    """

    space: Space
    objectives: int = 1
    accept: Accept = lambda _: True
    tolerance: float = 0.01
    relative: bool = True
    batches: list[Array] = field(default_factory=list)
    found: list[tuple[Array, Array]] = field(default_factory=list)
    chances: list[float] = field(default_factory=list)

    @property
    def points(self) -> Array:
        """All points that have been run."""
        return np.vstack(self.batches[: len(self.found)])

    @property
    def values(self) -> Array:
        """What was found there, a column for each objective and constraint."""
        return np.vstack([values for values, _ in self.found])

    @property
    def errors(self) -> Array:
        """Errors of what was found."""
        return np.vstack([errors for _, errors in self.found])

    def model(self) -> Model:
        """Return what the runs so far tell."""
        return Model.fit(self.space, self.points, (self.values, self.errors), self.objectives, self.accept)

    def start(self) -> Array:
        """Return the points to begin with: 2k + 2 of a Sobol sequence."""
        count, spread = 2 * len(self.space) + 2, self.space.spread(1024)
        return self.space.exact(np.array([point for point in spread if self.accept(point)][:count]))

    def run(
        self,
        evaluate: Evaluate,
        runs: int,
        batch: int,
        keep: Callable[[Sequence[Array]], None] = lambda _: None,
    ) -> Model:
        """Search until a gain is unlikely or so many points have been run.

        Parameters
        ----------
        evaluate
            Gives values and errors at points.
        runs
            Points to run at most.
        batch
            Points to run together.
        keep
            Called with all batches before one is run, so that the search can be taken up again.
        """
        waiting, self.batches = self.batches or [self.start()], []
        while True:
            self.batches.append(waiting.pop(0))
            keep([*self.batches, *waiting])
            done = sum(map(len, self.batches[:-1]))
            self.found.append(evaluate(self.batches[-1], done))
            model = self.model()
            self.chances.append(model.chance_of_gain(self.tolerance, relative=self.relative))
            left = runs - len(self.values)
            if left <= 0 or self.chances[-1] < ENOUGH:
                return model
            if not waiting:
                waiting = [model.propose(min(batch, left))]
