"""Hypervolume and its expected improvement, against counting and against drawn values."""

import numpy as np
import pytest

from drumrs.decide.gain import expected_improvement, hypervolume, non_dominated

FRONT = np.array([[0.2, 0.9], [0.5, 0.4], [0.8, 0.1], [0.6, 0.6]])
REFERENCE = np.array([1.0, 1.0])


def test_the_points_that_are_not_dominated_are_those_that_pairs_say():
    values = np.random.default_rng(1).integers(0, 12, (60, 2)).astype(float)
    values = np.unique(values, axis=0)
    by_pairs = [not any((b <= a).all() and (b < a).any() for b in values) for a in values]
    assert non_dominated(values).tolist() == by_pairs


def test_the_hypervolume_is_the_share_of_places_that_are_dominated():
    grid = (np.arange(400) + 0.5) / 400
    x, y = np.meshgrid(grid, grid)
    dominated = np.any([(x >= a) & (y >= b) for a, b in FRONT], axis=0)
    assert hypervolume(FRONT, REFERENCE) == pytest.approx(dominated.mean(), abs=5e-3)


@pytest.mark.parametrize(
    ("mean", "error"), [((0.4, 0.3), (0.2, 0.1)), ((0.9, 0.9), (0.3, 0.4)), ((0.1, 0.1), (0.01, 0.3))]
)
def test_the_expected_gain_of_two_objectives_is_the_mean_of_drawn_gains(mean, error):
    found = expected_improvement(np.array([mean]), np.array([error]), FRONT, REFERENCE)[0]
    drawn = np.random.default_rng(1).normal(mean, error, (20_000, 2))
    before = hypervolume(FRONT, REFERENCE)
    gains = [hypervolume(np.vstack([FRONT, one]), REFERENCE) - before for one in drawn]
    assert found == pytest.approx(np.mean(gains), abs=4.0 * np.std(gains) / np.sqrt(len(gains)))


def test_the_expected_gain_of_one_objective_is_the_textbook_formula():
    from scipy.stats import norm

    mean, error, best = 1.3, 0.4, 1.1
    z = (best - mean) / error
    expected = (best - mean) * norm.cdf(z) + error * norm.pdf(z)
    front = np.array([[1.5], [best]])
    found = expected_improvement(np.array([[mean]]), np.array([[error]]), front, np.array([9.0]))
    assert found[0] == pytest.approx(expected, rel=1e-12)
