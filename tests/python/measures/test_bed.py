"""The bed at rest: segments of known area give it back, at any slope, and a load settles to what was asked for."""

import math

import numpy as np
import pytest

import drumrs
from drumrs.frames import Frames
from drumrs.measures import bulk_fill

RADIUS = 0.5


def segment(half_angle, slope):
    """Fill a segment of half that angle with points, its lowest place turned by a slope."""
    line = np.linspace(-RADIUS, RADIUS, 801)
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    inside = (np.hypot(*points.T) < RADIUS) & (points[:, 1] < -RADIUS * math.cos(half_angle))
    cos, sin = math.cos(slope), math.sin(slope)
    points = points[inside] @ np.array([[cos, sin], [-sin, cos]])
    return Frames(
        times=np.zeros(1),
        drum_angles=np.zeros(1),
        positions=points[np.newaxis],
        angles=np.zeros((1, len(points))),
        velocities=np.zeros((1, len(points), 2)),
        contacts=np.zeros((1, len(points)), np.uint16),
        radii=np.full(len(points), 1e-3),
        drum_radius=RADIUS,
    )


@pytest.mark.parametrize("half_angle", [0.4, 1.0, math.pi / 2.0, 2.0, 2.8])
@pytest.mark.parametrize("slope", [0.0, 0.6])
def test_a_segment_has_its_area(half_angle, slope):
    area = (half_angle - math.sin(half_angle) * math.cos(half_angle)) / math.pi
    assert bulk_fill(segment(half_angle, slope)) == pytest.approx(area, abs=2e-3)


def test_a_settled_bed_is_as_large_as_was_asked_for():
    still = {"rotation.rpm": 0.0, "load.diameter": 0.015}
    config = drumrs.baseline().replace({**still, "load.fill": None, "load.bulk_fill": 0.4}).softer(100.0)
    simulation = drumrs.Simulation(config)
    simulation.run(duration=0.6)
    assert bulk_fill(simulation.frames) == pytest.approx(0.4, rel=0.05)


def test_a_bed_needs_a_drum():
    frames = Frames(**{**vars(segment(1.0, 0.0)), "drum_radius": None})
    with pytest.raises(drumrs.ConfigError, match=r"drum.rim is False, but must be true"):
        bulk_fill(frames)
