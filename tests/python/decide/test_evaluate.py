"""Evaluations: what is simulated, what is not again, and what becomes of runs that fail."""

import math

import pytest

import drumrs
from drumrs.decide import Evaluator, evaluate
from drumrs.errors import ConfigError, DrumrsWarning


@pytest.fixture
def config():
    return drumrs.baseline(fill=0.05).replace({"run.duration": 0.1})


def test_estimates_come_in_the_order_of_configurations_and_targets(config, tmp_path):
    more = config.replace({"load.fill": 0.1})
    found = evaluate(
        [more, config, more], ["bundle_count", "drum_power"], out=tmp_path, seeds=range(2), progress=False
    )
    assert [row[0].mean for row in found] == [40.0, 20.0, 40.0]
    assert found[0] == found[2]
    powers = [
        drumrs.run(more.replace({"run.seed": seed}), progress=False).summary.drum_power for seed in range(2)
    ]
    assert found[0][1].mean == pytest.approx(sum(powers) / 2.0)


def test_nothing_is_simulated_twice(config, tmp_path, monkeypatch):
    ask = Evaluator(["drum_power"], tmp_path, progress=False)
    assert len(ask.missing([config, config])) == 1
    before = ask.means([config])
    assert not ask.missing([config])

    def simulate(*_):
        raise AssertionError("simulated again")

    monkeypatch.setattr("drumrs.sweep.worker._simulate", simulate)
    assert ask.means([config]) == before
    assert Evaluator(["drum_power"], tmp_path, progress=False).means([config]) == before


def test_runs_record_what_targets_need(config, tmp_path):
    ask = Evaluator(["gross_work_ratio"], tmp_path, progress=False)
    assert ask.case(config).config.run.record == ("gross_work",)
    ((found,),) = ask.means([config])
    assert found.value > 0.0


def test_a_run_that_fails_counts_for_nothing_and_is_named(config, tmp_path):
    # So soft that bundles overlap at once.
    bad = config.replace({"contact.bundle.normal_stiffness": 10.0, "contact.drum.normal_stiffness": 10.0})
    with pytest.warns(DrumrsWarning, match="1 of 2 runs failed and count for nothing: 20 bundles"):
        (good,), (failed,) = evaluate([config, bad], ["drum_power"], out=tmp_path, progress=False)
    assert math.isfinite(good.mean)
    assert math.isnan(failed.mean)
    with pytest.raises(ConfigError, match=r"configs fail in every run \(1\)"):
        evaluate([bad], ["drum_power"], out=tmp_path, progress=False)


def test_measures_of_frames_want_frames(config, tmp_path):
    without = config.replace({"run.frame_every": 1.0})
    with pytest.raises(
        ConfigError, match=r"run\.frame_every is 1\.0, but must be smaller than run\.duration"
    ):
        evaluate([without], ["falls_per_turn"], out=tmp_path, progress=False)


def test_what_is_asked_is_checked_before_anything_runs(config, tmp_path):
    with pytest.raises(ConfigError, match="at least one target"):
        evaluate([config], [], out=tmp_path)
    with pytest.raises(ConfigError, match="at least one seed"):
        evaluate([config], ["drum_power"], out=tmp_path, seeds=[], progress=False)
    assert not list(tmp_path.iterdir())
