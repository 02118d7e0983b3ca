"""What follows from a configuration is what its simulation has, and what formulas written down here say."""

import dataclasses
import math

import pytest

import drumrs
from drumrs import registry
from drumrs.config import derived as module

BASE = drumrs.baseline()
MASS = 1000.0 * math.pi * 0.02375**2 / 4.0


@pytest.mark.parametrize(
    "changes", [{}, {"contact.bundle.tension": "clipped", "run.time_step": "auto"}, {"load.count": 7}]
)
def test_it_is_what_the_simulation_has(changes):
    config = BASE.replace(changes)
    simulation = drumrs.Simulation(config)
    assert config.derived.bundle_mass == simulation.masses[0]
    assert config.derived.load_mass == pytest.approx(simulation.masses.sum(), rel=1e-14)
    assert config.derived.time_step == simulation.time_step
    assert config.derived.angular_velocity == simulation.drum_angular_velocity
    for side, duration in simulation.collision_time.items():
        assert getattr(config.derived, side).collision_time == duration


def test_masses_and_damping_follow_the_formulas():
    derived = BASE.derived
    assert derived.bundle_mass == pytest.approx(MASS)
    assert derived.load_mass == pytest.approx(100 * MASS)
    for contact, law, mass in (
        (derived.bundle, BASE.contact.bundle, MASS / 2.0),
        (derived.drum, BASE.contact.drum, MASS),
    ):
        loss = -math.log(0.1)
        ratio = loss / math.hypot(math.pi, loss)
        assert contact.effective_mass == pytest.approx(mass)
        assert contact.damping_ratio == pytest.approx(ratio)
        assert contact.normal_damping == pytest.approx(2.0 * ratio * math.sqrt(law.normal_stiffness * mass))
        frequency = math.sqrt(law.normal_stiffness / mass)
        assert contact.collision_time == pytest.approx(math.pi / (frequency * math.sqrt(1.0 - ratio**2)))


@pytest.mark.parametrize("tension", ["allowed", "clipped"])
@pytest.mark.parametrize("restitution", [0.05, 0.1, 0.9, 1.0])
def test_restitution_and_damping_turn_into_each_other(tension, restitution):
    law = {"contact.bundle.tension": tension, "run.time_step": "auto"}
    damping = BASE.replace({**law, "contact.bundle.restitution": restitution}).derived.bundle.normal_damping
    back = BASE.replace({**law, "contact.bundle.normal_damping": damping}).derived.bundle
    assert back.restitution == pytest.approx(restitution, rel=1e-12)


def test_an_overdamped_contact_does_not_bounce():
    heavy = BASE.replace({"contact.bundle.normal_damping": 1e5, "run.time_step": "auto"})
    assert heavy.derived.bundle.damping_ratio > 1.0
    assert heavy.derived.bundle.restitution == 0.0


def test_speeds():
    derived = BASE.derived
    omega = 54.0 * 2.0 * math.pi / 60.0
    assert derived.angular_velocity == pytest.approx(omega)
    assert derived.froude_number == pytest.approx(omega**2 * 0.2375 / 9.81)
    assert derived.critical_angular_velocity == pytest.approx(math.sqrt(9.81 / (0.2375 - 0.011875)))
    assert derived.critical_share == pytest.approx(omega / derived.critical_angular_velocity)
    program = BASE.replace({"rotation.program": [[0.0, 10.0], [1.0, -54.0], [2.0, 20.0]]}).derived
    assert program.angular_velocity is None
    assert (program.froude_number, program.critical_share) == (derived.froude_number, derived.critical_share)


def test_in_a_shell_the_corner_farthest_from_the_axis_stands_for_the_rim():
    corners = [[0.3, 0.0], [0.0, 0.2], [-0.3, 0.0], [0.0, -0.2]]
    shell = BASE.replace({"drum.rim": False, "drum.liner.outlines": [{"name": "shell", "points": corners}]})
    facts, omega = shell.derived, 54.0 * math.pi / 30.0
    assert facts.froude_number == pytest.approx(omega**2 * 0.3 / 9.81)
    assert facts.critical_angular_velocity == pytest.approx(math.sqrt(9.81 / (0.3 - 0.011875)))
    assert facts.critical_share == pytest.approx(omega / facts.critical_angular_velocity)
    assert shell.facts.startswith("Froude number 0.978, 96.9 % of the critical speed")


def test_what_places_a_case_is_in_the_registry():
    names = [field.name for field in dataclasses.fields(module.Facts)]
    assert names == list(registry.FACTS)


def test_steps_in_a_collision():
    for changes in ({}, {"run.time_step": 1e-6}):
        derived = BASE.replace(changes).derived
        assert derived.steps_per_collision == pytest.approx(derived.bundle.collision_time / derived.time_step)
    assert BASE.replace({"run.time_step": "auto"}).derived.steps_per_collision == pytest.approx(50.0)


def test_a_mass_beyond_all_numbers_is_told_as_infinite():
    config = BASE.replace({"load.density": 1e306, "load.count": 10**6, "run.time_step": "auto"})
    assert "load inf kg" in config.facts


def test_facts_of_a_given_load_are_its_own():
    state = drumrs.State([[0.0, 0.0], [0.1, 0.0]], radii=[0.01, 0.02])
    simulation = drumrs.Simulation(BASE.replace({"run.time_step": 1e-6}), state=state)
    assert f"load {simulation.masses.sum():.3g} kg per m of depth" in simulation.facts
    assert f"{100.0 * 54.0 * math.pi / 30.0 * math.sqrt((0.2375 - 0.02) / 9.81):.3g} %" in simulation.facts
    fewest = min(simulation.collision_time.values()) / 1e-6
    assert simulation.facts.endswith(f"{fewest:.3g} steps per collision")


def test_what_there_is_not_is_none():
    program = BASE.replace({"rotation.program": [[0.0, 0.0], [1.0, 54.0]]}).derived
    assert program.angular_velocity is None
    weightless = BASE.replace({"gravity": (0.0, 0.0)})
    assert weightless.derived.froude_number is weightless.derived.critical_share is None
    assert weightless.facts.startswith("load 44.3 kg")
    rimless = BASE.replace({"drum.rim": False}).derived
    assert rimless.critical_angular_velocity is rimless.critical_share is rimless.froude_number is None
    hertz = {"contact.base": "hertz", "contact.bundle.young_modulus": 1e8, "contact.drum.young_modulus": 1e8}
    derived = BASE.replace({**hertz, "run.time_step": "auto"}).derived
    assert derived.bundle.normal_damping is derived.bundle.damping_ratio is None
    assert derived.bundle.restitution == 0.1
    assert derived.bundle.collision_time > 0.0


def test_what_no_simulation_can_have_is_refused():
    with pytest.raises(drumrs.ConfigError, match=r"run.time_step is 0\.001, but must be at most"):
        _ = BASE.replace({"run.time_step": 1e-3}).derived
    with pytest.raises(
        drumrs.ConfigError, match=r"contact.bundle.young_modulus is missing, but must be given"
    ):
        _ = BASE.replace({"contact.base": "hertz"}).derived


@pytest.mark.parametrize(
    ("key", "greatest"),
    [
        ("load.count", module.GREATEST_COUNT),
        ("drum.baffles.count", module.GREATEST_BAFFLES),
    ],
)
def test_the_greatest_counts_are_those_of_the_core(key, greatest):
    assert BASE.replace({key: greatest}) is not None
    with pytest.raises(drumrs.ConfigError, match=f"to {greatest}$"):
        BASE.replace({key: greatest + 1})
