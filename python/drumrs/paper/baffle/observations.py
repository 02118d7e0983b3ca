"""Means and errors of all observables, shape by shape, from the table of a sweep."""

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis import estimate
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.sentences import ALONG, CARRIED, CIRCULATION, MIXED, POWER, RATIO
from drumrs.paper.measure import measure
from drumrs.paper.shape import Shape
from drumrs.sweep import Case, Sweep

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import polars as pl

    from drumrs.config import Config
    from drumrs.paper.baffle.design import Point

QUANTITIES = (POWER, RATIO, ALONG, CARRIED, MIXED, CIRCULATION)
_COLUMNS = ("height", "base", "tip", "softer", "seed", "fill", "size", "quantity", "value", "error")
Key = tuple[Shape | None, float]
"""A shape, or `None` for the bare drum, and the softness of the springs."""


def observe(points: "Mapping[Point, Config]", folder: Path) -> "pl.DataFrame":
    """Return the table of the means: one row a case and quantity."""
    import polars as pl

    cases = {point: Case(config) for point, config in points.items()}
    table = measure(Sweep.from_configs(points.values()), folder)
    rows = {row["case"]: row for row in table.iter_rows(named=True)}
    told = [
        {
            **dict(
                zip(
                    ("height", "base", "tip"),
                    point.shape.lengths if point.shape else (None,) * 3,
                    strict=True,
                )
            ),
            "softer": point.softer,
            "seed": point.seed,
            "fill": point.place[0],
            "size": point.place[1],
            "quantity": quantity,
            "value": row[quantity],
            "error": row[f"{quantity}_error"],
        }
        for point, case in cases.items()
        if (row := rows.get(case.id)) is not None
        for quantity in QUANTITIES
        if row[quantity] is not None
    ]
    kinds: dict[str, Any] = dict.fromkeys(_COLUMNS, pl.Float64) | {"seed": pl.Int64, "quantity": pl.String}
    return pl.DataFrame(told, schema=kinds)


def known_by_shape(table: "pl.DataFrame") -> dict[Key, Means]:
    """Return means over seeds and their errors, by shape and softness; shapes that lack some are left out.

    The error of a single seed is that of its blocks, doubled, as everywhere (`analysis.estimate`).
    """
    seeds: defaultdict[Key, defaultdict[Observable, list[tuple[float, float | None]]]]
    seeds = defaultdict(lambda: defaultdict(list))
    for row in table.iter_rows(named=True):
        shape = None if row["height"] is None else Shape(row["height"], row["base"], row["tip"])
        one = Observable(row["quantity"], row["fill"], row["size"], baffles=shape is not None)
        seeds[shape, row["softer"]][one].append((row["value"], row["error"]))
    found = {key: dict(_means(values)) for key, values in seeds.items()}
    whole = {
        key: max(len(other) for other_key, other in found.items() if _alike(key, other_key)) for key in found
    }
    return {key: known for key, known in found.items() if len(known) == whole[key]}


def _alike(key: Key, other: Key) -> bool:
    return (key[0] is None) == (other[0] is None) and key[1] == other[1]


def _means(
    values: "Mapping[Observable, list[tuple[float, float | None]]]",
) -> "Iterator[tuple[Observable, tuple[np.ndarray, np.ndarray]]]":
    for one, seeds in values.items():
        mean = estimate(*zip(*seeds, strict=True))
        yield one, (np.array(mean.mean), np.array(mean.error))
