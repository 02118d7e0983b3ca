"""Baffles are drawn up to the rim, but for walls that leave room behind them."""

import math

import numpy as np
import pytest
import shapely

from drumrs.verification import made_up


def drawn(line: list[list[float]]) -> shapely.Polygon:
    contacts = np.zeros((1, 4), dtype=np.uint16)
    places = np.zeros((1, 4, 2))
    frames = made_up.frames(
        places, 0.06, drum_angles=np.zeros(1), contacts=contacts, baffles=(np.array(line),)
    )
    (outline,) = frames.drawn_baffles
    return shapely.Polygon(outline)


def test_a_wide_base_follows_the_rim():
    half = 0.4
    foot = [[math.cos(half), math.sin(half)], [0.8, 0.0], [math.cos(half), -math.sin(half)]]
    segment = half - math.sin(half) * math.cos(half)
    chord = shapely.Polygon(foot).area
    assert drawn(foot).area == pytest.approx(chord + segment, rel=0.01)
    assert drawn(foot).area > 1.3 * chord


def test_a_wall_across_the_drum_stays_straight():
    far = math.sqrt(1.0 - 0.01**2)
    wall = [[far, -0.01], [far, 0.01], [-far, 0.01], [-far, -0.01]]
    assert drawn(wall).area == pytest.approx(0.04, rel=0.01)
