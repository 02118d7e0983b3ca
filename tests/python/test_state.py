"""Given starts: what is refused, and going on from a simulation's state with another configuration."""

import numpy as np
import pytest

import drumrs
from drumrs import ConfigError, State

RADIUS = 0.02375 / 2.0
WALL = {"drum.rim": False, "rotation.rpm": 0.0, "drum.walls": [[[-0.1, 0.0], [0.1, 0.0]]]}


@pytest.mark.parametrize(
    ("changes", "state", "sentence"),
    [
        ({}, State([[0.0, 0.0], [0.0, 0.0]]), r"state.positions\[0\] and \[1\] overlap by 200.000 %"),
        (
            {},
            State([[0.0, 0.0], [0.8 * RADIUS, 0.0]]),
            r"state.positions\[0\] and \[1\] overlap by 120.000 %",
        ),
        (
            {},
            State([[0.1, 0.0], [0.0, 0.0], [1.51 * RADIUS, 0.0]]),
            r"state.positions\[1\] and \[2\] overlap by 49.000 % of the smaller radius, but may by at most 10 %",
        ),
        (
            {"drum.baffles.count": 3},
            State([[0.1975 - 0.3 * RADIUS, 0.0]]),
            r"\[0\] and the baffle 1 overlap by 70",
        ),
        (WALL, State([[0.0, 0.0]]), r"state.positions\[0\] is \[0, 0\], but must be .*: there is the wall 1"),
        (WALL, State([[0.0, 0.8 * RADIUS]]), r"state.positions\[0\] and the wall 1 overlap by 20.000 %"),
        ({}, State([[0.0, -0.2375]]), r"state.positions\[0\] is .*: there is the rim"),
        (
            {},
            State([[0.0, 0.0]], radii=[1.0]),
            r"state.radii\[0\] is 1, but must be smaller than the drum's radius",
        ),
        ({}, State([[0.0, 0.0]], species=[1]), r"state.species\[0\] is 1, but must be below 1"),
        ({}, State([[0.0, 0.0]], species=[0.5]), "state.species is .*whole numbers"),
        ({}, State([[0.0, 0.0]], species=["ore"]), r"state.species\[0\] is 'ore', .* which has none"),
        ({}, State([[0.0, 0.0]], drum_angle=float("nan")), "state.drum_angle is NaN"),
        ({}, State([[0.0, 0.0]], drum_angle="up"), "state.drum_angle is 'up'"),
        ({}, State([[0.0, 0.0]], contacts={"pairs": {}}), "state.contacts is "),
    ],
)
def test_bad_starts_are_named(changes, state, sentence):
    with pytest.raises(ConfigError, match=sentence):
        drumrs.Simulation(drumrs.baseline().replace(changes), state=state)


def test_a_slight_overlap_is_taken():
    drumrs.Simulation(drumrs.baseline(), state=State([[0.0, 0.0], [1.91 * RADIUS, 0.0]]))


def test_of_many_discs_the_two_are_found():
    side = 100
    places = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2) * 0.002 - 0.1
    places[4321] = places[1234] + 1e-4
    state = State(places, radii=np.full(side**2, 0.0009))
    with pytest.raises(ConfigError, match=r"state.positions\[1234\] and \[4321\] overlap"):
        drumrs.Simulation(drumrs.baseline().replace({"run.time_step": "auto"}), state=state)


@pytest.fixture(scope="module")
def config():
    return drumrs.baseline(baffles=True).softer(100.0)


@pytest.fixture(scope="module")
def settled(config):
    simulation = drumrs.Simulation(config)
    simulation.run(duration=1.1)
    return simulation


def test_a_state_goes_on(config, settled, tmp_path):
    settled.save(tmp_path / "kept")
    one = drumrs.Simulation.load(tmp_path / "kept")
    other = drumrs.Simulation(config, state=one.state)
    assert other.time == 0.0
    assert other.drum_angle == one.drum_angle
    for steps in (0, 20):
        one.run(steps=steps)
        other.run(steps=steps)
        assert np.abs(one.positions - other.positions).max() < 1e-12
        assert np.abs(one.velocities - other.velocities).max() < 1e-9
        assert np.abs(one.angular_velocities - other.angular_velocities).max() < 1e-7
    # Without the springs that the contacts have wound up, it is another motion.
    bare = State(**{**vars(other.state), "contacts": None})
    assert other.state.contacts["pairs"]["particle"].size > 20
    new = drumrs.Simulation(config, state=bare)
    new.run(steps=20)
    other.run(steps=20)
    assert np.abs(new.positions - other.positions).max() > 1e-12


def test_a_state_keeps_what_the_terms_of_a_law_remember(config):
    terms = {"rolling_friction": 0.2, "tangential_damping_ratio": 0.3, "adhesion": 0.5}
    config = config.replace({"contact.bundle": terms, "contact.drum": terms})
    one = drumrs.Simulation(config)
    one.run(duration=0.6)
    other = drumrs.Simulation(config, state=one.state)
    one.run(steps=20)
    other.run(steps=20)
    assert np.abs(one.positions - other.positions).max() < 1e-12
    assert np.abs(one.angular_velocities - other.angular_velocities).max() < 1e-7


