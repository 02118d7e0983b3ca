"""Unbalance: a load of species, a drum at rest, chances at their ends."""

import numpy as np
import pytest

import drumrs
from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.verification import made_up


def test_masses_are_those_of_the_species_with_their_water():
    species = [
        {"name": "steel-ball", "share": 0.5, "density": 7800.0, "diameter": 0.03},
        {"name": "ore", "share": 0.5, "diameter": 0.02},
    ]
    changes = {"load.species": species, "load.moisture": 0.25, "load.fill": 0.1}
    config = drumrs.baseline().replace({**changes, "load.share_by": "mass", "run.time_step": "auto"})
    simulation = drumrs.Simulation(config)
    assert measures.disc_masses(config, simulation.frames) == pytest.approx(simulation.masses, rel=1e-12)


def test_a_force_turns_only_with_a_drum_that_turns():
    simulation = drumrs.Simulation(drumrs.baseline().replace({"rotation.rpm": 0.0}))
    simulation.run(duration=0.05)
    with pytest.raises(ConfigError, match="the drum turns all the time"):
        measures.turning_force(simulation.series, (0.0, 0.05))


def test_weight_does_not_turn():
    angles = np.linspace(0.0, 4.0, 401)
    middle = 0.5 * (angles[1:] + angles[:-1])
    force = 3.0 * np.sinc(0.01 / 2.0 / np.pi) * np.exp(1j * (middle + 0.5)) + (2.0 - 5.0j)
    series = {
        "time": angles,
        "drum_angle": angles,
        "rim_force_x": np.concatenate([[0.0], force.real]),
        "rim_force_y": np.concatenate([[0.0], 0.75 * force.imag]),
        "baffle_1_force_y": np.concatenate([[0.0], 0.25 * force.imag]),
    }
    import polars as pl

    found = measures.turning_force(pl.DataFrame(series), (0.0, 4.0))
    assert found == pytest.approx(3.0 * np.array([np.cos(0.5), np.sin(0.5)]), rel=1e-9)


@pytest.mark.parametrize(
    ("values", "share", "low", "high", "tries"),
    [([1.0] * 10, 0.0, 0.0, 0.30850, 1.0), ([3.0] * 10, 1.0, 0.69150, 1.0, float("inf"))],
)
def test_chances_that_are_none_or_all(values, share, low, high, tries):
    found = measures.exceedance(values, 2.0)
    assert (found.share, found.tries) == (share, tries)
    assert (found.low, found.high) == pytest.approx((low, high), abs=1e-5)


def test_unbalance_needs_two_frames():
    with pytest.raises(ConfigError, match="at least two frames"):
        measures.unbalance(made_up.frames(np.zeros((4, 1, 2)), 0.1), (0.0, 1e-9), [1.0])
