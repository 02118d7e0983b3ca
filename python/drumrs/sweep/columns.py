"""Columns of a sweep's table: what a case is, its seed, the summary of its run, what its series tells."""

import json
from collections.abc import Iterator
from dataclasses import asdict, fields
from functools import cache
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel

from drumrs import registry
from drumrs.analysis import STATISTICS
from drumrs.config import Config
from drumrs.config.messages import table_type
from drumrs.result import Summary
from drumrs.sweep.case import Case

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import polars as pl
    from pydantic.fields import FieldInfo

CASE, SEED = "case", "seed"
# Facts of the machine, which differ from run to run.
TIMINGS = ("wall_time", "particle_steps_per_second")
_SEED_KEY = "run.seed"


def row(case: Case, summary: Summary, statistics: "Mapping[str, Any]") -> "pl.DataFrame":
    """Return the one row that stands for a finished case."""
    import polars as pl

    names = {CASE: case.id, **parameters(case.config), SEED: case.seed}
    values = {**names, **statistics, **asdict(summary)}
    return pl.DataFrame({name: [values[name]] for name in schema()}, schema=schema())


def parameters(config: Config) -> dict[str, Any]:
    """Return the configuration by dotted key, without the seed; "auto" among numbers is null."""
    kinds = _kinds()
    values = dict(_flat(config.model_dump(mode="json", exclude_none=True), kinds))
    return {key: _plain(values.get(key), kinds[key]) for key in kinds if key != _SEED_KEY}


def settings(case: Case) -> dict[str, Any]:
    """Return the parameters of a case and its seed."""
    return {**parameters(case.config), SEED: case.seed}


def differing(cases: "Sequence[Case]") -> list[str]:
    """Return the columns, among parameters and seed, in which cases differ."""
    first = settings(cases[0])
    found = {name for case in cases for name, value in settings(case).items() if value != first[name]}
    return [name for name in first if name in found]


def sort_keys() -> list[str]:
    """Return the columns that a table is sorted by: every parameter that has an order, the seed, the name."""
    keys = [
        key for key, kind in _kinds().items() if get_origin(_bare(kind)) is not tuple and key != _SEED_KEY
    ]
    return [*keys, SEED, CASE]


@cache
def schema() -> "dict[str, Any]":
    """Return name and polars type of every column."""
    import polars as pl

    types = {key: _type(kind) for key, kind in _kinds().items() if key != _SEED_KEY}
    hints = get_type_hints(Summary)
    summary = {field.name: _type(hints[field.name]) for field in fields(Summary) if field.name not in TIMINGS}
    told = {name: pl.Boolean if name == "drifting" else pl.Float64 for name in STATISTICS}
    return {CASE: pl.String, **types, SEED: pl.Int64, **summary, **told}


def metadata() -> dict[str, str]:
    """Return what the table's file carries beside it: units and meanings of parameters and results, as JSON."""
    parameters = [
        registry.Quantity(key, "", str(field.json_schema_extra["unit"]), "run", "", field.description or "")
        for key, field in _leaves(Config)
        if isinstance(field.json_schema_extra, dict)
    ]
    return registry.metadata([*parameters, *registry.known(schema())])


@cache
def _kinds() -> "Mapping[str, Any]":
    """Return the annotations of the dotted keys that hold values."""
    return {key: field.annotation for key, field in _leaves(Config)}


def _leaves(model: type[BaseModel], at: str = "") -> "Iterator[tuple[str, FieldInfo]]":
    """List the dotted keys that hold values, with their fields."""
    for key, field in model.model_fields.items():
        part = table_type(model, key)
        if part is not None:
            yield from _leaves(part, f"{at}{key}.")
        else:
            yield f"{at}{key}", field


def _flat(values: dict[str, Any], kinds: "Mapping[str, Any]", at: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in values.items():
        if f"{at}{key}" in kinds:
            yield f"{at}{key}", value
        else:
            yield from _flat(value, kinds, f"{at}{key}.")


def _plain(value: Any, kind: Any) -> Any:
    if value is not None and _is_table(_element(kind)):
        return [json.dumps(table) for table in value]
    return None if isinstance(value, str) and get_origin(_bare(kind)) is not Literal else value


def _bare(kind: Any) -> Any:
    """Return the type of values that a column holds: `float` for a number that may be missing or "auto"."""
    if get_origin(kind) is Annotated:
        return _bare(get_args(kind)[0])
    if get_origin(kind) in {Union, UnionType}:
        choices = [choice for choice in get_args(kind) if choice is not NoneType]
        numbers = [choice for choice in choices if get_origin(choice) is not Literal]
        return _bare((numbers or choices)[0])
    return kind


def _element(kind: Any) -> Any:
    """Return the type of the elements of a list, `None` for what is none."""
    kind = _bare(kind)
    return _bare(get_args(kind)[0]) if get_origin(kind) is tuple else None


def _is_table(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)


def _type(kind: Any) -> Any:
    """Return the polars type of a column; a table in a list stands there as JSON."""
    import polars as pl

    kind = _bare(kind)
    if _is_table(kind):
        return pl.String
    if get_origin(kind) is tuple:
        return pl.List(_type(get_args(kind)[0]))
    if get_origin(kind) is Literal:
        return pl.String
    return {float: pl.Float64, int: pl.Int64, bool: pl.Boolean, str: pl.String}[kind]
