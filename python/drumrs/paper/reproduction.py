"""The paper's study in one go: cases, runs, table, verdicts, figures, report; taken up again after any break."""

import time
from dataclasses import dataclass
from pathlib import Path

from drumrs.paper.cases import cases
from drumrs.paper.data import StudyData
from drumrs.paper.measure import measure
from drumrs.paper.report import Picture, summary, write
from drumrs.paper.scales import Scale
from drumrs.progress import Task
from drumrs.registry import known, metadata
from drumrs.sweep import Failure
from drumrs.sweep.study_folder import StudyFolder
from drumrs.sweep.throughput import measure_speed
from drumrs.tables import write_table

# What a reproduction writes into its folder.
_FILES = ("report.html", "summary.md", "table.parquet", "figures")
# Reading results, drawing and writing the report: so long at least, and so long for each case [s].
_WRITING, _WRITING_CASE = 6.0, 0.1


@dataclass(frozen=True)
class ReproductionResult:
    """What a study leaves.

    Attributes
    ----------
    data
        Table, verdicts, failures.
    report
        The report, one HTML file.
    summary
        Findings, verdicts and figures as a page of Markdown.
    table
        The table of all runs, parquet.
    pictures
        The figures, with what some of them lack.
    """

    data: StudyData
    report: Path
    summary: Path
    table: Path
    pictures: tuple[Picture, ...]


class Reproduction(StudyFolder):
    """A study that is to be run into a folder.

    Parameters
    ----------
    scale
        ``"quick"``, ``"default"`` or ``"full"``, or a `paper.Scale` of your own.
    folder
        Gets report.html, summary.md, table.parquet, figures/ and runs/, the results of every case.
    jobs
        Cases at once; one a usable core unless given.

    Raises
    ------
    ConfigError
        Where there is no such scale, the number of jobs is not accepted, or the folder is not one of a reproduction
        that this version of drumrs knows.

    Examples
    --------
    >>> from drumrs.paper import Reproduction
    >>> Reproduction("quick", "somewhere")
    <Reproduction of 288 cases, 288 to be run>
    """

    def __init__(self, scale: str | Scale, folder: str | Path, jobs: int | None = None) -> None:
        self.scale = scale if isinstance(scale, str) else "own"
        super().__init__(folder, cases(scale), jobs, kind="reproduction", files=_FILES)

    def __repr__(self) -> str:
        """Say how much there is to do."""
        return f"<Reproduction of {len(self.sweep)} cases, {len(self.waiting)} to be run>"

    def expected_time(self) -> float:
        """Return how long it is going to take [s], from the speed that this machine shows in a fraction of a second."""
        writing = _WRITING + _WRITING_CASE * len(self.sweep)
        if not self.waiting:
            return writing
        together = measure_speed(min(self.jobs, len(self.waiting)))
        # The longest case is begun first and goes no faster for being one of several.
        longest = max(case.cost for case in self.waiting) * min(self.jobs, len(self.waiting))
        return max(self.cost, longest) / together + writing

    def run(self, *, retry: bool = False, progress: bool = True) -> ReproductionResult:
        """Run what is not finished, then judge, draw and write.

        Parameters
        ----------
        retry
            Whether cases that failed before are run again.
        progress
            Whether to show how far it is.

        Raises
        ------
        ConfigError
            Where the folder cannot be written, or is not one of a reproduction.
        OSError
            Where something cannot be written; finished cases are kept.
        KeyboardInterrupt
            After Ctrl-C; finished cases are kept, and the same call goes on.
        """
        began = time.perf_counter()
        outcome = self.run_cases(f"the paper's study ({self.scale})", retry=retry, progress=progress)
        with Task("measures, figures and report", 0, show=progress):
            return self._report(outcome.failures, began)

    def _report(self, failures: tuple[Failure, ...], began: float) -> ReproductionResult:
        """Measure, judge, draw and write."""
        table = measure(self.sweep, self.runs_folder)
        write_table(self.folder / "table.parquet", table, metadata(known(table.columns)))
        taken = time.perf_counter() - began
        data = StudyData(table, self.sweep, self.runs_folder, self.scale, failures, taken)
        page, text = self.folder / "report.html", self.folder / "summary.md"
        pictures = write(data, page, self.folder / "figures")
        summary.write(data, pictures.figures, pictures.thumbnails, text)
        return ReproductionResult(data, page, text, self.folder / "table.parquet", pictures.figures)
