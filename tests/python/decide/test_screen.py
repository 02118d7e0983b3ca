"""`drumrs screen`: designs made into runs, dead keys left out, what is said; a short real screening by command."""

import io
from importlib import import_module

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.analysis import Mean
from drumrs.cli import main
from drumrs.decide import ScreeningPlan
from drumrs.errors import ConfigError
from drumrs.sweep import Case

RANGES = {
    "rotation.rpm": [20.0, 60.0],
    "contact.bundle.friction": [0.2, 0.6],
    "contact.bundle.restitution": [0.1, 0.5],
}
PLAN = {
    "base": drumrs.baseline(),
    "ranges": RANGES,
    "axes": {"drum.baffles.count": [0, 3, 4]},
    "screen": {"targets": ["drum_power"], "trajectories": 10, "points": 64},
}


@pytest.fixture
def asked(monkeypatch):
    """Put a formula in place of runs: the power of speed, friction and their product, and noise of each seed."""
    configs = []

    class Formula:
        def __init__(self, targets, *_, **__):
            self.targets = targets

        def case(self, config):
            return Case(config)

        def means(self, wanted):
            configs.extend(wanted)
            return [tuple(Mean(self.value(config), None) for _ in self.targets) for config in wanted]

        def value(self, config):
            noise = np.random.default_rng(config.run.seed).normal(0.0, 0.05)
            speed = (config.rotation.rpm - 20.0) / 40.0
            friction = (config.contact.bundle.friction - 0.2) / 0.4
            return speed + 0.5 * friction * speed + noise

    monkeypatch.setattr(import_module("drumrs.decide.screen"), "Evaluator", Formula)
    return configs


def test_dead_keys_are_dropped_before_the_spread_is_shared_out(asked, tmp_path):
    (found,) = drumrs.screen(PLAN, out=tmp_path, progress=False)
    factors = {factor.key: factor for factor in found.factors}
    assert [factor.key for factor in found.factors][:2] == ["rotation.rpm", "contact.bundle.friction"]
    for key in ("contact.bundle.restitution", "drum.baffles.count"):
        assert factors[key].effect.is_dead
        assert factors[key].total is None
    # V = 0.1356: speed (1 + ¼)²/12 by itself, friction (¼)²/12, together ¼/144.
    assert factors["rotation.rpm"].first.mean == pytest.approx(0.949, abs=0.15)
    assert factors["contact.bundle.friction"].total.mean == pytest.approx(0.051, abs=0.05)
    assert found.noise == pytest.approx(0.05, rel=0.5)
    plan = ScreeningPlan.read(PLAN)
    assert len(asked) == plan.first_runs + 64 * 4 + 16 < plan.most_runs
    # What is dead stays at the base's value.
    assert {config.drum.baffles.count for config in asked[plan.first_runs :]} == {0}
    # Every run has a seed of its own.
    assert len({config.run.seed for config in asked}) == len(asked)


@pytest.mark.usefixtures("asked")
def test_there_is_a_sentence_for_each_key_and_one_on_chance(tmp_path):
    (found,) = drumrs.screen(PLAN, out=tmp_path, progress=False)
    assert len(found.sentences) == 5
    assert found.sentences[0].startswith("rotation.rpm explains 8")
    assert "% of the spread of drum power by itself" in found.sentences[0].replace(")", "")
    assert "contact.bundle.restitution makes no difference to drum power that can be told from noise." in (
        found.sentences
    )
    assert found.sentences[-1].endswith("of the spread of single runs is chance.")
    assert pl.read_parquet(tmp_path / "table.parquet").equals(found.table())
    assert (tmp_path / "screening.png").stat().st_size > 10_000


