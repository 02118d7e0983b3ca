"""`drumrs optimize`: files, sentences, what is confirmed, what is refused; runs are made up, but for one search."""

import json
import re
import tomllib
from importlib import import_module
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.analysis import Mean, estimate
from drumrs.cli import main
from drumrs.decide import Problem
from drumrs.errors import ConfigError

OPTIMIZE = import_module("drumrs.decide.optimize")

SPEED = {"rotation.rpm": [30, 60]}
LEAST = {"minimize": "drum_specific_power", "tolerance": "0.05", "runs": 12, "batch": 2}
FILE = """
[base]
load.fill = 0.05
run.duration = 0.1
[ranges]
rotation.rpm = [30, 60]
[axes]
drum.baffles.count = [3, 4]
[optimize]
minimize = "drum_specific_power"
subject_to = ["dissipation_ratio >= 0.1"]
runs = 8
batch = 2
confirm = 2
"""


def power(rpm):
    return 3.0 + ((rpm - 41.0) / 10.0) ** 2


class MadeUp:
    """Stands in for the evaluator: power is least at 41 rpm, the ratio grows with the speed, errors are known."""

    asked = 0
    stop_after = None
    failing = staticmethod(lambda _: False)

    def __init__(self, targets, *_, **__):
        self.targets = [target.text for target in targets]

    def case(self, config):
        pass

    def means(self, configs):
        if MadeUp.stop_after is not None and MadeUp.asked >= MadeUp.stop_after:
            raise KeyboardInterrupt("interrupted")
        MadeUp.asked += len(configs)
        return [self._of(config) for config in configs]

    def estimates(self, configs, seeds):
        rows = [[self._of(config.replace({"run.seed": seed})) for seed in seeds] for config in configs]
        return [
            tuple(
                estimate([mean.value for mean in column], [mean.error for mean in column])
                for column in zip(*row, strict=True)
            )
            for row in rows
        ]

    def _of(self, config):
        rpm, noise = config.rotation.rpm, np.random.default_rng(config.run.seed).normal(0.0, 0.05)
        if MadeUp.failing(rpm):
            return tuple(Mean(float("nan"), None) for _ in self.targets)
        known = {"drum_specific_power": power(rpm) + noise, "dissipation_ratio": rpm / 30.0}
        return tuple(Mean(known[text], 0.05) for text in self.targets)


@pytest.fixture(autouse=True)
def made_up(monkeypatch, request):
    if "real" not in request.node.name:
        monkeypatch.setattr(OPTIMIZE, "Evaluator", MadeUp)
        monkeypatch.setattr(MadeUp, "asked", 0)


def optimize(folder, ranges=SPEED, **wanted):
    problem = {"ranges": ranges, "optimize": {**LEAST, **wanted}}
    return drumrs.optimize(problem, folder, progress=False)


def test_the_best_is_found_confirmed_and_kept(tmp_path):
    found = optimize(tmp_path, tolerance="1 %")
    assert found.best["rotation.rpm"] == pytest.approx(41.0, abs=4.0)
    assert found.sentence.startswith("The least drum specific power is ")
    assert "on 4 fresh seeds; the search, which picks the luckiest of" in found.sentence
    assert "Second is rotation.rpm = " in found.sentence
    assert (
        tomllib.loads((tmp_path / "best.toml").read_text())["rotation"]["rpm"] == found.best["rotation.rpm"]
    )
    assert (tmp_path / "optimization.png").stat().st_size > 10_000
    table = pl.read_parquet(tmp_path / "history.parquet")
    assert table.height == len(found.search.points)
    assert table["seed"].n_unique() == table.height
    assert table.filter("front")["drum_specific_power_expected"].item() == pytest.approx(
        table["drum_specific_power_expected"].min()
    )


def test_fresh_seeds_are_none_of_the_search(tmp_path):
    seen = []

    class Watched(MadeUp):
        def _of(self, config):
            seen.append(config.run.seed)
            return super()._of(config)

    OPTIMIZE.Evaluator = Watched
    found = optimize(tmp_path)
    runs = len(found.search.points)
    assert not set(seen[:runs]) & set(seen[runs:])


def test_a_killed_search_goes_on_with_the_same_points(tmp_path, monkeypatch):
    whole = optimize(tmp_path / "whole", tolerance="0.0001").table
    monkeypatch.setattr(MadeUp, "asked", 0)
    monkeypatch.setattr(MadeUp, "stop_after", 8)
    with pytest.raises(KeyboardInterrupt):
        optimize(tmp_path / "broken", tolerance="0.0001")
    assert not (tmp_path / "broken" / "history.parquet").exists()
    assert len(json.loads((tmp_path / "broken" / "points.json").read_text())["batches"]) == 4
    monkeypatch.setattr(MadeUp, "stop_after", None)
    assert optimize(tmp_path / "broken", tolerance="0.0001").table.equals(whole)


def test_a_constraint_moves_the_best_and_is_said_where_it_is_missed(tmp_path):
    found = optimize(tmp_path, subject_to="dissipation_ratio >= 1.7")
    assert found.best["rotation.rpm"] == pytest.approx(51.0, abs=1.5)
    assert "misses" not in found.sentence


