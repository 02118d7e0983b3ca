"""What is said at the start of a run that does what its author may not expect."""

import warnings

import pytest

import drumrs
from drumrs import DrumrsWarning, State

RADIUS = 0.02375 / 2.0
TWO = State([[0.0, 0.0], [0.1, 0.0]], radii=[RADIUS, 0.3 * RADIUS])
DAMPED = {"contact.bundle.normal_damping": 5350.0, "run.time_step": "auto"}
CLIPPED = {"contact.bundle.restitution": 1e-6, "contact.bundle.tension": "clipped", "run.time_step": "auto"}


def test_an_overdamped_pair_that_may_pull_is_named():
    with pytest.warns(DrumrsWarning) as told:
        drumrs.Simulation(drumrs.baseline().replace(DAMPED), state=TWO)
    (warning,) = told
    sentence = str(warning.message)
    assert sentence.startswith("bundles 0 and 1 will stick together where they touch")
    assert "contact.bundle.normal_damping = 5350 is 1.454 times the critical damping" in sentence
    assert "restitution instead" in sentence
    assert 'contact.bundle.tension = "clipped"' in sentence
    assert warning.filename == __file__


def test_it_does_stick():
    state = State([[0.0, 0.0], [1.299 * RADIUS, 0.0]], [[0.0, 0.0], [-1.0, 0.0]], radii=TWO.radii)
    config = drumrs.baseline().replace({**DAMPED, "gravity": [0.0, 0.0]})
    with pytest.warns(DrumrsWarning):
        simulation = drumrs.Simulation(config, state=state)
    simulation.run(duration=0.01)
    assert simulation.velocities[1, 0] == pytest.approx(simulation.velocities[0, 0], abs=1e-6)


def test_a_law_by_species_is_named_by_its_own_key():
    two = [{"name": name, "share": 0.5} for name in ("steel", "ore")]
    pair = [{"between": ["ore", "drum"], "normal_damping": 1e5}]
    laws = {"load.species": two, "load.share_by": "mass", "contact.pair": pair}
    config = drumrs.baseline().replace({**laws, "run.time_step": "auto"})
    drumrs.Simulation(config, state=State([[0.0, 0.0]]))
    with pytest.warns(
        DrumrsWarning, match=r"bundle 0 and the drum will stick .* contact.pair\[0\].normal_damping"
    ):
        drumrs.Simulation(config, state=State([[0.0, 0.0]], species=["ore"]))


def test_a_step_that_damping_makes_much_shorter_is_told():
    with pytest.warns(DrumrsWarning) as told:
        simulation = drumrs.Simulation(drumrs.baseline().replace(CLIPPED))
    (warning,) = told
    sentence = str(warning.message)
    assert f'run.time_step = "auto" is {simulation.time_step:.3e} s'.replace("e-0", "e-") in sentence
    assert "500 times shorter than 3.075e-6 s without damping" in sentence
    assert 'contact.bundle.restitution = 1e-6 with tension = "clipped"' in sentence
    longest = 5.0 * simulation.time_step
    assert simulation.warnings == [sentence]
    drumrs.Simulation(drumrs.baseline().replace({**CLIPPED, "run.time_step": longest * 0.999}))


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"run.time_step": "auto"},
        {"contact.bundle.tension": "clipped", "run.time_step": "auto"},
        {"contact.bundle.normal_damping": 5350.0, "contact.bundle.tension": "clipped"},
    ],
)
def test_ordinary_runs_are_silent(changes):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert drumrs.Simulation(drumrs.baseline().replace(changes)).warnings == []


def test_the_command_line_says_it_in_a_line(drum):
    words = [f"--set={key}={value}" for key, value in CLIPPED.items()]
    status, _, told = drum("run", "--set=load.count=2", "--set=run.duration=1e-5", *words, *QUICK, "--json")
    assert status == 0
    lines = [line for line in told.splitlines() if line.startswith("drumrs: note that run.time_step")]
    assert len(lines) == 1


QUICK = ["--set=run.sample_every=1e-6"]
