"""Which cases a sweep has, what they are called, and what is refused before anything is simulated."""

import re
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.sweep import Case, read_sweep
from drumrs.sweep.scheduler import shard_of

BASE = drumrs.baseline()


def values(sweep: drumrs.Sweep, *keys: str) -> list[tuple]:
    flat = [(case.config.load.fill, case.config.drum.baffles.count, case.seed) for case in sweep.cases]
    return [tuple(row[("fill", "baffles", "seed").index(key)] for key in keys) for row in flat]


def test_axes_are_crossed_with_seeds():
    sweep = drumrs.Sweep(BASE, {"load.fill": [0.1, 0.2], "drum.baffles.count": [0, 3]}, seeds=range(2))
    assert values(sweep, "fill", "baffles", "seed") == [
        (fill, count, seed) for fill in (0.1, 0.2) for count in (0, 3) for seed in (0, 1)
    ]
    assert len(sweep) == len({case.id for case in sweep.cases}) == 8
    assert sweep.varied() == ["drum.baffles.count", "load.fill", "seed"]


@pytest.mark.parametrize(
    "axis", [[0.1, 0.2], (0.1, 0.2), np.array([0.1, 0.2]), pl.Series([0.1, 0.2]), iter([0.1, 0.2])]
)
def test_an_axis_is_any_list(axis):
    assert values(drumrs.Sweep(BASE, {"load.fill": axis}), "fill", "seed") == [(0.1, 1), (0.2, 1)]


def test_seeds_are_a_list_or_their_number():
    assert values(drumrs.Sweep(BASE, seeds=3), "seed") == [(0,), (1,), (2,)]
    assert values(drumrs.Sweep(BASE, seeds=[5, 7]), "seed") == [(5,), (7,)]
    assert values(drumrs.Sweep(BASE.replace({"run.seed": 9})), "seed") == [(9,)]
    assert values(drumrs.Sweep(BASE, {"run.seed": [4, 5]}), "seed") == [(4,), (5,)]


def test_rows_are_cases_and_null_keeps_the_base():
    rows = pl.DataFrame(
        {"load.fill": [0.1, 0.3], "drum.baffles.count": [3, None], "rotation.rpm": [None, None]}
    )
    sweep = drumrs.Sweep.from_rows(BASE, rows, seeds=[2])
    assert values(sweep, "fill", "baffles", "seed") == [(0.1, 3, 2), (0.3, 0, 2)]
    assert [case.config.rotation.rpm for case in sweep.cases] == [54.0, 54.0]


def test_equal_configurations_are_one_case():
    sweep = drumrs.Sweep.from_configs([drumrs.baseline(0.1), drumrs.baseline(0.2), drumrs.baseline(0.1)])
    assert values(sweep, "fill") == [(0.1,), (0.2,)]


def test_the_name_follows_configuration_seed_and_physics(monkeypatch):
    name = Case(BASE).id
    assert Case(drumrs.Config.from_toml(BASE.to_toml())).id == name
    assert Case(BASE.replace({"run.seed": 2})).id != name
    assert Case(BASE.replace({"load.density": 999.0})).id != name
    monkeypatch.setattr("drumrs.sweep.case.physics_version", lambda: 10**9)
    assert Case(BASE).id != name


@pytest.mark.parametrize(
    "changes",
    [{}, {"load.diameter": 0.012}, {"contact.drum.restitution": 0.9}, {"contact.bundle.normal_damping": 4e3}],
)
def test_cost_counts_particle_steps_for_an_automatic_step_too(changes):
    config = BASE.replace(
        {"run.time_step": "auto", "run.duration": 0.01, "run.sample_every": 0.001, **changes}
    )
    simulation = drumrs.Simulation(config)
    assert Case(config).cost == pytest.approx(simulation.count * simulation.last_step, rel=1e-2)


