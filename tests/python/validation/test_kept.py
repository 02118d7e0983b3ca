"""The table that is kept in docs/validation has the columns that a validation would write today."""

from pathlib import Path

import polars as pl

from drumrs.measures.profile import flowing_layer
from drumrs.registry import known, quantity
from drumrs.verification import made_up

KEPT = Path(__file__).parents[3] / "docs" / "validation" / "table.parquet"


def test_kept_names_are_those_of_today():
    table = pl.read_parquet(KEPT)
    layer = flowing_layer(made_up.segment(1.4, 0.5, 0.03), (0.0, 1.0))
    assert set(layer) <= set(table.columns)
    assert {"toe_angle", "shoulder_angle", "center_slope"} <= {own.name for own in known(table.columns)}
    words = pl.read_parquet_metadata(KEPT)
    assert quantity("center_slope").meaning in words["meanings"]
