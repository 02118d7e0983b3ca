"""`drumrs init`: every template is a folder that a stranger can go on with, and simulates what it says."""

import json
import math
import re
import shlex
import tomllib
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

import drumrs
from drumrs.cli.init import _TEMPLATES
from drumrs.sweep import read_sweep

NAMES = sorted(each.name for each in _TEMPLATES.iterdir())
FILES = {"case.toml", "sweep.toml", "README.md", "drumrs.schema.json"}
_SHORT = ["--set", "run.duration=0.05", "--set", "run.window=[0.0, 0.05]"]


@pytest.fixture
def made(drum, tmp_path):
    """Write a template's folder."""

    def make(name: str) -> Path:
        folder = tmp_path / "machine"
        status, _, said = drum("init", folder, "--template", name)
        assert status == 0, said
        return folder

    return make


def commands(folder):
    block = re.search(r"```sh\n(.*?)```", (folder / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    return [shlex.split(line, comments=True)[1:] for line in block[1].splitlines()]


@pytest.mark.parametrize("words", [["init"], ["init", "new"]])
def test_without_a_template_they_are_listed(drum, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    status, printed, said = drum(*words)
    assert [line.split()[0] for line in printed.splitlines()] == NAMES
    assert all(len(line) > 30 for line in printed.splitlines())
    assert f"drumrs init {'new' if len(words) > 1 else 'NAME'} --template ball-mill" in said
    assert status == (2 if len(words) > 1 else 0)
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["new", "--template", "ballmill"], "did you mean ball-mill?"),
        (["new", "--template", "toaster"], "must be one of ball-mill, coater, dryer"),
        (
            ["--template", "washer"],
            "NAME is missing, but must be the folder to write; such as drumrs init my-washer",
        ),
        (["taken", "--template", "washer"], "must be a new folder, or an empty one: nothing is overwritten"),
        (["taken/file", "--template", "washer"], "is a file"),
    ],
)
def test_what_cannot_be_written_is_refused(drum, tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    taken = tmp_path / "taken" / "file"
    taken.parent.mkdir()
    taken.write_text("mine")
    status, _, message = drum("init", *words)
    assert (status, said in message) == (2, True), message
    assert [path.name for path in tmp_path.rglob("*")] == ["taken", "file"]
    assert taken.read_text() == "mine"


@pytest.mark.parametrize("name", NAMES)
def test_a_template_is_a_folder_to_go_on_with(made, name):
    folder = made(name)
    assert {path.name for path in folder.iterdir()} == FILES
    case = (folder / "case.toml").read_text(encoding="utf-8")
    assert case.startswith("#:schema drumrs.schema.json\n# ")
    schema = json.loads((folder / "drumrs.schema.json").read_text(encoding="utf-8"))
    Draft202012Validator(schema).validate(tomllib.loads(case))
    config = drumrs.Config.read(folder / "case.toml")
    assert not config.hints
    assert 150 <= config.bundle_count <= 800
    assert config.run.window != drumrs.baseline().run.window
    assert 3 <= len(read_sweep(folder / "sweep.toml").cases) <= 20
    assert [words[0] for words in commands(folder)] == ["run", "view", "sweep"]


@pytest.mark.parametrize("name", NAMES)
def test_every_number_of_a_template_has_its_source(made, name):
    before = ""
    for line in (made(name) / "case.toml").read_text(encoding="utf-8").splitlines():
        if re.match(r"\w+ = [-\d\[{]", line):
            assert "#" in line or before.startswith("#"), f"no source: {line}"
        before = line


@pytest.mark.parametrize("name", NAMES)
def test_a_template_runs(made, drum, monkeypatch, name):
    monkeypatch.chdir(made(name))
    run, view, _ = commands(Path())
    status, _, said = drum(*run, *_SHORT)
    assert status == 0, said
    assert view[1] == run[run.index("--out") + 1]
    assert (Path(view[1]) / "player.html").exists()
    assert abs(drumrs.load(view[1]).summary.energy_residual) < 1e-9


def is_a_washer(run):
    power = dict(drumrs.phases(run).select("phase", "drum_specific_power").iter_rows())
    assert 2.0 < power["tumble"] < 3.5
    assert abs(power["rest"]) < 0.01


def is_a_front_loader(run):
    # The load ends as a ring on the rim.
    assert np.hypot(*run.frames.positions[-1].T).min() > 0.6 * run.config.drum.diameter / 2.0


def is_a_dryer(run):
    # The load is thrown across the drum: half of it is in the air, or on its way up.
    assert run.summary.coordination < 2.0
    assert 2.0 < run.summary.drum_specific_power < 3.5


def is_a_ball_mill(run):
    # A kidney on the rising side; mills take some 10 kW a ton.
    assert 0.25 < run.summary.center_of_mass_x / (run.config.drum.diameter / 2.0) < 0.5
    assert 9.0 < run.summary.drum_specific_power < 14.0


def is_a_sag_mill(run):
    # 4.4 MW by the browser simulator, 4.5 MW by Morrell's C-model, both of a mill 4 m long.
    assert 4.0 * run.summary.drum_power == pytest.approx(4.45e6, rel=0.15)


def is_a_coater(run):
    slope = math.degrees(math.atan2(run.summary.center_of_mass_x, -run.summary.center_of_mass_y))
    assert 20.0 < slope < 40.0


def is_a_mixer(run):
    last = run.frames.positions[-1]
    away = np.hypot(*(last - last.mean(axis=0)).T)
    small = np.array(run.frames.species) == "small"
    assert away[small].mean() < 0.8 * away[~small].mean()


MACHINES = {
    "ball-mill": is_a_ball_mill,
    "coater": is_a_coater,
    "dryer": is_a_dryer,
    "front-loader": is_a_front_loader,
    "mixer": is_a_mixer,
    "sag-mill": is_a_sag_mill,
    "washer": is_a_washer,
}


def test_every_template_is_known():
    assert list(MACHINES) == NAMES


@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_a_template_shows_its_machine(made, drum, monkeypatch, name):
    monkeypatch.chdir(made(name))
    run, *_ = commands(Path())
    status, _, said = drum(*run)
    assert status == 0, said
    found = drumrs.load(run[run.index("--out") + 1])
    assert found.summary.max_overlap_ratio < 0.2
    MACHINES[name](found)
