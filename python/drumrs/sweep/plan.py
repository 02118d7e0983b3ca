"""The plan of a sweep: the list of its cases, kept in its folder for whoever asks there how far it is."""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.errors import ConfigError
from drumrs.files import read_plain, write_whole
from drumrs.sweep.case import Case, is_id

if TYPE_CHECKING:
    import polars as pl

PLAN = "plan.parquet"


def write_plan(folder: Path, cases: Sequence[Case]) -> None:
    """Write the list of a sweep's cases, with what each costs and how often it leaves a checkpoint.

    It takes the place of that of the sweep before; where many processes run one sweep, the first writes it.
    """
    import polars as pl

    columns = {
        "case": [case.id for case in cases],
        "particle_steps": [case.cost for case in cases],
        "checkpoint_every": [case.config.run.checkpoint_every for case in cases],
    }
    buffer, path = io.BytesIO(), folder / PLAN
    pl.DataFrame(columns, _schema()).write_parquet(buffer)
    if not path.is_file() or read_plain(path) != buffer.getvalue():
        write_whole(path, buffer.getvalue())


def read_plan(folder: Path) -> "pl.DataFrame | None":
    """Return the list of the cases of the last sweep in a folder; `None` where none has left one.

    Raises
    ------
    ConfigError
        Where the file is damaged.
    """
    import polars as pl

    path = folder / PLAN
    if not path.exists():
        return None
    try:
        plan = pl.read_parquet(io.BytesIO(read_plain(path)))
    except (OSError, pl.exceptions.PolarsError) as error:
        raise _damaged(path) from error
    if plan.schema != _schema():
        raise _damaged(path)
    return plan


def planned_case(folder: Path, case: str) -> Case | None:
    """Return a case by its id from the file that stands for it in a sweep's folder; `None` where there is none."""
    path = folder / f"{case}.toml"
    if not is_id(case) or not path.is_file():
        return None
    try:
        found = Case(Config.read(path))
    except ConfigError:
        return None
    return found if found.id == case else None


def _schema() -> "pl.Schema":
    import polars as pl

    return pl.Schema({"case": pl.String, "particle_steps": pl.Float64, "checkpoint_every": pl.Float64})


def _damaged(path: Path) -> ConfigError:
    hint = "remove it; the sweep, run again, writes it anew"
    return ConfigError(path, problem="is damaged or no list of a sweep's cases", hint=hint)
