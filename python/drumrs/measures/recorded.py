"""What measures of records share: what they say where theirs is missing, and the names of the drum's parts."""

from typing import TYPE_CHECKING

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    import polars as pl


def required(table: "pl.DataFrame | None", record: str, measure: str) -> "pl.DataFrame":
    """Return a table of a result that is recorded on request.

    Parameters
    ----------
    table
        The table, `None` where it was not recorded.
    record
        Its name in ``run.record``.
    measure
        What it is needed for, in words.

    Raises
    ------
    ConfigError
        Where it was not recorded.
    """
    if table is None:
        problem = f"lacks {record!r}, needed for {measure}"
        raise ConfigError("run.record", problem=problem, hint=f"add {record!r} to it and run again")
    return table


def part_names(parts: "pl.Series") -> list[str]:
    """Return the names of all parts of the drum as quantities begin with them, such as "baffle_1"."""
    return [name.replace(" ", "_") for name in parts.dtype.categories]  # type: ignore[attr-defined]  # an Enum
