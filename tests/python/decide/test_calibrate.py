"""`drumrs calibrate`: files, sentences, what is refused; runs are made up, but for one small calibration."""

import re
import tomllib
from importlib import import_module
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.analysis import Mean
from drumrs.cli import main
from drumrs.decide import Experiment
from drumrs.errors import ConfigError

CALIBRATE = import_module("drumrs.decide.calibrate")

RANGES = {"contact.bundle.friction": [0.1, 0.9], "contact.bundle.rolling_friction": [0.0, 0.4]}
TRUTH = (0.5, 0.15)
SLOPE, POWER = "center_slope", "drum_specific_power"


def slope(friction, rolling, rpm):
    # Both raise the slope; at high speed the second one counts less.
    return 0.4 + 0.4 * friction + 0.6 * rolling * (60.0 - rpm) / 30.0


def power(friction, rolling, rpm):
    return rpm / 10.0 * (0.5 + friction) - rolling


class MadeUp:
    """Stands in for the evaluator: slope and power as above, errors of runs known."""

    def __init__(self, targets, *_, **__):
        self.targets = list(map(str, targets))

    def means(self, configs):
        return [tuple(self._of(config, text) for text in self.targets) for config in configs]

    def _of(self, config, text):
        contact, noise = config.contact.bundle, np.random.default_rng(config.run.seed).normal(0.0, 0.005)
        known = {SLOPE: slope, POWER: power}[text](
            contact.friction, contact.rolling_friction, config.rotation.rpm
        )
        return Mean(known + noise, 0.005)


@pytest.fixture(autouse=True)
def made_up(monkeypatch, request):
    if "real" not in request.node.name:
        monkeypatch.setattr(CALIBRATE, "Evaluator", MadeUp)


def measured(target, function, rpm, error=0.01):
    return {"target": target, "value": function(*TRUTH, rpm), "error": error, "set": {"rotation.rpm": rpm}}


ONE_ANGLE = [measured(SLOPE, slope, 30)]
BOTH = [*ONE_ANGLE, measured(POWER, power, 30, 0.05), measured(POWER, power, 50, 0.05)]


def calibrate(folder, numbers=BOTH, **tables):
    experiment = {"ranges": RANGES, "measured": numbers, "calibrate": {"runs": 20}, **tables}
    return drumrs.calibrate(experiment, folder, progress=False)


def test_the_truth_is_found_and_kept(tmp_path):
    found = calibrate(tmp_path)
    for (_, median, low, high, _), truth in zip(found.table.iter_rows(), TRUTH, strict=True):
        assert low < truth < high
        assert low < median < high
    assert found.fits["off"].abs().max() < 2.0
    assert pl.read_parquet(tmp_path / "posterior.parquet").columns == list(RANGES)
    assert (tmp_path / "calibration.png").stat().st_size > 10_000


def test_one_angle_alone_leaves_a_ridge_and_the_text_says_so(tmp_path):
    found = calibrate(tmp_path, ONE_ANGLE)
    assert found.ridges == [tuple(RANGES)]
    assert (
        "are not told apart, a ridge and not a point: more of one goes with less of the other"
        in found.sentence
    )


def test_the_next_measurement_is_the_one_that_tells_most(tmp_path):
    candidates = [
        {"target": SLOPE, "error": 0.01, "set": {"rotation.rpm": 30}},
        {"target": POWER, "error": 0.05, "set": {"rotation.rpm": 50}},
        {"target": POWER, "error": 50.0, "set": {"rotation.rpm": 40}},
    ]
    found = calibrate(tmp_path, ONE_ANGLE, candidate=candidates)
    ranked = [str(one) for one, _ in found.next]
    # What crosses the ridge, not what runs along it; a measurement with a huge error tells nothing.
    assert ranked[0] == "drum specific power at rotation.rpm = 50"
    assert ranked[-1] == "drum specific power at rotation.rpm = 40"
    assert f"Of further measurements {ranked[0]} would tell most" in found.sentence


def test_what_the_model_cannot_give_is_said(tmp_path):
    found = calibrate(tmp_path, [{**ONE_ANGLE[0], "value": 90.0}])
    assert "No parameters in the ranges give center slope at rotation.rpm = 30 as measured" in found.sentence


