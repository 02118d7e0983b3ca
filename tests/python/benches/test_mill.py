"""The segment form of a mill's power, and the drums that are scaled."""

import doctest
import math

import numpy as np
import pytest

import drumrs
import mill


def test_examples_run():
    assert doctest.testmod(mill).failed == 0


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.5])
def test_the_lever_is_that_of_a_segment(angle):
    # Strips of the unit circle beyond the chord at cos θ.
    middles = np.linspace(math.cos(angle), 1.0, 200_001)
    middles = 0.5 * (middles[1:] + middles[:-1])
    widths = np.sqrt(1.0 - middles**2)
    fill = 2.0 * widths.sum() * (middles[1] - middles[0]) / math.pi
    assert mill.segment_lever(fill, bed=1.0) == pytest.approx(
        (widths * middles).sum() / widths.sum(), rel=1e-5
    )


def test_a_single_bundle_lies_at_the_rim():
    assert mill.segment_lever(1e-4) == pytest.approx(1.0, abs=0.01)


def test_a_scaled_drum_has_the_same_groups():
    small, large = mill.scaled(0)[0], mill.scaled(1)[0]
    froude = [config.rotation.rpm**2 * config.drum.diameter for config in (small, large)]
    assert froude[0] == froude[1]
    assert small.drum.diameter / small.load.diameter == large.drum.diameter / large.load.diameter
    periods = [drumrs.Simulation(config).collision_time["bundle"] for config in (small, large)]
    assert periods[1] == pytest.approx(2.0 * periods[0])
