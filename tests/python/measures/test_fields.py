"""Fields of what has no bed, or turns the other way; discs that go round a center."""

import math
from dataclasses import replace

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.verification import made_up

WINDOW = (0.0, 1.0)


def test_clockwise_is_the_mirror_image():
    draws = np.random.default_rng(1)
    frames = made_up.segment(1.2, 0.4, 0.05, 4)
    frames = replace(frames, velocities=draws.normal(0.0, 1.0, frames.positions.shape))
    flip = np.array([-1.0, 1.0])
    other = replace(
        frames,
        positions=frames.positions * flip,
        velocities=frames.velocities * flip,
        drum_angles=-frames.drum_angles,
    )
    one, two = (measures.fields(each, WINDOW, np.ones(frames.count)) for each in (frames, other))
    assert np.array_equal(one.density, two.density)
    assert np.array_equal(one.velocity, two.velocity, equal_nan=True)


def test_where_there_is_no_bed_nothing_circulates():
    fields = measures.fields(made_up.frames(np.full((4, 1, 2), 0.3), 0.05), WINDOW, [1.0])
    fields = replace(fields, solid_fraction=np.zeros_like(fields.solid_fraction))
    with pytest.raises(ConfigError, match="without a bed"):
        measures.center_of_circulation(fields)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_discs_that_go_round_a_center_are_counted(sense):
    center, angles = np.array([0.3 * sense, -0.4]), sense * np.linspace(0.0, math.tau, 81)
    around = np.array([[0.1, 0.0], [0.0, -0.2], [0.3, 0.1]])
    places = [center + around @ made_up.turned(2.5 * angle) for angle in angles]
    frames = made_up.frames(places, 0.05, drum_angles=angles)
    assert measures.circulation(frames, WINDOW, np.array([0.3, -0.4])).value == pytest.approx(2.5)


def test_the_way_of_the_drum_is_that_of_the_window():
    # Two turns back, then one ahead: the window is the last turn.
    angles = np.concatenate(
        [np.linspace(0.0, -2.0 * math.tau, 81)[:-1], -2.0 * math.tau + np.linspace(0.0, math.tau, 81)]
    )
    places = [np.array([[0.3, -0.2], [0.5, 0.1]]) @ made_up.turned(angle) for angle in angles]
    frames = made_up.frames(places, 0.05, drum_angles=angles)
    found = measures.circulation(frames, (0.8, 1.6), np.array([0.1, 0.05]))
    assert found.value == pytest.approx(1.0)
    off_center = made_up.frames(np.add(places, [0.4, 0.0]), 0.05, drum_angles=angles)
    assert measures.circulation(off_center, (0.8, 1.6), np.array([0.4, 0.0])).value == pytest.approx(1.0)


def test_a_load_at_rest_has_no_turn_to_count_by():
    still = made_up.frames(np.full((4, 1, 2), 0.3), 0.05, drum_angles=np.zeros(4))
    assert measures.circulation(still, WINDOW) is None
