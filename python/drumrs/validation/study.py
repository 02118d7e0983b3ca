"""`Validation`: the published drums in one go, cases, comparison, figures, page; taken up again after any break."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from drumrs.errors import ConfigError
from drumrs.pictures import attempt
from drumrs.progress import Task
from drumrs.registry import known, metadata
from drumrs.sweep import Case, Failure
from drumrs.sweep.study_folder import StudyFolder
from drumrs.tables import write_table
from drumrs.validation import layer, mill, page, tracer
from drumrs.validation.cases import Scale
from drumrs.validation.check import Check
from drumrs.validation.drum import PublishedDrum
from drumrs.validation.results import Results
from drumrs.validation.table import measure

DRUMS: Mapping[str, PublishedDrum] = MappingProxyType(
    {drum.name: drum for drum in (tracer.DRUM, layer.DRUM, mill.DRUM)}
)
# What a validation writes into its folder.
_FILES = ("README.md", "table.parquet", "figures")


@dataclass(frozen=True)
class ValidationResult:
    """What a validation leaves.

    Attributes
    ----------
    checks
        The comparisons by the drum's name; none for a drum with a case that failed.
    failures
        Cases that failed.
    page, table
        The page and the table, one row a case.
    """

    checks: Mapping[str, Sequence[Check]]
    failures: Sequence[Failure]
    page: Path
    table: Path


class Validation(StudyFolder):
    """The study of published drums in a folder.

    Parameters
    ----------
    folder
        Where runs, table, figures and page go; a folder of an earlier validation is gone on with.
    names
        The drums; all unless given.
    jobs
        Cases at once; one a usable core unless given.
    scale
        How large the study is.

    Attributes
    ----------
    sweep : Sweep
        The cases.
    waiting : tuple of Case
        Those that have not been run.

    Raises
    ------
    ConfigError
        Where there is no drum of a name, or the folder is not one of a validation.

    Examples
    --------
    >>> from drumrs.validation import Validation
    >>> Validation("somewhere", ["tracer"])
    <Validation of tracer: 12 cases, 12 to be run>
    """

    def __init__(
        self,
        folder: str | Path,
        names: Sequence[str] = (),
        jobs: int | None = None,
        scale: Scale | None = None,
    ) -> None:
        for name in names:
            if name not in DRUMS:
                raise ConfigError("NAME", name, f"one of {', '.join(DRUMS)}")
        self.scale = scale or Scale()
        self.drums = [drum for drum in DRUMS.values() if not names or drum.name in names]
        configs = [(config, drum) for drum in self.drums for config in drum.cases(self.scale)]
        self._drum_of = {Case(config).id: drum for config, drum in configs}
        super().__init__(folder, (config for config, _ in configs), jobs, kind="validation", files=_FILES)

    def __repr__(self) -> str:
        """Say how much there is to do."""
        names = ", ".join(drum.name for drum in self.drums)
        return f"<Validation of {names}: {len(self.sweep)} cases, {len(self.waiting)} to be run>"

    def run(self, *, retry: bool = False, progress: bool = True) -> ValidationResult:
        """Run what is not finished, then compare, draw and write.

        Parameters
        ----------
        retry
            Whether cases that failed before are run again.
        progress
            Whether to show how far it is.

        Raises
        ------
        OSError
            Where something cannot be written; finished cases are kept.
        KeyboardInterrupt
            After Ctrl-C; finished cases are kept, and the same call goes on.
        """
        outcome = self.run_cases("published drums", retry=retry, progress=progress)
        with Task("measures, figures and page", 0, show=progress):
            return self._report(outcome.failures)

    def _report(self, failures: Sequence[Failure]) -> ValidationResult:
        """Measure, compare, draw and write."""
        results = Results(
            measure(self.sweep, self.runs_folder, self._drum_of), self.sweep, self.runs_folder, self.scale
        )
        table = self.folder / "table.parquet"
        write_table(table, results.table, metadata(known(results.table.columns)))
        failed = {self._drum_of[failure.case.id].name for failure in failures}
        whole = [drum for drum in self.drums if drum.name not in failed]
        checks = {drum.name: drum.checks(results) for drum in whole}
        for drum in whole:
            self._draw(drum, results)
        text = self.folder / "README.md"
        page.write(self.drums, checks, results, text)
        return ValidationResult(checks, failures, text, table)

    def _draw(self, drum: PublishedDrum, results: Results) -> None:
        path = self.folder / "figures" / f"{drum.name}.png"
        path.parent.mkdir(exist_ok=True)
        with attempt(path):
            from drumrs import figures

            figures.write(drum.draw(results), path)
