"""The velocity profile of a made-up bed: solid rotation below, a layer of uniform shear above."""

import numpy as np
import pytest

from drumrs.measures.frame_window import FrameWindow
from drumrs.measures.profile import profile

RADIUS, DISC, OMEGA, SLOPE = 1.0, 0.02, 2.0, np.radians(25.0)
SURFACE, MEETING, SURFACE_VELOCITY = -0.25, -0.55, 3.0
# The line through (SURFACE, SURFACE_VELOCITY) and (MEETING, Ω MEETING).
SHEAR = (SURFACE_VELOCITY - OMEGA * MEETING) / (SURFACE - MEETING)
STEP = 1e-3


def bed(sense: float = 1.0, layer: bool = True, moved: float = 0.0) -> FrameWindow:
    """Fill a segment at random to a solid fraction of 0.8, and move each disc by what its height says."""
    rng = np.random.default_rng(1)
    count = round(0.8 * 0.3425 * (2.0 * RADIUS / DISC) ** 2)
    points = rng.uniform(-RADIUS, RADIUS, (40 * count, 2))
    inside = (np.hypot(*points.T) < RADIUS) & (points[:, 1] < SURFACE)
    points = points[inside][: 4 * count]
    # Four frames' worth of discs in one, so that bins hold many: the solid fraction is four times as large.
    along, height = points.T
    turning = np.column_stack([-OMEGA * height, OMEGA * along])
    velocities = turning.copy()
    if layer:
        flows = height > MEETING
        velocities[flows] = np.column_stack(
            [-(SURFACE_VELOCITY + SHEAR * (height[flows] - SURFACE)), np.zeros(flows.sum())]
        )
    velocities[:, 0] += moved
    before, after = points - 0.5 * STEP * velocities, points + 0.5 * STEP * velocities
    tilt = np.array([[np.cos(SLOPE), np.sin(SLOPE)], [-np.sin(SLOPE), np.cos(SLOPE)]])
    positions = np.array([before @ tilt, after @ tilt]) * np.array([sense, 1.0])
    return FrameWindow(positions, np.array([0.0, STEP]), np.array([0.0, sense * OMEGA * STEP]))


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_straight_layer_on_solid_rotation(sense):
    found = profile(bed(sense), DISC, RADIUS)
    assert found.angular_velocity == pytest.approx(OMEGA)
    assert found.slope == pytest.approx(SLOPE, abs=0.02)
    assert found.surface == pytest.approx(SURFACE, abs=0.5 * DISC)
    assert found.depth == pytest.approx(RADIUS + SURFACE, abs=0.5 * DISC)
    assert found.surface_velocity == pytest.approx(SURFACE_VELOCITY, rel=0.03)
    zero = SURFACE - SURFACE_VELOCITY / SHEAR
    assert found.foot == pytest.approx(zero, abs=0.2 * DISC)
    assert found.layer == pytest.approx(SURFACE - zero, abs=0.6 * DISC)
    assert found.layer_to_solid_rotation == pytest.approx(SURFACE - MEETING, abs=0.6 * DISC)
    assert found.core_velocity_ratio == pytest.approx(1.0, abs=2e-3)


def test_a_bed_that_turns_as_one_body_has_no_layer():
    found = profile(bed(layer=False), DISC, RADIUS)
    assert found.surface_velocity == pytest.approx(OMEGA * SURFACE, rel=0.05)
    assert np.isnan(found.layer)
    known = found.solid_fractions > 0.4
    assert found.velocities[known] == pytest.approx(OMEGA * found.heights[known], abs=0.02)


def test_a_bed_that_slips_is_told_from_one_that_turns():
    slipping = profile(bed(moved=-0.1 * OMEGA * RADIUS), DISC, RADIUS)
    assert slipping.core_velocity_ratio < 0.95
