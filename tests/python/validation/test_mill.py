"""Toe and shoulder of a made-up charge, and Morrell's C-model."""

import math

import numpy as np
import pytest

from drumrs.measures import morrell
from drumrs.measures.frame_window import FrameWindow
from drumrs.measures.toe import toe_and_shoulder

BIN = 3.0


@pytest.mark.parametrize(("half", "tilt"), [(60.0, 0.0), (75.0, 30.0), (90.0, 45.0), (60.0, 50.0)])
def test_toe_and_shoulder_of_a_segment(half, tilt):
    rng = np.random.default_rng(2)
    points = rng.uniform(-1.0, 1.0, (40, 8000, 2))
    chosen = []
    turned = np.radians(tilt)
    for frame in points:
        normal = frame @ np.array([-np.sin(turned), np.cos(turned)])
        inside = (np.hypot(*frame.T) < 1.0) & (normal < -np.cos(np.radians(half)))
        chosen.append(frame[inside][:500])
    count = min(map(len, chosen))
    positions = np.array([frame[:count] for frame in chosen])
    times = np.arange(len(positions)) * 0.01
    # Discs so small that the layer at the shell lies all but beside it.
    found = toe_and_shoulder(FrameWindow(positions, times, times), diameter=0.02, drum_radius=1.0)
    assert math.degrees(found.toe) == pytest.approx(270.0 + tilt - half, abs=BIN)
    assert math.degrees(found.shoulder) % 360.0 == pytest.approx((270.0 + tilt + half) % 360.0, abs=BIN)


def test_a_load_all_round_has_no_ends():
    angles = np.radians(np.arange(0.0, 360.0, 0.5))
    ring = np.column_stack([np.cos(angles), np.sin(angles)]) * 0.99 - [0.0, 1e-3]
    found = toe_and_shoulder(FrameWindow(np.array([ring, ring]), np.arange(2.0), np.arange(2.0)), 0.05, 1.0)
    assert math.isnan(found.toe)
    assert math.isnan(found.shoulder)


# Toe and shoulder [°] and arm, by an implementation of another hand that gives Erdem's 341.97 and 650.69 kW.
TABLE = {
    (0.2, 0.60): (246.5, 27.2, 0.321),
    (0.2, 0.72): (246.5, 34.9, 0.332),
    (0.2, 0.80): (246.1, 40.2, 0.338),
    (0.3, 0.60): (232.0, 33.1, 0.283),
    (0.3, 0.72): (231.9, 44.5, 0.298),
    (0.3, 0.80): (231.3, 52.2, 0.304),
    (0.4, 0.60): (217.5, 38.9, 0.242),
    (0.4, 0.72): (217.3, 53.1, 0.259),
    (0.4, 0.80): (216.3, 62.7, 0.263),
}


@pytest.mark.parametrize("point", TABLE, ids=str)
def test_the_c_model_gives_the_table(point):
    found = morrell.charge(*point)
    toe, shoulder, arm = TABLE[point]
    assert math.degrees(found.toe) == pytest.approx(toe, abs=0.06)
    assert math.degrees(found.shoulder) == pytest.approx(shoulder, abs=0.06)
    assert found.arm == pytest.approx(arm, abs=6e-4)


@pytest.mark.parametrize(("length", "filling", "power"), [(3.60, 0.2748, 341.97), (7.00, 0.2663, 650.69)])
def test_the_c_model_gives_a_published_power(length, filling, power):
    # Mills of 3.27 m at 0.7267 of critical, a charge of 4.6844 t/m³ [kW].
    radius = 3.27 / 2.0
    omega = 0.7267 * 42.3 / math.sqrt(3.27) * math.pi / 30.0
    mass = 4.6844 * math.pi * radius**2 * length * filling
    found = morrell.charge(filling, 0.7267).arm * mass * 9.81 * radius * omega
    assert found == pytest.approx(power, rel=2e-3)
