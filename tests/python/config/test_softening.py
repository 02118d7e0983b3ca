"""Softer springs: what changes, what does not, what is refused."""

import json
import math

import pytest

import drumrs

SHORT = ["--set", "run.duration=0.03", "--set", "load.count=20"]


def test_a_contact_takes_as_many_steps_and_loses_as_much():
    stiff = drumrs.Simulation(drumrs.baseline(fill=0.1))
    soft = drumrs.Simulation(drumrs.baseline(fill=0.1).softer(100.0))
    assert soft.time_step == pytest.approx(10.0 * stiff.time_step)
    for side, duration in stiff.collision_time.items():
        assert soft.collision_time[side] == pytest.approx(10.0 * duration)
    assert soft.config.contact.bundle.restitution == 0.1


def test_a_damping_that_is_given_keeps_its_restitution():
    config = drumrs.baseline().replace({"contact.drum.normal_damping": 7.74e3})
    soft = config.softer(4.0).contact.drum
    ratio = config.contact.drum.normal_damping / math.sqrt(config.contact.drum.normal_stiffness)
    assert soft.normal_damping / math.sqrt(soft.normal_stiffness) == pytest.approx(ratio)


def test_an_automatic_step_follows():
    config = drumrs.baseline(fill=0.1).replace({"run.time_step": "auto"})
    step = drumrs.Simulation(config).time_step
    assert config.softer(25.0).run.time_step == "auto"
    assert drumrs.Simulation(config.softer(25.0)).time_step == pytest.approx(5.0 * step)


def test_the_run_says_what_it_changes(drum):
    status, printed, told = drum("run", *SHORT, "--softer", "100", "--json")
    assert status == 0
    assert json.loads(printed)["time_step"] == pytest.approx(3.7e-5)
    assert "--softer 100 changes contact.bundle.normal_stiffness 9.25e+07 → 9.25e+05" in told
    assert "run.time_step 3.7e-06 → 3.7e-05" in told


def test_it_comes_after_all_layers(drum, tmp_path):
    words = ["--set", "contact.bundle.normal_stiffness=4e7", "--softer", "4", "--out", tmp_path / "out"]
    assert drum("run", *SHORT, *words)[0] == 0
    assert drumrs.Config.read(tmp_path / "out" / "config.toml").contact.bundle.normal_stiffness == 1e7


@pytest.mark.parametrize("factor", ["0.5", "0", "-4", "nan", "inf"])
def test_other_factors_are_refused(drum, tmp_path, factor):
    status, printed, told = drum("run", *SHORT, f"--softer={factor}", "--out", tmp_path / "out")
    assert (status, printed) == (2, "")
    assert told == f"drumrs: --softer is {float(factor)}, but must be a finite number of at least 1\n"
    assert not (tmp_path / "out").exists()


def test_a_case_that_goes_on_keeps_its_springs(drum, tmp_path):
    assert drum("run", *SHORT, "--out", tmp_path)[0] == 0
    status, _, told = drum("run", "--resume", tmp_path, "--softer", "2")
    assert status == 2
    assert "--softer" in told