def test_without_points_it_stays_at_effects(asked, tmp_path):
    plan = {**PLAN, "screen": {"points": 0}}
    first, second = drumrs.screen(plan, ["drum_power", "arm"], out=tmp_path, progress=False)
    assert (first.target.text, second.target.text) == ("drum_power", "arm")
    assert first.chance is None
    assert len(asked) == 60
    assert first.sentences[0].startswith("rotation.rpm changes drum power by +")
    assert {path.name for path in tmp_path.glob("*.png")} == {"screening_1.png", "screening_2.png"}


def test_a_larger_design_begins_with_the_smaller_one(asked, tmp_path):
    small = {**PLAN, "screen": {"trajectories": 8, "points": 16}}
    drumrs.screen(small, out=tmp_path / "small", progress=False)
    before = {config.digest for config in asked}
    asked.clear()
    drumrs.screen(
        {**PLAN, "screen": {"trajectories": 16, "points": 32}}, out=tmp_path / "large", progress=False
    )
    after = {config.digest for config in asked}
    assert len(before - after) == 0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"seeds": 3}, "seeds is not a key of a screening; each run has a seed of its own"),
        (
            {"screen": {"target": "arm"}},
            "screen.target is not a key of a screening; the keys there are targets",
        ),
        ({"screen": {"points": 48}}, "screen.points is 48, but must be 0 or a power of 2"),
        ({"screen": {"trajectories": 2}}, "screen.trajectories is 2, but must be a whole number from 4"),
        ({"screen": {"targets": ["power"]}}, "the target power is not the name of a quantity"),
        ({"ranges": {"rotation.rmp": [1, 2]}}, "did you mean"),
    ],
)
def test_bad_plans_are_refused_in_a_sentence(change, told):
    with pytest.raises(ConfigError) as refused:
        ScreeningPlan.read({**PLAN, **change})
    assert told in str(refused.value)


@pytest.mark.usefixtures("asked")
def test_values_that_do_not_go_together_say_where(tmp_path):
    plan = {**PLAN, "ranges": {"load.diameter": [0.02, 0.6]}, "axes": {}}
    with pytest.raises(ConfigError, match=r"narrow the ranges: this is at load\.diameter = 0"):
        drumrs.screen(plan, out=tmp_path, progress=False)


def test_a_screening_is_a_command_that_says_beforehand_what_it_costs(tmp_path, capsys):
    path = tmp_path / "screen.toml"
    path.write_text(
        "[base]\nload.fill = 0.05\nrun.duration = 0.05\n[ranges]\nrotation.rpm = [20, 80]\n"
        "[screen]\ntrajectories = 4\npoints = 4\n"
    )
    with pytest.raises(SystemExit) as left:
        main(["screen", str(path), "--by", "drum_power", "--out", str(tmp_path / "out"), "--yes"])
    assert left.value.code == 0
    said = capsys.readouterr()
    assert "rotation.rpm: 12 runs for Morris's effects, then at most 16 for Sobol's indices" in said.err
    assert "rotation.rpm" in said.out
    assert (tmp_path / "out" / "table.parquet").exists()


def test_in_a_terminal_one_may_decline(tmp_path, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    path, out = tmp_path / "screen.toml", tmp_path / "out"
    path.write_text("[base]\nload.fill = 0.05\nrun.duration = 0.05\n[ranges]\nrotation.rpm = [20, 80]\n")
    monkeypatch.setattr("sys.stdin", Terminal("n\n"))
    with pytest.raises(SystemExit) as left:
        main(["screen", str(path), "--out", str(out)])
    assert left.value.code == 1
    assert not out.exists()


def test_whole_numbers_and_choices_come_equally_often():
    plan = ScreeningPlan.read({**PLAN, "ranges": {"load.count": [10, 13]}})
    even = plan.space.even(np.random.default_rng(1).random((3000, 2)))
    values = [plan.space.values(point) for point in even]
    for key, choices in (("load.count", (10, 11, 12, 13)), ("drum.baffles.count", (0, 3, 4))):
        shares = [sum(one[key] == choice for one in values) / 3000.0 for choice in choices]
        assert shares == pytest.approx([1.0 / len(choices)] * len(choices), abs=0.03)