def test_what_does_not_matter_is_said(tmp_path, monkeypatch):
    monkeypatch.setitem(globals(), "slope", lambda friction, _, __: 0.4 + 0.4 * friction)
    found = calibrate(tmp_path, ONE_ANGLE)
    assert "The measurements say nothing of contact.bundle.rolling_friction." in found.sentence
    assert found.ridges == []


@pytest.mark.parametrize(
    ("tables", "sentence"),
    [
        ({"measured": []}, r"measured is \[\], but must be one table"),
        (
            {"measured": [{"target": SLOPE, "value": 30.0}]},
            r"measured\[0\].error is missing, but must be a number in",
        ),
        (
            {"measured": [{"target": SLOPE, "value": 30.0, "error": 0.0}]},
            r"error is 0.0, but must be positive",
        ),
        ({"measured": [{"target": "center_slop", "value": 1.0, "error": 1.0}]}, "did you mean center_slope"),
        ({"measured": [{**ONE_ANGLE[0], "set": {"rotation.rmp": 3}}]}, "did you mean rotation.rpm"),
        (
            {"measured": [{**ONE_ANGLE[0], "sigma": 1.0}]},
            r"measured\[0\].sigma is not a key of a calibration",
        ),
        ({"ranges": {}}, "1 to 5 keys with"),
        ({"calibrate": {"runs": 3}}, "calibrate.runs is 3, but must be a whole number from 9"),
        ({"calibrate": {"discrepancy": 0.1}}, "a share such as '3 %'"),
    ],
)
def test_what_cannot_be_calibrated_is_one_sentence(tmp_path, tables, sentence):
    with pytest.raises(ConfigError, match=sentence) as told:
        calibrate(tmp_path, **({"numbers": tables.pop("measured")} if "measured" in tables else {}), **tables)
    assert "\n" not in str(told.value)


def test_without_the_libraries_the_way_out_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr("drumrs.decide.emulator.find_spec", lambda name: None if name == "emcee" else name)
    with pytest.raises(ConfigError, match=r"a calibration needs the package emcee.*drumrs\[decide\]"):
        calibrate(tmp_path / "new")
    assert not (tmp_path / "new").exists()


@pytest.mark.slow
def test_a_real_drum_gives_its_friction_back_on_the_command_line(tmp_path, capsys):
    """A small drum is run with a known friction; the powers that it takes at two speeds are the data."""
    base = drumrs.baseline(fill=0.1).replace({"run.duration": 3.0, "run.window": [1.0, 3.0]})
    friction, tables = 0.25, []
    for seed, rpm in ((7001, 20.0), (7002, 35.0)):
        changes = {"rotation.rpm": rpm, "contact.drum.friction": friction, "run.seed": seed}
        told = drumrs.run(base.replace(changes), progress=False).summary
        tables.append(
            f'[[measured]]\ntarget = "drum_specific_power"\nvalue = {told.drum_specific_power}\nerror = 0.1\n'
            f"set = {{ rotation.rpm = {rpm} }}\n"
        )
    text = (
        "[base]\nload.fill = 0.1\nrun.duration = 3.0\nrun.window = [1.0, 3.0]\n"
        "[ranges]\ncontact.drum.friction = [0.05, 0.6]\n[calibrate]\nruns = 12\n"
    )
    (tmp_path / "data.toml").write_text(text + "".join(tables), encoding="utf-8")
    with pytest.raises(SystemExit) as left:
        main(["--quiet", "calibrate", str(tmp_path / "data.toml"), "--out", str(tmp_path / "out")])
    assert left.value.code == 0
    told = capsys.readouterr().out
    samples = pl.read_parquet(tmp_path / "out" / "posterior.parquet")["contact.drum.friction"]
    assert samples.quantile(0.02) < friction < samples.quantile(0.98)
    assert samples.quantile(0.98) - samples.quantile(0.02) < 0.45
    assert "contact.drum.friction is " in told


def test_the_example_of_the_page_is_an_experiment():
    text = (Path(__file__).parents[3] / "docs/decisions/calibrate.md").read_text(encoding="utf-8")
    experiment = Experiment.read(tomllib.loads(re.search(r"```toml\n(.*?)```", text, re.DOTALL)[1]))
    assert [len(part) for part in (experiment.measured, experiment.candidates, experiment.drums)] == [3, 1, 3]
    assert experiment.discrepancy == pytest.approx(0.03)
