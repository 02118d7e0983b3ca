"""`StudyData`: a study that was run, as figures, verdicts and report read it."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.paper.cases import percent
from drumrs.paper.claims import judge
from drumrs.paper.curves import Results
from drumrs.paper.drums import BARE, Drum
from drumrs.paper.verdict import MissingError, Verdict
from drumrs.sweep import Case, Failure, Sweep

if TYPE_CHECKING:
    import polars as pl


@dataclass(frozen=True, eq=False)
class StudyData:
    """A study that was run.

    Attributes
    ----------
    table
        What `measure` returned.
    sweep
        Its cases.
    folder
        Where their results are; that of the sweep's last run unless given.
    scale
        Its size, such as ``"quick"``.
    failures
        Cases without results.
    wall_time
        Time [s] that the last call took, however much there was left to do; `None` where not known.
    """

    table: "pl.DataFrame"
    sweep: Sweep
    folder: str | Path | None = None
    scale: str = "own"
    failures: tuple[Failure, ...] = ()
    wall_time: float | None = None

    @cached_property
    def verdicts(self) -> list[Verdict]:
        """A verdict on each claim of the paper."""
        return judge(self.table)

    @cached_property
    def results(self) -> Results:
        """The table read as curves."""
        return Results(self.table)

    @cached_property
    def configs(self) -> dict[str, Config]:
        """Configuration of every case by its name."""
        return {case.id: case.config for case in self.sweep.cases}

    @cached_property
    def seeds(self) -> list[list[Config]]:
        """Configurations that differ by their seeds alone, together."""
        found: dict[str, list[Config]] = {}
        for config in self.configs.values():
            found.setdefault(config.replace({"run.seed": 1}).digest, []).append(config)
        return list(found.values())

    def cases(self, fill: float, drum: Drum = BARE) -> list[Case]:
        """Return the finished cases of a fill in a drum, all else as in Table 1, by seed.

        Raises
        ------
        MissingError
            Where there are none.
        """
        finished, like = set(self.table["case"]), drum.config(fill)
        found = [case for case in self.sweep.cases if case.id in finished and _same_drum(case.config, like)]
        if not found:
            raise MissingError(f"runs at {percent(fill)} fill {drum.name}")
        return sorted(found, key=lambda case: case.config.run.seed)


def _same_drum(config: Config, like: Config) -> bool:
    return all(getattr(config, part) == getattr(like, part) for part in Config.model_fields if part != "run")
