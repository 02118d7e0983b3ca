"""`Optimization`: what a search has found, as a table, a figure and a sentence."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.config import Config
from drumrs.decide.confirmed import Confirmed, number_of
from drumrs.decide.problem import Problem
from drumrs.decide.search import ENOUGH, Model, Search
from drumrs.errors import ConfigError
from drumrs.tables import write_table

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Optimization:
    """What an optimization has found.

    Attributes
    ----------
    problem
        What was asked.
    search
        All runs, batch by batch.
    model
        What they tell of points that were not run.
    confirmed
        Winner and runner-up on fresh seeds, the better one first; of two objectives, points along the front.
    """

    problem: Problem
    search: Search
    model: Model
    confirmed: tuple[Confirmed, ...]

    @property
    def best(self) -> dict[str, Any]:
        """Values of the winner by key; of two objectives, those in the middle of the front."""
        middle = len(self.confirmed) // 2 if self.model.objectives > 1 else 0
        return dict(self.confirmed[middle].values)

    @property
    def config(self) -> Config:
        """The configuration of `best`."""
        return self.problem.base.replace(self.best)

    @cached_property
    def table(self) -> "pl.DataFrame":
        """The history: a row a run, with its keys, and for each target what the run gave and what is expected.

        "front" says whether a point is not dominated by another (of one objective: is the best), "feasible" how
        probable it is that it meets all constraints.
        """
        import polars as pl

        points, ranked = self.model.points, self.model.ranked
        count = len(points)
        batch = [k for k, each in enumerate(self.search.batches) for _ in each][:count]
        first = self.problem.base.run.seed
        columns: dict[str, Any] = {"run": range(count), "batch": batch, "seed": range(first, first + count)}
        rows = [self.problem.space.values(point) for point in points]
        columns |= {key: [row[key] for row in rows] for key in self.problem.space.keys}
        means, errors = self.model.predict(points)
        for k, goal in enumerate(self.problem.goals):
            shift = np.vectorize(goal.unsigned)
            columns |= {
                goal.target.text: shift(self.search.values[:, k]),
                f"{goal.target.text}_error": self.search.errors[:, k],
                f"{goal.target.text}_expected": shift(means[:, k]),
                f"{goal.target.text}_expected_error": errors[:, k],
            }
        front = set(ranked if self.model.objectives > 1 else ranked[:1])
        columns |= {"feasible": self.model.feasibility(points), "front": [k in front for k in range(count)]}
        return pl.DataFrame(columns, strict=False).fill_nan(None)

    @property
    def front(self) -> "pl.DataFrame":
        """The rows of the table that are not dominated, with what is expected of them, by the first objective."""
        return self.table.filter("front").sort(f"{self.problem.objectives[0].target.text}_expected")

    @property
    def sentence(self) -> str:
        """What was found and how sure it is."""
        told = self._front_sentence() if self.model.objectives > 1 else self._winner_sentence()
        return f"{told} {self._end_sentence()}"

    def figure(self) -> "Figure":
        """Draw how the search went, the response along each key through the best point, and a front.

        Raises
        ------
        ConfigError
            Where nothing was confirmed.
        """
        from drumrs.decide.optimization_figure import draw

        return draw(self.problem, self.search, self.model, self.confirmed, self.table, self.best)

    def write_table(self, path: Path) -> None:
        """Write the table as a Parquet file.

        Raises
        ------
        OSError
            Where it cannot be written.
        """
        write_table(path, self.table, {})

    def nothing_feasible(self) -> ConfigError:
        """Return the error that no point meets the constraints, with the nearest."""
        means = self.model.predict(self.model.points)[0][:, self.model.objectives :]
        nearest = int(np.argmax(np.where(self.model.failed, -1.0, self.model.feasibility(self.model.points))))
        values = ", ".join(f"{key} = {value}" for key, value in self._values(nearest).items())
        goals = zip(self.problem.constraints, means[nearest], strict=True)
        missed = " and ".join(
            f"{goal.target} = {goal.unsigned(x):.4g} where {goal} is asked" for goal, x in goals
        )
        problem = f"is met by none of {len(self.model.points)} runs: the nearest, {values}, has {missed}"
        return ConfigError("optimize.subject_to", problem=problem, hint="widen ranges or limits")

    def _values(self, place: int) -> dict[str, Any]:
        return self.problem.space.values(self.model.points[place])

    def _winner_sentence(self) -> str:
        goal, winner, seeds = self.problem.objectives[0], self.confirmed[0], self.problem.confirm
        fresh, (expected, error) = winner.fresh[0], winner.expected[0]
        told = (
            f"The {goal} is {number_of(goal, fresh.mean, fresh.error)} at {winner}, on {seeds} fresh seeds; "
            f"the search, which picks the luckiest of {len(self.model.points)} runs, had expected "
            f"{number_of(goal, expected, error)}."
        )
        missed = winner.misses(self.problem)
        if missed:
            told += f" On the fresh seeds it misses {' and '.join(missed)}."
        if len(self.confirmed) > 1:
            second = self.confirmed[1].fresh[0]
            lead = (second - fresh).interval()
            is_clear = lead.low > 0.0 or lead.high < 0.0
            verdict = "clearly behind" if is_clear else "not told apart from it"
            told += f" Second is {self.confirmed[1]} with {number_of(goal, second.mean, second.error)}, {verdict}."
        return told

    def _front_sentence(self) -> str:
        ends = [self.confirmed[0], self.confirmed[-1]]
        told = " to ".join(
            " and ".join(
                f"{goal.target.title} {number_of(goal, found.mean, found.error)}"
                for goal, found in zip(self.problem.objectives, one.fresh, strict=False)
            )
            + f" at {one}"
            for one in ends
        )
        missed = [
            f"{one} misses {' and '.join(each)}"
            for one in self.confirmed
            if (each := one.misses(self.problem))
        ]
        misses = f" On the fresh seeds {'; '.join(missed)}." if missed else ""
        return (
            f"No point is better in both among the {self.front.height} of the front, which on {self.problem.confirm} "
            f"fresh seeds goes from {told}.{misses}"
        )

    def _end_sentence(self) -> str:
        chance, runs = self.search.chances[-1], len(self.model.points)
        if self.model.objectives > 1:
            share = f"{100.0 * self.problem.tolerance.amount:g} % of the hypervolume"
        else:
            goal, best = self.problem.objectives[0], self.model.points[self.model.ranked[:1]]
            share = self.problem.tolerance.text(self.model.predict(best)[0][0, 0], goal.target.unit)
        if chance < ENOUGH:
            return (
                f"The search ended after {runs} runs: the chance that another gains more than {share} "
                f"is {chance:.0%}."
            )
        return (
            f"The search used up its {runs} runs: the chance that another gains more than {share} is "
            f"{chance:.0%}; a larger optimize.runs goes on from here.{self._noise()}"
        )

    def _noise(self) -> str:
        """Say how well a front is known where that is worse than the tolerance."""
        known = self.model.uncertainty_of_front if self.model.objectives > 1 else 0.0
        if known <= self.problem.tolerance.amount:
            return ""
        return f" The noise of the runs leaves the hypervolume uncertain by {known:.0%}, so longer runs help as well."
