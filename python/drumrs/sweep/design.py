"""Designs: axes and rows as configurations, checked before anything is simulated."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any, cast

from drumrs.config import Config
from drumrs.config.messages import dotted_keys
from drumrs.errors import ConfigError, format_value
from drumrs.sweep.case import Case

Axes = Mapping[str, Iterable[Any]]
Seeds = Iterable[int] | int | None
# What `polars.DataFrame` takes: also a table of pandas, a dict of columns, a list of dicts.
Rows = Any

_SEED = "run.seed"


def from_axes(base: Config, axes: Axes | None, seeds: Seeds) -> tuple[Case, ...]:
    """Return the cases of every combination of the axes' values with every seed.

    Raises
    ------
    ConfigError
        Where an axis names no key, is empty or holds a value that is not accepted, or where a case comes twice.
    """
    if axes is not None and not isinstance(axes, Mapping):
        raise ConfigError("axes", axes, "a table of keys with a list of values each")
    if axes is not None and not axes:
        raise ConfigError("axes", axes, "a table of at least one key with a list of values")
    _check_keys(base, axes or ())
    values = {key: _values(key, axis) for key, axis in (axes or {}).items()}
    points = [dict(zip(values, point, strict=True)) for point in product(*values.values())]
    return _distinct(base, _with_seeds(points, list(values), seeds))


def from_rows(base: Config, table: Rows, seeds: Seeds) -> tuple[Case, ...]:
    """Return the cases of a table's rows with every seed; its columns are dotted keys, null keeps the base's value.

    Raises
    ------
    ConfigError
        Where a column names no key, a value is not accepted, there is no row, or a case comes twice.
    """
    import polars as pl

    try:
        frame = table if isinstance(table, pl.DataFrame) else pl.DataFrame(table)
    except (TypeError, ValueError, pl.exceptions.PolarsError) as error:
        limit = f"a table of polars or pandas, or a list of dicts: {error}"
        problem = f"is of type {type(table).__name__}, but must be {limit}"
        raise ConfigError("the table of rows", limit=limit, problem=problem) from None
    if not frame.height or not frame.width:
        problem = f"has {frame.height} rows and {frame.width} columns, but must have some of both"
        raise ConfigError("the table of rows", problem=problem)
    _check_keys(base, frame.columns)
    rows = [
        {key: value for key, value in row.items() if value is not None} for row in frame.iter_rows(named=True)
    ]
    return _distinct(base, _with_seeds(rows, frame.columns, seeds))


def from_configs(configs: Iterable[Config]) -> tuple[Case, ...]:
    """Return the cases of configurations, seed inside; one that comes again is the same case.

    Raises
    ------
    ConfigError
        Where there is none.
    """
    cases = {case.id: case for case in map(Case, configs)}
    if not cases:
        raise ConfigError("configs", [], "a list of at least one configuration")
    return tuple(cases.values())


def _check_keys(base: Config, keys: Iterable[str]) -> None:
    known = set(dotted_keys(Config))
    for key in keys:
        if key not in known:
            # The configuration's own sentence, which knows what was meant.
            base.replace({key: 0})


def _values(key: str, axis: Iterable[Any]) -> list[Any]:
    listed = _items(axis)
    if not listed:
        raise ConfigError(f"the axis {key}", axis, "a list of at least one value")
    return listed


def _with_seeds(
    points: Sequence[Mapping[str, Any]], keys: Iterable[str], seeds: Seeds
) -> list[dict[str, Any]]:
    """Repeat every point with every seed; without seeds, the point's or the base's own stands."""
    if seeds is None:
        return [dict(point) for point in points]
    if _SEED in keys:
        raise ConfigError(_SEED, problem="is varied and seeds are given, but only one of them may be")
    return [{**point, _SEED: seed} for point in points for seed in _listed(seeds)]


def _listed(seeds: Iterable[int] | int) -> list[int]:
    """Return the seeds; a number n stands for 0 … n − 1."""
    is_number = isinstance(seeds, int) and not isinstance(seeds, bool)
    listed = _items(range(cast("int", seeds)) if is_number else seeds)
    if not listed:
        raise ConfigError("seeds", seeds, "a list of at least one seed, or their number")
    return listed


def _items(values: Any) -> list[Any]:
    """Return the items of a list, none of what is no list."""
    listed = isinstance(values, Iterable) and not isinstance(values, (str, bytes, Mapping))
    return list(values) if listed else []


def _distinct(base: Config, changes: Sequence[Mapping[str, Any]]) -> tuple[Case, ...]:
    cases: dict[str, Case] = {}
    for change in changes:
        case = Case(base.replace(change))
        if case.id in cases:
            settings = ", ".join(f"{key} = {format_value(value)}" for key, value in change.items())
            raise ConfigError(f"the case {settings}", problem="is there twice, but must be there once")
        cases[case.id] = case
    return tuple(cases.values())
