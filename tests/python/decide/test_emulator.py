"""The emulator: its errors are those that it makes, and what it says of itself follows from its matrix."""

import numpy as np
import pytest

from drumrs.decide.emulator import Emulator

RANGES = [(0.0, 1.0), (2.0, 4.0), (-1.0, 1.0)]


def points(count, seed):
    rng = np.random.default_rng(seed)
    return np.array([rng.uniform(*ends, count) for ends in RANGES]).T


def smooth(rows):
    return 3.0 + 2.0 * rows[:, 0] + np.sin(2.0 * rows[:, 1]) * rows[:, 2]


def test_its_errors_are_those_that_it_makes():
    rng = np.random.default_rng(1)
    known, new = points(60, 1), points(300, 2)
    emulator = Emulator.fit(known, smooth(known) + rng.normal(0.0, 0.1, 60), np.full(60, 0.1), RANGES)
    mean, error = emulator.predict(new)
    assert 0.5 < np.sqrt(np.mean(((mean - smooth(new)) / error) ** 2)) < 1.5
    assert np.median(error) < 0.1 < smooth(new).std()


def test_one_that_was_told_too_small_an_error_states_larger_ones_once_calibrated():
    rash = Emulator.fit(
        points(60, 1), np.random.default_rng(1).normal(0.0, 1.0, 60), np.full(60, 0.1), RANGES
    )
    assert rash.calibrated().predict(points(300, 2))[1].mean() > 0.15


def test_leaving_one_out_is_what_the_others_say():
    from sklearn.gaussian_process import GaussianProcessRegressor

    known = points(25, 1)
    whole = Emulator.fit(known, smooth(known), np.full(25, 0.05), RANGES)
    kept = [k for k in range(25) if k != 7]
    own = GaussianProcessRegressor(whole.process.kernel_, alpha=whole.process.alpha[kept], optimizer=None)
    x = whole.process.X_train_
    own.fit(x[kept], whole.process.y_train_[kept])
    mean, error = own.predict(x[[7]], return_std=True)
    stray = (whole.process.y_train_[7] - mean[0]) / np.hypot(error[0], np.sqrt(whole.process.alpha[7]))
    assert whole.loo_residuals[7] == pytest.approx(stray, rel=1e-6)


def test_a_point_taken_for_known_is_met_and_leaves_the_others_alone():
    known = points(25, 1)
    emulator = Emulator.fit(known, smooth(known), np.full(25, 0.05), RANGES)
    place = points(1, 3)
    believer = emulator.with_points(place, [4.0])
    mean, error = believer.predict(place)
    assert mean[0] == pytest.approx(4.0, abs=0.05)
    assert error[0] < 0.2 * emulator.predict(place)[1][0]
    assert believer.center == emulator.center


def test_samples_have_the_mean_and_the_error_of_the_prediction():
    known, new = points(15, 1), points(6, 2)
    emulator = Emulator.fit(known, smooth(known), np.full(15, 0.2), RANGES)
    drawn = emulator.sample(new, 4000, np.random.default_rng(1))
    mean, error = emulator.predict(new)
    assert drawn.mean(axis=0) == pytest.approx(mean, abs=0.07 * error.max())
    assert drawn.std(axis=0) == pytest.approx(error, rel=0.07)


def test_an_error_that_no_run_knows_is_found_from_the_scatter():
    known = points(80, 1)
    values = smooth(known) + np.random.default_rng(1).normal(0.0, 0.1, 80)
    emulator = Emulator.fit(known, values, np.full(80, np.nan), RANGES)
    assert emulator.typical_error == pytest.approx(0.1, rel=0.3)


def test_an_error_that_one_run_does_not_know_is_the_largest_of_the_others():
    known, errors = points(20, 1), np.linspace(0.1, 0.2, 20)
    errors[3] = np.nan
    emulator = Emulator.fit(known, smooth(known), errors, RANGES)
    assert np.sqrt(emulator.process.alpha[3]) * emulator.scale == pytest.approx(0.2)


def test_it_predicts_what_the_process_of_the_library_does():
    known, new = points(30, 1), points(50, 2)
    emulator = Emulator.fit(known, smooth(known), np.full(30, 0.05), RANGES)
    scaled = (new - emulator.low) / emulator.span
    mean, error = emulator.process.predict(scaled, return_std=True)
    found = emulator.predict(new)
    assert found[0] == pytest.approx(emulator.center + emulator.scale * mean, rel=1e-9)
    assert found[1] == pytest.approx(emulator.scale * error, rel=1e-6)
