"""`StudyFolder`: the cases of a study in a folder of its own, what of them waits, and running them."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.folders import claim, require_own
from drumrs.jobs import effective_jobs
from drumrs.sweep.scheduler import Outcome
from drumrs.sweep.store import Store
from drumrs.sweep.sweep import Sweep

if TYPE_CHECKING:
    from drumrs.sweep.case import Case


class StudyFolder:
    """A fixed set of cases that are run into a folder; a folder of an earlier time is gone on with.

    Parameters
    ----------
    folder
        Where the results go, those of the cases into its folder ``runs``.
    configs
        The configurations.
    jobs
        Cases at once; one a usable core unless given.
    kind
        What the folder is of, one of `drumrs.folders.KINDS`.
    files
        What the study writes into it.

    Attributes
    ----------
    sweep : Sweep
        The cases.
    waiting : tuple of Case
        Those that have not been run.

    Raises
    ------
    ConfigError
        Where the number of jobs is not accepted, or the folder is not one of such a study that this version of drumrs
        knows.
    """

    def __init__(
        self,
        folder: str | Path,
        configs: Iterable[Config],
        jobs: int | None,
        *,
        kind: str,
        files: Sequence[str],
    ) -> None:
        self.folder, self.jobs, self._kind = Path(folder), effective_jobs(jobs), kind
        self.sweep = Sweep.from_configs(configs)
        require_own(self.folder, kind, (*files, "runs"))
        store = Store(self.runs_folder)
        store.check_format()
        self.waiting: tuple[Case, ...] = tuple(
            case for case in self.sweep.cases if not store.is_settled(case)
        )

    @property
    def runs_folder(self) -> Path:
        """Where the results of the cases are."""
        return self.folder / "runs"

    @property
    def cost(self) -> float:
        """Particle-steps still to be done."""
        return sum(case.cost for case in self.waiting)

    def run_cases(self, title: str, *, retry: bool = False, progress: bool = True) -> Outcome:
        """Run what is not finished.

        Parameters
        ----------
        title
            What the folder then says it is of.
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
        claim(self.folder, self._kind, title, "")
        return self.sweep.run(self.runs_folder, jobs=self.jobs, retry=retry, progress=progress)