def test_two_objectives_have_a_front(tmp_path):
    found = optimize(tmp_path, maximize="dissipation_ratio", tolerance="0.1 %")
    front = found.front
    # Below the speed of the least power, 41 rpm, both get worse.
    assert front["rotation.rpm"].min() > 38.0
    assert front["rotation.rpm"].max() > 59.0
    assert found.sentence.startswith(f"No point is better in both among the {front.height} of the front")
    assert front["drum_specific_power_expected_error"].max() < 0.1


def test_runs_that_fail_are_left_aside(tmp_path, monkeypatch):
    monkeypatch.setattr(MadeUp, "failing", staticmethod(lambda rpm: rpm < 45.0))
    found = optimize(tmp_path)
    assert found.best["rotation.rpm"] >= 45.0
    assert found.table["drum_specific_power"].null_count() > 0


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"subject_to": "dissipation_ratio >= 9"},
            r"subject_to is met by none of 12 runs: the nearest, rotation.rpm = ",
        ),
        ({"minimize": "drum_powr"}, "did you mean"),
        ({"minimize": []}, "one or two targets"),
        ({"subject_to": "dissipation_ratio"}, "a target, <= or >=, and a number"),
        ({"subject_to": "drum_specific_power <= 3 kW"}, "in the unit of drum_specific_power, W/kg"),
        ({"runs": 3}, "optimize.runs is 3, but must be a whole number from 4"),
        ({"tolerance": "-1 %"}, "optimize.tolerance is '-1 %', but must be a positive number"),
        ({"maximize": "dissipation_ratio"}, "a share such as '1 %' where there are two objectives"),
        ({"maximize": "drum_specific_power"}, "optimize has drum_specific_power as both of its targets"),
        ({"maximise": "dissipation_ratio"}, "optimize.maximise is not a key of an optimization"),
    ],
)
def test_what_cannot_be_optimized_is_one_sentence(tmp_path, change, sentence):
    with pytest.raises(ConfigError, match=sentence) as told:
        optimize(tmp_path, **change)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("ranges", "sentence"),
    [
        ({"rotation.rpm": [60, 30]}, r"ranges.rotation.rpm is \[60, 30\], but must be \[low, high\]"),
        ({"rotation.rmp": [30, 60]}, "did you mean rotation.rpm"),
        ({}, "1 to 6 keys"),
        ({"load.fill": [-2, -1]}, "load.fill is "),
    ],
)
def test_ranges_that_are_none_are_one_sentence(tmp_path, ranges, sentence):
    with pytest.raises(ConfigError, match=sentence):
        optimize(tmp_path, ranges)


def test_where_every_run_has_no_number_it_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(MadeUp, "failing", staticmethod(lambda _: True))
    with pytest.raises(ConfigError, match="asks for drum_specific_power, which none of the first 4 runs has"):
        optimize(tmp_path)


def test_a_search_that_cannot_begin_leaves_no_folder_real(tmp_path):
    out = tmp_path / "out"
    with pytest.raises(ConfigError, match="is of a part that the drum of this run does not have"):
        optimize(out, minimize="baffle_1_work")
    assert not out.exists()


def test_a_folder_of_another_search_is_refused(tmp_path):
    optimize(tmp_path)
    with pytest.raises(ConfigError, match="this one is of other keys, ranges, goals"):
        optimize(tmp_path, {"rotation.rpm": [30, 50]})
    # More runs are the same search.
    assert len(optimize(tmp_path, runs=14, tolerance="0.0001").search.points) == 14


def test_without_the_library_the_way_out_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr("drumrs.decide.emulator.find_spec", lambda _: None)
    with pytest.raises(ConfigError, match=r"needs the package sklearn.*drumrs\[decide\]"):
        optimize(tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_real_search_on_the_command_line(tmp_path, capsys):
    (tmp_path / "search.toml").write_text(FILE, encoding="utf-8")
    words = ["--quiet", "optimize", str(tmp_path / "search.toml"), "--out", str(tmp_path / "out")]
    for _ in range(2):
        with pytest.raises(SystemExit) as left:
            main(words)
        assert left.value.code == 0
    told = capsys.readouterr().out
    assert "on 2 fresh seeds" in told
    once = len(told) // 2
    assert told[:once] == told[once:]
    assert len(list((tmp_path / "out" / "runs").glob("*.facts.json"))) <= 8 + 4


def problem_of_page(name):
    page = (Path(__file__).parents[3] / "docs" / "decisions" / name).read_text(encoding="utf-8")
    return Problem.read(tomllib.loads(re.search(r"```toml\n(.*?)```", page, re.DOTALL)[1]))


def test_the_example_of_the_page_is_a_problem():
    problem = problem_of_page("optimize.md")
    assert [str(goal) for goal in problem.goals] == [
        "least drum specific power",
        "greatest falls per turn",
        "share_in_flight >= 0.05",
    ]
    assert problem.space.keys == ["rotation.rpm", "drum.baffles.height", "drum.baffles.count"]


def test_large_numbers_have_ranges_too(tmp_path):
    found = optimize(tmp_path, {**SPEED, "contact.bundle.normal_stiffness": [1e6, 1e9]}, runs=8)
    assert 1e6 <= found.best["contact.bundle.normal_stiffness"] <= 1e9
    assert (tmp_path / "optimization.png").exists()
