"""Morris and Sobol on functions whose answers are known, with noise."""

import math

import numpy as np
import pytest
from scipy.stats import sobol_indices

from drumrs.decide.sensitivity import STEP, morris, noise_of, saltelli, sobol, trajectories
from drumrs.errors import ConfigError

# Ishigami's function with a = 7, b = 0.1 (I. M. Sobol' & Y. L. Levitan 1999): variance 13.84.
FIRST, TOTAL, VARIANCE = (0.3139, 0.4424, 0.0), (0.5576, 0.4424, 0.2437), 13.844


def ishigami(points):
    x, y, z = np.moveaxis((2.0 * points - 1.0) * math.pi, -1, 0)
    return np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)


def noisy(function, points, noise, random):
    return function(points) + noise * random.normal(size=points.shape[:-1])


@pytest.mark.parametrize("noise", [0.0, 1.0, 3.0])
def test_ishigami_is_recovered_from_noise(noise):
    random = np.random.default_rng(1)
    points = saltelli(1024, 3)
    some = points[0, :64]
    pairs = tuple(noisy(ishigami, some, noise, random) for _ in range(2))
    found = sobol(noisy(ishigami, points, noise, random), pairs)
    for shares, known in ((found.first, FIRST), (found.total, TOTAL)):
        for share, exact in zip(shares, known, strict=True):
            # Half more than the interval of 95 % holds: all of the 18 are to be right.
            assert abs(share.mean - exact) < max(1.5 * share.half_width, 0.01)
            assert share.half_width < 0.1 + 0.06 * noise
    chance = noise**2 / (VARIANCE + noise**2)
    assert abs(found.chance.mean - chance) < max(1.5 * found.chance.half_width, 1e-12)


def test_a_single_factor_explains_all_but_the_noise():
    random, points = np.random.default_rng(4), saltelli(256, 1)

    def steep(places):
        return 3.0 * places[..., 0]

    pairs = tuple(noisy(steep, points[0], 0.5, random) for _ in range(2))
    found = sobol(noisy(steep, points, 0.5, random), pairs)
    (first,), (total,) = found.first, found.total
    assert abs(first.mean - 1.0) < max(1.5 * first.half_width, 0.01)
    assert abs(total.mean - 1.0) < max(1.5 * total.half_width, 0.01)
    # The variance of 3 x is 9/12, that of the noise 1/4.
    assert abs(found.chance.mean - 0.25) < 1.5 * found.chance.half_width


def test_without_the_correction_noise_would_be_a_share_of_every_factor():
    random = np.random.default_rng(2)
    points, some = saltelli(1024, 3), saltelli(64, 3)[0]
    values = noisy(ishigami, points, 3.0, random)
    right = sobol(values, tuple(noisy(ishigami, some, 3.0, random) for _ in range(2)))
    wrong = sobol(values, (np.zeros(64), np.zeros(64)))
    assert all(
        one.mean > other.mean + 0.05 for one, other in zip(wrong.total[1:], right.total[1:], strict=True)
    )


def test_without_noise_the_indices_are_those_of_scipy():
    values = ishigami(saltelli(256, 3))
    found = sobol(values, (np.zeros(4), np.zeros(4)))
    arrays = {"f_A": values[[0]], "f_B": values[[1]], "f_AB": values[2:, None]}
    scipys = sobol_indices(func=arrays, n=256)
    assert [share.mean for share in found.first] == pytest.approx(list(scipys.first_order))
    assert [share.mean for share in found.total] == pytest.approx(list(scipys.total_order))


def linear(points):
    return 4.0 * points[..., 0] - 2.0 * points[..., 1] * points[..., 2]


def test_effects_are_changes_over_the_range():
    points = trajectories(200, 4)
    found = morris(points, linear(points), 0.0, 200)
    assert (found[0].mean, found[0].size, found[0].scatter) == pytest.approx((4.0, 4.0, 0.0), abs=1e-9)
    # −2 z on average, z even over four levels; it acts together with the third.
    assert found[1].mean == pytest.approx(-1.0, abs=0.1)
    assert found[1].scatter > 0.5
    assert found[3].size == 0.0
    assert [effect.is_dead for effect in found] == [False, False, False, True]


def test_a_dead_factor_is_at_its_floor():
    random = np.random.default_rng(3)
    points, noise = trajectories(400, 4), 0.5
    effect = morris(points, noisy(linear, points, noise, random), noise, 10**6)[3]
    assert effect.floor == pytest.approx(2.0 * noise / (STEP * math.sqrt(math.pi)))
    assert abs(effect.size - effect.floor) < 3.0 * effect.spread
    assert effect.spread < 0.05 * effect.floor


def test_dead_factors_are_found_dead_and_live_ones_not():
    random = np.random.default_rng(4)
    dead = strong = weak = 0
    for seed in range(200):
        points = trajectories(10, 4, seed)
        values = noisy(linear, points, 0.3, random)
        noise = noise_of(values[:, 0], noisy(linear, points[:, 0], 0.3, random))
        found = morris(points, values, noise, 10)
        dead += found[3].is_dead
        strong += not found[0].is_dead
        weak += not found[1].is_dead
    assert dead >= 190
    assert strong == 200
    # Three times the noise of a run, on average.
    assert weak >= 150


def test_noise_is_that_of_pairs():
    random = np.random.default_rng(5)
    one, other = random.normal(3.0, 0.7, (2, 4000))
    one[7] = math.nan
    assert noise_of(one, other) == pytest.approx(0.7, rel=0.05)
    with pytest.raises(ConfigError, match="has 1 points with two values"):
        noise_of(np.array([1.0, math.nan]), np.array([1.0, 2.0]))


def test_runs_without_a_value_are_left_out():
    points = trajectories(20, 2)
    values = points @ np.array([1.0, 2.0])
    values[3, 1] = math.nan
    assert [round(effect.mean, 9) for effect in morris(points, values, 0.0, 20)] == [1.0, 2.0]
    design = saltelli(128, 3)
    of_design = ishigami(design)
    of_design[2, 5] = math.nan
    found = sobol(of_design, (np.zeros(2), np.zeros(2)))
    assert abs(found.total[1].mean - TOTAL[1]) < 0.2
    with pytest.raises(ConfigError, match="has 0 points with values"):
        sobol(np.full((5, 8), math.nan), (np.zeros(2), np.zeros(2)))


def test_larger_designs_begin_with_smaller_ones():
    assert np.array_equal(trajectories(5, 3), trajectories(9, 3)[:5])
    assert np.array_equal(saltelli(16, 3), saltelli(64, 3)[:, :16])