AXIS = {"load.fill": [0.1]}


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: drumrs.Sweep(BASE, {"load.fil": [0.1]}), "load.fil is not a key; did you mean load.fill?"),
        (lambda: drumrs.Sweep(BASE, {"fill": [0.1]}), "fill is not a key; did you mean load.fill?"),
        (lambda: drumrs.Sweep(BASE, {}), "axes is {}, but must be a table of at least one key"),
        (lambda: drumrs.Sweep(BASE, "load.fill"), "axes is 'load.fill', but must be a table of keys"),
        (lambda: drumrs.Sweep(BASE, {"load.fill": []}), r"the axis load.fill is \[\], but must be a list"),
        (lambda: drumrs.Sweep(BASE, {"load.fill": 0.1}), "the axis load.fill is 0.1, but must be a list"),
        (
            lambda: drumrs.Sweep(BASE, {"contact.drum.tension": "allowed"}),
            "the axis contact.drum.tension is 'allowed'",
        ),
        (lambda: drumrs.Sweep(BASE, {"load.fill": [0.1, -1]}), "load.fill is -1, but must be a positive"),
        (
            lambda: drumrs.Sweep(BASE, {"load.fill": [0.1], "load.count": [9]}),
            "load.fill and load.count are both given",
        ),
        (
            lambda: drumrs.Sweep(BASE, {"load.fill": [0.1, 0.2, 0.1]}),
            "the case load.fill = 0.1 is there twice",
        ),
        (lambda: drumrs.Sweep(BASE, AXIS, seeds=[1, 1]), "load.fill = 0.1, run.seed = 1 is there twice"),
        (lambda: drumrs.Sweep(BASE, AXIS, seeds=[]), r"seeds is \[\]"),
        (lambda: drumrs.Sweep(BASE, AXIS, seeds=0), "seeds is 0, but must be"),
        (lambda: drumrs.Sweep(BASE, AXIS, seeds=True), "seeds is True"),
        (lambda: drumrs.Sweep(BASE, AXIS, seeds=[-1]), "run.seed is -1"),
        (lambda: drumrs.Sweep(BASE, {"run.seed": [1]}, seeds=2), "run.seed is varied and seeds are given"),
        (lambda: drumrs.Sweep.from_configs([]), "at least one"),
        (lambda: drumrs.Sweep.from_rows(BASE, pl.DataFrame()), "0 rows and 0 columns"),
        (lambda: drumrs.Sweep.from_rows(BASE, pl.DataFrame({"load.fill": []})), "0 rows and 1 columns"),
        (lambda: drumrs.Sweep.from_rows(BASE, pl.DataFrame({"load.fil": [None]})), "did you mean load.fill?"),
        (
            lambda: drumrs.Sweep.from_rows(BASE, pl.DataFrame({"load.fill": [0.2, 0.2]})),
            "load.fill = 0.2 is there twice",
        ),
        (lambda: drumrs.Sweep.from_rows(BASE, pl.DataFrame({"load.fill": ["much"]})), "load.fill is 'much'"),
    ],
)
def test_bad_designs_are_refused_in_a_sentence(make, sentence):
    with pytest.raises(ConfigError, match=sentence):
        make()


def test_shards_share_out_the_long_cases():
    cases = drumrs.Sweep(BASE, {"load.fill": [0.1, 0.2, 0.3, 0.4, 0.5]}).cases
    ordered = sorted(cases, key=lambda case: -case.cost)
    parts = [shard_of(ordered, (part, 2)) for part in (1, 2)]
    assert [[case.config.load.fill for case in part] for part in parts] == [[0.5, 0.3, 0.1], [0.4, 0.2]]


SWEEP = """
seeds = 2
[base]
run.duration = 2.0
load = {diameter = 0.02}
[axes]
load.fill = [0.1, 0.2]
"contact.drum.friction" = [0.3]
"""


