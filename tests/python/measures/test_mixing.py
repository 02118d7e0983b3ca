"""Mixing of frames: a load that turns as one body does not mix, one that is shuffled does; and what is refused."""

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.verification import made_up

ANGLES = np.linspace(0.0, 4.0 * np.pi, 9)
BED = made_up.lattice(0.06)[:200]


def turning(positions) -> object:
    return made_up.frames(positions, 0.06, drum_angles=ANGLES)


@pytest.mark.parametrize("by", ["side", "layer", "depth"])
def test_a_load_that_turns_as_one_body_stays_apart(by):
    frames = turning([BED @ made_up.turned(angle) for angle in ANGLES])
    turns, index = measures.mixing_curve(frames, (0.0, 1.0), by)
    assert turns == pytest.approx(ANGLES / (2.0 * np.pi))
    assert index.shape == (3, 9)
    assert index == pytest.approx(index[:, :1] * np.ones(9), abs=0.02)
    assert (index < 0.6).all()


def test_a_shuffled_load_is_mixed_at_once():
    draws = np.random.default_rng(1)
    frames = turning([BED, *(draws.permutation(BED) for _ in ANGLES[1:])])
    _, index = measures.mixing_curve(frames, (0.0, 1.0), "side", sides=[0.3])
    assert index[0, 0] < 0.4
    assert index[0, 1:].mean() == pytest.approx(1.0, abs=0.1)


def test_species_color_the_load():
    frames = made_up.frames([BED] * 2, 0.06, species=["ore"] * 50 + ["steel-ball"] * 150)
    assert measures.coloring(frames, "ore").tolist() == [True] * 50 + [False] * 150


@pytest.mark.parametrize("by", ["stone", "ore"])
def test_a_coloring_of_nothing_or_everything_is_refused(by):
    frames = made_up.frames([BED] * 2, 0.06, species=["ore"] * 200)
    with pytest.raises(ConfigError, match=rf"by is '{by}', .* one of side, layer, depth, ore"):
        measures.coloring(frames, by)


def test_cells_hold_as_many_discs_as_asked_for():
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (4000, 2))
    side = measures.cell_side(points, 10)
    assert 4000 * side**2 / 4.0 == pytest.approx(10.0, rel=0.2)


def test_three_numbers_need_four_values():
    with pytest.raises(ConfigError, match="at least four"):
        measures.mixing_rate([0.0, 1.0, 2.0], [0.0, 0.5, 0.6])
