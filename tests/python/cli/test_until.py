"""`drumrs run --until`: on beyond the duration until the power is known, or a limit."""

import json

import polars as pl
import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.precision import Goal, _next_end, run_until_precise
from drumrs.run_folder import RunFolder

SHORT = ["--set", "load.count=20", "--set", "run.duration=0.2", "--set", "run.window=[0.1, 0.2]"]


def test_until_is_reached(drum, tmp_path):
    out = tmp_path / "out"
    status, _, told = drum("run", *SHORT, "--until", "0.3", "--limit", "4", "--out", out)
    assert status == 0
    summary = drumrs.load(out).summary
    assert summary.drum_specific_power_error / summary.drum_specific_power <= 0.3
    assert "was asked for" in told
    # The folder is that of the longer run.
    config = drumrs.load(out).config
    assert 0.2 < config.run.duration < 4.0
    assert config.run.window == (0.1, config.run.duration)
    assert summary.window_end == pytest.approx(config.run.duration, abs=0.002)
    longer = drumrs.run(config, progress=False)
    assert longer.series.equals(pl.read_parquet(out / "series.parquet"))
    assert longer.summary.drum_specific_power == summary.drum_specific_power


def test_the_limit_ends_it(drum):
    status, printed, told = drum("run", *SHORT, "--until", "0.0001", "--limit", "0.5", "--json")
    assert status == 0
    assert json.loads(printed)["window_end"] == pytest.approx(0.5, abs=0.002)
    assert "the limit of 0.5 s is reached, but" in told
    assert "not 0.01 %" in told


def test_a_run_that_is_good_enough_ends_as_ever(drum):
    _, plain, _ = drum("run", *SHORT, "--json")
    _, printed, _ = drum("run", *SHORT, "--until", "0.99", "--json")
    timings = {"wall_time", "particle_steps_per_second"}
    assert {k: v for k, v in json.loads(plain).items() if k not in timings} == {
        k: v for k, v in json.loads(printed).items() if k not in timings
    }


def test_resume_ends_as_without_a_break(drum, tmp_path):
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    goal = ["--until", "0.02", "--limit", "0.8"]
    assert drum("run", *SHORT, *goal, "--out", whole)[0] == 0
    # As after a power cut in a run that had gone beyond its duration.
    config = drumrs.baseline().replace(
        {"load.count": 20, "run.duration": 0.2, "run.window": [0.1, 0.2], "run.seed": 1}
    )
    RunFolder(broken).begin(config)
    simulation = drumrs.Simulation(config)
    simulation.run()
    simulation.extend_to(_next_end(simulation, Goal(0.02, 0.8)))
    simulation.run(steps=1000)
    simulation.save(broken / "checkpoint.bin")
    assert drum("run", "--resume", broken, *goal)[0] == 0
    for name in ("series.parquet", "frames.parquet", "config.toml"):
        assert (whole / name).read_bytes() == (broken / name).read_bytes(), name


def test_the_limit_is_ten_durations():
    assert Goal.of(0.01, None, 30.0) == Goal(0.01, 300.0)


def test_looks_are_no_further_apart_than_windows(monkeypatch):
    simulation = drumrs.Simulation(
        drumrs.baseline(fill=0.05).replace({"run.duration": 0.2, "run.window": [0.1, 0.2]})
    )
    for found, end in (
        (0.0099, None),
        (0.0101, 0.1 + 0.1 * 1.122),
        (0.0125, 0.1 + 0.1 * 1.71875),
        (9.0, 0.3),
    ):
        monkeypatch.setattr("drumrs.precision._precision", lambda _, found=found: found)
        assert _next_end(simulation, Goal(0.01, 1.0)) == (end and pytest.approx(end, rel=1e-3))
    assert _next_end(simulation, Goal(0.01, 0.25)) == 0.25
    assert _next_end(simulation, Goal(0.01, 0.2)) is None


def test_fields_and_visits_go_on_with_the_window():
    zone = {"name": "right", "corners": [[0.0, -0.3], [0.3, -0.3], [0.3, 0.3], [0.0, 0.3]]}
    keys = {"run.duration": 0.3, "run.window": [0.1, 0.3], "run.record": ["fields"], "run.zone": [zone]}
    simulation = drumrs.Simulation(drumrs.baseline(fill=0.1).softer(100.0).replace(keys))
    run_until_precise(simulation, Goal(1e-9, 0.8), progress=False)
    config = simulation.config
    assert config.run.window == (0.1, 0.8)
    at_once = drumrs.Simulation(config)
    at_once.run_to_step(at_once.last_step)
    tables, same = (each.records.contact_tables() for each in (simulation, at_once))
    for name in ("fields", "zone_visits"):
        assert tables[name].equals(same[name])
    # They began with the window: bundles are in the zone or not, and no longer than it has lasted.
    assert 0.5 < tables["zone_visits"]["time_inside"].max() <= 0.7 + 2e-3


def test_a_load_without_power_ends_at_the_limit():
    config = drumrs.baseline(fill=0.05).replace(
        {"run.duration": 0.2, "rotation.rpm": 0.0, "run.sample_every": 0.04, "run.window": [0.1, 0.2]}
    )
    told = run_until_precise(drumrs.Simulation(config), Goal(0.5, 0.3), progress=False)
    assert "the limit of 0.3 s is reached" in told
    assert "not known" in told


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["--until", "0"], "--until is 0.0, but must be between 0 and 1"),
        (["--until", "-1"], "--until is -1.0"),
        (["--until", "nan"], "--until is nan"),
        (["--until", "1"], "--until is 1.0"),
        (["--until", "soon"], "--until"),
        (["--limit", "50"], "--limit is 50.0, but must be left out where --until is not given"),
        (["--until", "0.01", "--limit", "20"], "--limit is 20.0, but must be at least run.duration = 30.0"),
        (["--until", "0.01", "--limit", "inf"], "--limit is inf"),
    ],
)
def test_bad_words(drum, tmp_path, words, names):
    status, printed, told = drum("run", *words, "--out", tmp_path / "out")
    assert (status, printed) == (2, "")
    assert names in told
    assert told.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_extending_never_shortens(short):
    simulation = drumrs.Simulation(short)
    for duration in (0.01, float("nan"), float("inf")):
        with pytest.raises(ConfigError, match="at least run"):
            simulation.extend_to(duration)