def test_sweep_file(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(SWEEP)
    sweep = read_sweep(path)
    assert values(sweep, "fill", "seed") == [(0.1, 0), (0.1, 1), (0.2, 0), (0.2, 1)]
    assert {case.config.load.diameter for case in sweep.cases} == {0.02}
    assert {case.config.contact.drum.friction for case in sweep.cases} == {0.3}
    assert len(read_sweep(path, seeds=3)) == 6


@pytest.mark.parametrize("base", ['base = "../drums/machine.toml"', '[base]\nfile = "../drums/machine.toml"'])
def test_a_sweep_file_may_name_its_base_relative_to_itself(tmp_path, monkeypatch, base):
    for folder in ("drums", "sweeps"):
        (tmp_path / folder).mkdir()
    (tmp_path / "drums" / "machine.toml").write_text("drum.diameter = 0.52\nrun.duration = 2.0\n")
    path = tmp_path / "sweeps" / "sweep.toml"
    path.write_text(f"{base}\n[axes]\nload.fill = [0.1, 0.2]\n")
    monkeypatch.chdir(tmp_path)
    configs = [case.config for case in read_sweep("sweeps/sweep.toml").cases]
    assert [(c.drum.diameter, c.run.duration, c.load.fill) for c in configs] == [
        (0.52, 2.0, 0.1),
        (0.52, 2.0, 0.2),
    ]


def test_keys_of_a_sweep_file_win_over_its_base(tmp_path):
    (tmp_path / "machine.toml").write_text("drum.diameter = 0.52\nload.fill = 0.3\nrun.duration = 2.0\n")
    path = tmp_path / "study.toml"
    path.write_text('[base]\nfile = "machine.toml"\nrun.duration = 3.0\n[axes]\nload.count = [50]\n')
    (case,) = read_sweep(path).cases
    assert (case.config.drum.diameter, case.config.run.duration, case.config.load.count) == (0.52, 3.0, 50)
    assert case.config.load.fill is None


def test_the_study_of_the_readme_is_one(tmp_path):
    readme = (Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8")
    (study,) = re.findall(r"```toml\n(.*?)```", readme, re.DOTALL)
    path = tmp_path / "sweep.toml"
    path.write_text(study)
    assert len(read_sweep(path)) == 18


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("axis = 1", "axis is not a key of a sweep file; did you mean axes?"),
        ("[load]\nfill = [0.1]", "load is not a key of a sweep file; did you mean base.load or axes.load?"),
        ("zzz = 1", "zzz is not a key of a sweep file; the keys there are base, axes, seeds"),
        ("base = 3", "base is 3, but must be a table or the path of a case file"),
        ("base.file = 3", "base.file is 3, but must be the path of a case file"),
        ("base = 'none.toml'", "none.toml' cannot be read as a file of configuration keys"),
        ("[axes]", "axes is {}, but must be a table of at least one key"),
        ("[axes.load]\nfil = [1]", "load.fil is not a key; did you mean load.fill?"),
        ("[axes]\nload.fill = 0.1", "the axis load.fill is 0.1, but must be a list"),
        ("[base]\nload.fil = 0.1", "load.fil is not a key; did you mean load.fill?"),
        ("seeds = 'x'", "seeds is 'x', but must be"),
        ("seeds = [", "not valid TOML"),
    ],
)
def test_bad_sweep_file(drum, tmp_path, text, sentence):
    path, out = tmp_path / "sweep.toml", tmp_path / "out"
    path.write_text(text)
    status, printed, complaint = drum("sweep", path, "--out", out)
    assert (status, printed) == (2, "")
    assert sentence in complaint
    assert complaint.count("\n") == 1
    assert not out.exists()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--jobs", "0"], "jobs is 0, but must be a whole number from 1"),
        (["--shard", "5/4"], "shard is '5/4', but must be k/n with 1 <= k <= n"),
        (["--shard", "0/4"], "shard is '0/4', but must be k/n"),
        (["--shard", "half"], "--shard is 'half', but must be K/N"),
        (["--seeds", "0"], "seeds is 0, but must be"),
        (["--jobs", "many"], "--jobs"),
    ],
)
def test_bad_words(drum, tmp_path, words, sentence):
    path, out = tmp_path / "sweep.toml", tmp_path / "out"
    path.write_text(SWEEP)
    status, printed, complaint = drum("sweep", path, "--out", out, *words)
    assert (status, printed) == (2, "")
    assert sentence in complaint
    assert complaint.count("\n") == 1
    assert not out.exists()
