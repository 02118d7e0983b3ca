"""Units stand in a parquet file where PyArrow and pandas look: in its Arrow schema, beside the words of the file."""

import base64
import io
import json

import polars as pl

import drumrs
from drumrs.column_words import with_schema

WORDS = {
    "units": json.dumps({"drum_power": "W/m"}),
    "meanings": json.dumps({"time": "since t₀"}),
    "other": "kept",
}


def test_words_go_to_the_columns_and_the_table():
    table = pl.DataFrame({"time": [0.0, 1.0], "drum_power": [2.0, 3.0], "count": [1, 2]})
    file = io.BytesIO()
    table.write_parquet(file, metadata=with_schema(WORDS, table.schema))
    file.seek(0)
    assert pl.read_parquet(file).equals(table)
    file.seek(0)
    found = pl.read_parquet_metadata(file)
    assert {key: found[key] for key in WORDS} == WORDS
    schema = base64.b64decode(found["ARROW:schema"])
    for word in (
        b"unit\0",
        b"W/m",
        b"meaning\0",
        "since t₀".encode(),
        b"units\0",
        b"meanings\0",
        b"PANDAS_ATTRS",
    ):
        assert word in schema, word
    assert b"kept" not in schema


def test_a_file_without_units_is_as_polars_writes_it():
    assert with_schema({"other": "kept"}, pl.Schema({"time": pl.Float64})) == {"other": "kept"}


def test_tables_of_runs_and_sweeps_carry_them(short, tmp_path):
    drumrs.save(drumrs.run(short, progress=False), tmp_path / "run", pictures=False)
    sweep = drumrs.Sweep.from_configs([short])
    sweep.run(tmp_path / "sweep", progress=False)
    case = sweep.cases[0].id
    files = (
        *(tmp_path / "run" / f"{name}.parquet" for name in ("series", "frames")),
        *(tmp_path / "sweep" / f"{case}.{name}.parquet" for name in ("series", "frames")),
        sweep.write_table(),
    )
    for path in files:
        words = pl.read_parquet_metadata(path)
        assert json.loads(words["units"])
        assert b"unit\0" in base64.b64decode(words["ARROW:schema"]), path
