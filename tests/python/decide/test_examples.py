"""The examples of decisions ask what the pages say that they ask; in small they come to a sentence and a picture."""

import importlib.util
import sys
from pathlib import Path

import pytest

import drumrs
from drumrs.decide import Experiment, Problem, Target

FOLDER = Path(__file__).parents[3] / "examples"
NAMES = ("14_washer_paddle", "15_mill_lifter", "16_dryer_speed", "17_friction_from_a_drum")


def example(name):
    spec = importlib.util.spec_from_file_location(f"example_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_questions_are_those_of_the_pages():
    paddle, lifter, dryer, friction = map(example, NAMES)
    assert [Target.parse(by).unit for by, _ in paddle.QUESTIONS] == ["m", "W/kg", "m kg/W"]
    problem = Problem.read({"base": lifter.MILL, "ranges": lifter.RANGES, "optimize": lifter.WANTED})
    assert [goal.target.records for goal in problem.objectives] == [("contacts",), ()]
    assert [Target.parse(target).needs_frames for target in dryer.TARGETS] == [True, True]
    experiment = Experiment.read(friction.EXPERIMENT)
    assert (len(experiment.measured), len(experiment.drums)) == (4, 2)
    soft = drumrs.baseline(fill=0.2).softer(100.0)
    assert experiment.base.contact.bundle.normal_stiffness == soft.contact.bundle.normal_stiffness


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_it_comes_to_a_sentence_and_a_picture_in_small(name, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", [name, "--small", "--out", str(tmp_path)])
    example(name).main()
    assert capsys.readouterr().out.rstrip().endswith(".")
    assert len(list(tmp_path.glob("*.png"))) == 1
