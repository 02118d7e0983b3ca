"""`Results`: what finished cases tell, by configuration; means over seeds with their errors."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs import analysis
from drumrs.measures.frame_window import FrameWindow
from drumrs.sweep import Case
from drumrs.validation.cases import Scale
from drumrs.validation.check import NOTHING, Check

if TYPE_CHECKING:
    from collections.abc import Iterator

    import polars as pl

    from drumrs.analysis import Estimate
    from drumrs.config import Config
    from drumrs.sweep import Sweep

# Greatest mean overlap, over the radius.
_OVERLAP = 0.01


@dataclass(frozen=True)
class Results:
    """The finished cases of a study.

    Attributes
    ----------
    table
        One row a case, as `measure` makes it.
    sweep
        The cases.
    folder
        Where their results are.
    scale
        Seeds of the study; a drum may do with some of them.
    """

    table: "pl.DataFrame"
    sweep: "Sweep"
    folder: Path
    scale: Scale

    def estimate(self, point: "Config", column: str) -> "Estimate":
        """Return the mean of a column over the seeds of a point, with its error.

        Raises
        ------
        KeyError
            Where a case of the point is not finished.
        """
        rows = [self._row(case.id) for case in self.seeds(point)]
        # What could not be measured is null in the table, and no number in what is made of it.
        values = [math.nan if row[column] is None else row[column] for row in rows]
        return analysis.estimate(values, [row.get(f"{column}_error") for row in rows])

    def seeds(self, point: "Config") -> list[Case]:
        """Return the cases of a point, seed by seed."""
        cases = [Case(point.replace({"run.seed": seed})) for seed in self.scale.seeds]
        ids = {case.id for case in self.sweep.cases}
        return [case for case in cases if case.id in ids]

    def windows(self, point: "Config") -> "Iterator[FrameWindow]":
        """Give the frames of the averaging window of each seed."""
        for case in self.seeds(point):
            yield FrameWindow.of(self.sweep.frames(case, self.folder), point.run.averaging_window)

    def series(self, point: "Config") -> "pl.DataFrame":
        """Return the series of a point's first seed."""
        return self.sweep.series(self.seeds(point)[0], self.folder)

    def _row(self, case: str) -> dict[str, Any]:
        import polars as pl

        found = self.table.filter(pl.col("case") == case)
        if found.is_empty():
            raise KeyError(case)
        return found.row(0, named=True)


def check_of_overlap(results: Results, point: "Config") -> Check:
    """Return the check that springs are stiff enough: the mean overlap is below 1 % of the radius."""
    quantity = "overlap over the radius, root mean square"
    return Check(quantity, NOTHING, results.estimate(point, "mean_overlap_ratio"), 0.0, _OVERLAP)