def test_the_ledger_of_a_state_that_goes_on_closes(config, settled):
    simulation = drumrs.Simulation(config, state=settled.state)
    simulation.run(duration=0.5)
    assert simulation.series["energy_residual"].abs().max() < 1e-12
    assert simulation.series["elastic_normal"][0] > 0.0


@pytest.mark.parametrize("seed", range(1, 41))
def test_a_load_settles_and_then_friction_or_speed_changes(config, seed):
    simulation = drumrs.Simulation(config, seed=seed)
    simulation.run(duration=0.25 + 0.02 * seed)
    for changes in (
        {"contact.bundle.friction": 0.3},
        {"rotation.rpm": 20.0},
        {"contact.drum.tension": "clipped"},
    ):
        other = drumrs.Simulation(config.replace(changes), state=simulation.state)
        other.run(steps=200)
        assert other.series["max_overlap_ratio"].max() < 0.1


def test_order_of_memory_does_not_show_in_contacts():
    config = (
        drumrs.baseline()
        .softer(1e3)
        .replace({"load.diameter": 0.004, "load.fill": 0.5, "run.time_step": "auto"})
    )
    simulation = drumrs.Simulation(config)
    simulation.run(steps=3000)
    assert simulation.count > 2048
    state = simulation.state
    pairs = state.contacts["pairs"]
    own, other = pairs["particle"], pairs["other"]
    places, radii = np.asarray(state.positions), np.asarray(state.radii)
    gaps = radii[own] + radii[other] - np.linalg.norm(places[own] - places[other], axis=1)
    assert (own < other).all()
    assert pairs["overlap"] == pytest.approx(gaps, abs=1e-12)
    again = drumrs.Simulation(config, state=state)
    assert len(again.state.contacts["pairs"]["particle"]) == len(own)
    simulation.run(steps=20)
    again.run(steps=20)
    assert np.abs(simulation.positions - again.positions).max() < 1e-12


def test_contacts_that_do_not_fit_are_found_anew(config, settled):
    state = settled.state
    moved = np.array(state.positions) * 0.999
    simulation = drumrs.Simulation(config, state=State(**{**vars(state), "positions": moved}))
    assert simulation.state.contacts["pairs"]["overlap"].size > 0
    simulation.run(steps=100)


SLIDE = {
    "drum.rim": False,
    "rotation.rpm": 0.0,
    "drum.walls": [[[-0.5, 0.0], [0.5, 0.0]]],
    "run.time_step": "auto",
    "load.species": [{"name": "steel", "share": 0.5}, {"name": "ore", "share": 0.5}],
    "load.share_by": "mass",
}


def test_a_disc_of_one_species_slides_where_the_other_rolls():
    pair = [{"between": ["drum", "ore"], "friction": 0.0}]
    config = drumrs.baseline().replace({**SLIDE, "contact.pair": pair})
    state = State([[-0.2, RADIUS], [0.1, RADIUS]], [[0.5, 0.0], [0.5, 0.0]], species=["steel", "ore"])
    simulation = drumrs.Simulation(config, state=state)
    simulation.run(duration=0.2)
    rolls, slides = simulation.velocities[:, 0]
    assert rolls == pytest.approx(0.5 * 2.0 / 3.0, rel=1e-2)
    assert slides == pytest.approx(0.5)
    assert simulation.angular_velocities[1] == 0.0
    assert list(simulation.state.species) == [0, 1]


def test_two_species_meet_by_their_own_law():
    pair = [{"between": ["ore", "steel"], "restitution": 0.5}]
    config = drumrs.baseline().replace(
        {**SLIDE, "drum.walls": [], "gravity": [0.0, 0.0], "contact.pair": pair}
    )
    for species, restitution in (([0, 1], 0.5), ([1, 1], 0.1)):
        gap = 1.0001 * RADIUS
        state = State([[-gap, 0.0], [gap, 0.0]], [[1.0, 0.0], [-1.0, 0.0]], species=species)
        simulation = drumrs.Simulation(config, state=state)
        simulation.run(duration=0.001)
        assert simulation.velocities[1, 0] == pytest.approx(restitution, abs=0.01)


def test_bundles_of_a_state_have_size_and_density_of_their_species():
    two = [
        {"name": "steel", "share": 0.5, "density": 7800.0, "diameter": 0.02},
        {"name": "ore", "share": 0.5, "density": 2700.0},
    ]
    config = drumrs.baseline().replace({**SLIDE, "load.species": two})
    simulation = drumrs.Simulation(config, state=State([[-0.1, 0.2], [0.1, 0.2]], species=["steel", "ore"]))
    assert list(simulation.radii) == [0.01, RADIUS]
    assert simulation.masses == pytest.approx(np.pi * np.array([7800.0 * 0.01**2, 2700.0 * RADIUS**2]))


def test_sizes_of_a_state_are_asked_for_where_a_species_has_many():
    sizes = {"law": "normal", "by": "mass", "mean": 0.02, "sigma": 0.001}
    config = drumrs.baseline().replace({**SLIDE, "load.species": [{"name": "ore", "sizes": sizes}]})
    with pytest.raises(ConfigError, match=r"state\.radii is missing, but must be given where the bundles"):
        drumrs.Simulation(config, state=State([[0.1, 0.2]]))
