"""`Confirmed`: a point of a search that was run again with fresh seeds."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from drumrs.analysis import Estimate
from drumrs.decide.problem import Goal, Problem
from drumrs.decide.search import Model
from drumrs.result import with_error


@dataclass(frozen=True)
class Confirmed:
    """A point of the search, run again with fresh seeds.

    Attributes
    ----------
    values
        Its values by key.
    expected
        Mean and standard error of each goal's target as the search left them.
    fresh
        What the fresh seeds say.
    """

    values: Mapping[str, Any]
    expected: tuple[tuple[float, float], ...]
    fresh: tuple[Estimate, ...]

    @classmethod
    def of(cls, problem: Problem, model: Model, place: int, fresh: tuple[Estimate, ...]) -> "Confirmed":
        """Make it of a point that was run."""
        means, errors = model.predict(model.points[[place]])
        expected = [
            (goal.unsigned(mean), error)
            for goal, mean, error in zip(problem.goals, means[0], errors[0], strict=True)
        ]
        return cls(problem.space.values(model.points[place]), tuple(expected), fresh)

    def signed(self, problem: Problem) -> float:
        """Return the first objective on fresh seeds, to be minimized; infinite where there is none."""
        value = problem.goals[0].signed(self.fresh[0].mean)
        return float("inf") if np.isnan(value) else value

    def misses(self, problem: Problem) -> list[str]:
        """Return the constraints that it misses on fresh seeds, in words: no part of the interval meets them."""
        goals = zip(problem.goals, self.fresh, strict=True)
        return [
            f"{goal} (it is {number_of(goal, found.mean, found.error)})"
            for goal, found in goals
            if goal.limit is not None and not goal.signed(found.mean) <= found.interval().half_width
        ]

    def __str__(self) -> str:
        """Return the values as one writes them."""
        return ", ".join(f"{key} = {value}" for key, value in self.values.items())


def number_of(goal: Goal, value: float, error: float) -> str:
    """Show a value of a goal's target with its error and unit."""
    unit = "" if goal.target.unit == "1" else f" {goal.target.unit}"
    return f"{with_error(value, error if np.isfinite(error) else None)}{unit}"
