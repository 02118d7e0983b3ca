"""`Findings`: a finished study with everything a report tells of it."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs import study
from drumrs.study.curves import Results

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config
    from drumrs.sweep import Failure, Sweep


@dataclass(frozen=True, eq=False)
class Findings:
    """A finished study.

    Attributes
    ----------
    scale
        Its size, such as ``"quick"``.
    sweep
        Its cases.
    folder
        Where their results are.
    table
        What `study.measure` made of them.
    failures
        Cases without results.
    wall_time
        Time [s] that the last call took, however much there was left to do; `None` where not known.
    """

    scale: str
    sweep: "Sweep"
    folder: Path
    table: "pl.DataFrame"
    failures: "tuple[Failure, ...]" = ()
    wall_time: float | None = None

    @cached_property
    def verdicts(self) -> list[study.Verdict]:
        """A verdict on each claim of the paper."""
        return study.judge(self.table)

    @cached_property
    def results(self) -> Results:
        """The table read as curves."""
        return Results(self.table)

    @cached_property
    def material(self) -> study.Material:
        """What figures are drawn from."""
        return study.Material(self.table, self.sweep, self.folder)

    @cached_property
    def configs(self) -> "dict[str, Config]":
        """Configuration of every case by its name."""
        return {case.id: case.config for case in self.sweep.cases}
