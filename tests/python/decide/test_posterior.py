"""The posterior of made-up models: the truth is in the region, one number alone leaves a ridge."""

import numpy as np
import pytest

from drumrs.decide.posterior import fit, log_density
from drumrs.decide.space import Parameter, Space
from drumrs.errors import ConfigError

SPACE = Space(tuple(Parameter(key, 0.0, 1.0, 0.001) for key in ("friction", "rolling")))
# Noise of a run of each output, and errors of the measurements.
NOISE, ERRORS = np.array([0.3, 0.05, 0.4]), np.array([0.8, 0.1, 0.8])
DISCREPANCY = 0.03


def model(points):
    """A slope, a power and a toe, of two parameters."""
    a, b = points.T
    return np.array([25.0 + 12.0 * a + 9.0 * b, 2.0 + 1.5 * a - 0.8 * b**2, 30.0 * np.sqrt(0.2 + a * b)]).T


def fitted(seed, truth, outputs=3, runs=24):
    rng = np.random.default_rng(seed)
    exact = model(truth[None])[0]
    measured = exact + rng.normal(0.0, np.hypot(ERRORS, DISCREPANCY * exact))

    def evaluate(points, _):
        noisy = model(points) + NOISE * rng.standard_normal((len(points), 3))
        return noisy[:, :outputs], np.tile(NOISE[:outputs], (len(points), 1))

    errors = np.hypot(ERRORS, DISCREPANCY * measured)
    return fit(SPACE, evaluate, measured[:outputs], errors[:outputs], runs)


@pytest.mark.slow
def test_the_truth_is_in_the_ninety_per_cent_region_in_fifteen_of_twenty():
    truths = np.random.default_rng(1).uniform(0.1, 0.9, (20, 2))
    inside = [fitted(seed, truth).contains(truth) for seed, truth in enumerate(truths)]
    assert sum(inside) >= 15
    # A region that holds everything would say nothing.
    assert not fitted(0, truths[0]).contains(1.0 - truths[0])


def test_three_numbers_leave_a_point_and_one_a_ridge():
    truth = np.array([0.5, 0.4])
    point, ridge = fitted(3, truth), fitted(3, truth, outputs=1)
    assert point.narrowing().max() < 0.5 < ridge.narrowing().min()
    assert ridge.correlation()[0, 1] < -0.8
    low, median, high = point.quantiles()
    assert (low < median).all()
    assert (median < high).all()


def test_samples_are_drawn_with_the_probability_that_the_likelihood_says():
    """A linear model of one parameter, whose posterior is a normal distribution that one can write down."""
    space = Space((Parameter("x", 0.0, 1.0, 0.001),))
    found = fit(
        space,
        lambda points, _: (10.0 * points, np.full_like(points, 0.01)),
        np.array([4.0]),
        np.array([0.5]),
        12,
    )
    assert found.samples.mean() == pytest.approx(0.4, abs=0.005)
    assert found.samples.std() == pytest.approx(0.05, rel=0.1)
    assert found.predict(0)[1] == pytest.approx(0.5, rel=0.1)
    # The posterior is as wide as the measurement: a second one halves the variance, half a bit.
    assert found.information(0, 0.5) == pytest.approx(0.5, abs=0.1)


def test_values_outside_the_ranges_have_no_probability():
    found = fitted(1, np.array([0.5, 0.5]))
    outside = np.array([[1.1, 0.5], [0.5, -0.1]])
    density = log_density(SPACE, found.emulators, found.values, found.errors, outside)
    assert np.isneginf(density).all()
    assert found.samples.min() >= 0.0
    assert found.samples.max() <= 1.0


def test_the_same_numbers_give_the_same_samples():
    truth = np.array([0.5, 0.4])
    assert (fitted(3, truth).samples == fitted(3, truth).samples).all()


def test_too_few_numbers_are_said():
    def evaluate(points, _):
        return np.full((len(points), 1), np.nan), np.full((len(points), 1), np.nan)

    with pytest.raises(ConfigError, match=r"has a number in 0 of 11 runs, but must have one in 6 at least"):
        fit(SPACE, evaluate, np.array([1.0]), np.array([0.1]), 16)
