"""What a sweep leaves in its folder: whole files that know whose they are, and one sorted table."""

import json
import os
import shutil
import time
from dataclasses import asdict

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.analysis import Mean, statistics
from drumrs.errors import ConfigError
from drumrs.measures import charge
from drumrs.sweep.columns import TIMINGS, schema
from drumrs.sweep.sealed import FORMAT, write_sealed

SHORT = {"run.duration": 0.06, "run.sample_every": 0.001, "run.frame_every": 0.02}
BASE = drumrs.baseline(fill=0.05).replace(SHORT)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A sweep of two cases, finished; tests that change files work on a copy."""
    folder = tmp_path_factory.mktemp("finished")
    sweep = drumrs.Sweep(BASE, {"drum.baffles.count": [3, 0]})
    sweep.run(folder, progress=False)
    return sweep, folder


@pytest.fixture
def copy(finished, tmp_path):
    sweep, folder = finished
    shutil.copytree(folder, tmp_path / "copy")
    return sweep, tmp_path / "copy"


def test_files_of_a_case(finished):
    sweep, folder = finished
    endings = ("toml", "parquet", "series.parquet", "frames.parquet", "facts.json")
    names = {f"{case.id}.{ending}" for case in sweep.cases for ending in endings}
    assert {path.name for path in folder.iterdir()} == names | {"drumrs-sweep.json", "plan.parquet"}
    for case in sweep.cases:
        assert drumrs.Config.read(folder / f"{case.id}.toml") == case.config


def test_results_are_those_of_a_run(finished):
    sweep, folder = finished
    case = sweep.cases[0]
    result = drumrs.run(case.config, progress=False)
    assert sweep.series(case).equals(result.series)
    frames = sweep.frames(case, folder)
    for name in ("times", "positions", "angles", "speeds", "radii", "drum_angles"):
        assert np.array_equal(getattr(frames, name), getattr(result.frames, name)), name
    assert all(np.array_equal(*pair) for pair in zip(frames.baffles, result.frames.baffles, strict=True))
    row = sweep.table().filter(pl.col("case") == case.id).collect().row(0, named=True)
    known = asdict(result.summary)
    for name in known.keys() - set(TIMINGS):
        assert row[name] == known[name], name
    assert case.load_mass == pytest.approx(drumrs.Simulation(case.config).masses.sum(), rel=1e-12)
    found = statistics(result.series, case.config.run.averaging_window, case.load_mass)
    # What the summary tells, too, may differ in its last bits.
    assert {name for name, value in found.items() if value is None} == {
        name for name in found if row[name] is None
    }
    known = {name: value for name, value in found.items() if value is not None}
    assert {name: row[name] for name in known} == pytest.approx(known, rel=1e-9)


def test_measures_of_a_sweep_are_those_of_its_runs(tmp_path):
    changes = {"run.record": ["contacts", "wall_profile"], "drum.baffles.count": 3}
    sweep = drumrs.Sweep(BASE.replace(changes), seeds=2)
    sweep.run(tmp_path, progress=False)
    results = []

    def measure(result):
        results.append(result)
        return {
            "arm": Mean(0.25, None),
            "drum_power": float("nan"),
            "hits": len(result.contacts),
            "none": None,
            "name": "rolling",
        }

    table = sweep.measure(measure)
    assert (
        table.select("arm", "arm_error", "drum_power", "none", "name").rows()
        == [(0.25, None, None, None, "rolling")] * 2
    )
    run = drumrs.run(sweep.cases[0].config, progress=False)
    assert table["hits"][0] == len(run.contacts)
    assert results[0].dissipated == run.dissipated
    assert results[0].wall_profile.equals(run.wall_profile)
    assert results[0].config == run.config
    assert results[0].summary.drum_power == run.summary.drum_power


def test_a_case_without_frames_is_measured_without(tmp_path):
    sweep = drumrs.Sweep(BASE.replace({"run.frame_every": 1.0}))
    sweep.run(tmp_path, progress=False)
    table = sweep.measure(lambda result: {"frames": len(result.frames), "rows": len(result.series)})
    assert table.select("frames", "rows").row(0) == (0.0, len(sweep.series(sweep.cases[0])))
    with pytest.raises(ConfigError, match="at least two frames"):
        sweep.measure(lambda result: charge(result.frames, (0.0, 0.06)))


def test_a_row_tells_the_whole_configuration(tmp_path):
    config = drumrs.baseline(fill=0.05).replace(
        {
            **SHORT,
            "run.time_step": "auto",
            "rotation.program": [[0.0, 0.0], [1.0, 30.0]],
            "contact.drum.tension": "clipped",
            "drum.walls": [[[-0.1, 0.0], [0.1, 0.0]]],
            "run.seed": 4,
        }
    )
    sweep = drumrs.Sweep.from_configs([config])
    sweep.run(tmp_path, progress=False)
    row = sweep.table().collect().row(0, named=True)
    assert (row["load.fill"], row["load.count"], row["rotation.rpm"], row["seed"]) == (0.05, None, None, 4)
    assert row["rotation.program"] == [[0.0, 0.0], [1.0, 30.0]]
    assert row["drum.walls"] == [[[-0.1, 0.0], [0.1, 0.0]]]
    assert row["contact.drum.tension"] == "clipped"
    assert row["run.time_step"] is None
    assert row["time_step"] > 1e-6
    assert row["gravity"] == [0.0, -9.81]


def test_the_table_is_lazy_sorted_and_the_same_for_any_order(finished):
    sweep, folder = finished
    table = sweep.table()
    assert isinstance(table, pl.LazyFrame)
    assert table.select("drum.baffles.count").collect().to_series().to_list() == [0, 3]
    turned = drumrs.Sweep(BASE, {"drum.baffles.count": [0, 3]})
    assert turned.table(folder).collect().equals(table.collect())
    assert dict(table.collect_schema()) == schema()


def test_the_table_of_no_case_has_all_columns(tmp_path):
    empty = drumrs.Sweep(BASE).table(tmp_path / "nothing").collect()
    assert empty.height == 0
    assert dict(empty.schema) == schema()


def test_facts_are_kept_apart(finished):
    sweep, _ = finished
    facts = sweep.facts()
    assert facts["case"].to_list() == [case.id for case in sweep.cases]
    for name in TIMINGS:
        assert all(value > 0.0 for value in facts[name])
    assert not set(TIMINGS) & set(sweep.table().collect_schema())


def test_frames_are_kept_where_they_come_oftener_than_once(tmp_path):
    rare = BASE.replace({"run.frame_every": 0.06})
    sweep = drumrs.Sweep.from_configs([rare])
    assert sweep.run(tmp_path, progress=False).finished == 1
    assert not list(tmp_path.glob("*.frames.parquet"))
    with pytest.raises(ConfigError, match=r"frames\.parquet' cannot be read"):
        sweep.frames(sweep.cases[0])


def flipped(data: bytes, index: int) -> bytes:
    return data[:index] + bytes([data[index] ^ 1]) + data[index + 1 :]


def damaged(data: bytes, how: str, other: bytes) -> bytes:
    return {
        "empty": b"",
        "half": data[: len(data) // 2],
        "a byte of the data": flipped(data, 300),
        "a byte of the footer": flipped(data, len(data) - 30),
        "a byte of the seal": flipped(data, data.rindex(b'"sha256": "') + 20),
        "text": b"no parquet at all",
        "another case's": other,
    }[how]


DAMAGE = [
    "empty",
    "half",
    "a byte of the data",
    "a byte of the footer",
    "a byte of the seal",
    "text",
    "another case's",
]


@pytest.mark.parametrize("content", ["parquet", "series.parquet", "frames.parquet"])
@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_files_are_named_and_computed_again(copy, damage, content):
    sweep, folder = copy
    first, second = (folder / f"{case.id}.{content}" for case in sweep.cases)
    before = first.read_bytes()
    first.write_bytes(damaged(before, damage, second.read_bytes()))
    read = {
        "parquet": lambda: sweep.table(folder),
        "series.parquet": lambda: sweep.series(sweep.cases[0], folder),
        "frames.parquet": lambda: sweep.frames(sweep.cases[0], folder),
    }
    with pytest.raises(ConfigError, match=first.name):
        read[content]()
    outcome = sweep.run(folder, progress=False)
    assert (outcome.computed, outcome.finished) == (1, 2)
    assert len(outcome.replaced) == 1
    assert first.name in outcome.replaced[0]
    assert first.read_bytes() == before


def test_foreign_parquet_is_named(copy):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.parquet"
    pl.DataFrame({"case": [sweep.cases[0].id], "drum_specific_power": [1.0]}).write_parquet(path)
    with pytest.raises(ConfigError, match=f"{path.name}' was not written by drumrs; run the sweep again"):
        sweep.table(folder)
    (folder / "other.parquet").write_bytes(path.read_bytes())
    assert sweep.run(folder, progress=False).computed == 1
    assert sweep.table(folder).collect().height == 2


def test_damage_is_named_where_one_looks(copy, capsys):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.parquet"
    path.write_bytes(b"")
    sweep.run(folder)
    assert capsys.readouterr().err == f"{str(path)!r} is damaged or no parquet file; it is computed again\n"


def test_a_missing_series_is_computed_again(copy):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.series.parquet"
    before = path.read_bytes()
    path.unlink()
    outcome = sweep.run(folder, progress=False)
    assert outcome.computed == 1
    assert path.name in outcome.replaced[0]
    assert path.read_bytes() == before


def test_a_row_of_older_columns_is_made_again_without_simulating(copy, monkeypatch):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.parquet"
    before = path.read_bytes()
    old = pl.read_parquet(path).drop("drifting").with_columns(one_more=1.0)
    write_sealed(path, sweep.cases[0].id, "summary", old)
    with pytest.raises(ConfigError, match=f"{path.name}' has the columns of another version"):
        sweep.table(folder)
    monkeypatch.setattr("drumrs.sweep.worker.Simulation", None)
    assert sweep.run(folder, progress=False).finished == 2
    assert path.read_bytes() == before


def test_a_row_that_lacks_more_is_computed_again(copy):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.parquet"
    before = path.read_bytes()
    write_sealed(path, sweep.cases[0].id, "summary", pl.read_parquet(path).drop("coordination"))
    assert sweep.run(folder, progress=False).computed == 1
    assert path.read_bytes() == before


def test_another_physics_is_another_result(copy, monkeypatch):
    sweep, folder = copy
    monkeypatch.setattr("drumrs.sweep.sealed.physics_version", lambda: 10**9)
    with pytest.raises(
        ConfigError, match=f"has physics_version {drumrs.info()['physics_version']}, but must have 1000000000"
    ):
        sweep.table(folder)


@pytest.mark.parametrize("mark", [json.dumps({"format": FORMAT + 1}), '{"format": "x"}'])
def test_a_newer_folder_is_refused(copy, drum, mark):
    sweep, folder = copy
    (folder / "drumrs-sweep.json").write_text(mark)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    for use in (lambda: sweep.run(folder, progress=False), lambda: sweep.table(folder)):
        with pytest.raises(ConfigError, match="a newer drumrs made it"):
            use()
    path = folder.parent / "sweep.toml"
    path.write_text("seeds = 1")
    status, _, complaint = drum("sweep", path, "--out", folder)
    assert (status, complaint.count("\n")) == (2, 1)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize("mark", ["", "[]", "{}"])
def test_a_damaged_mark_is_refused(copy, mark):
    sweep, folder = copy
    (folder / "drumrs-sweep.json").write_text(mark)
    with pytest.raises(ConfigError, match=r"drumrs-sweep.json' is damaged"):
        sweep.run(folder, progress=False)


def test_leftovers_of_a_killed_writer_go(copy):
    sweep, folder = copy
    old, young = folder / ".x.parquet.0badcafe.tmp", folder / ".y.parquet.0badcafe.tmp"
    for path in (old, young):
        path.write_bytes(b"half")
    os.utime(old, (time.time() - 7200, time.time() - 7200))
    sweep.run(folder, progress=False)
    assert not old.exists()
    assert young.exists()


def test_a_folder_has_to_be_one(tmp_path, finished):
    sweep, _ = finished
    (tmp_path / "file").write_text("in the way")
    for folder in (tmp_path / "file", tmp_path / "file" / "below", "/proc/drumrs"):
        with pytest.raises(ConfigError, match="but must be a folder that can be written"):
            sweep.run(folder, progress=False)
    with pytest.raises(
        ConfigError, match="folder is None, but must be given where the sweep has not been run"
    ):
        drumrs.Sweep(BASE).table()
