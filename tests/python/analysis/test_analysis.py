"""Means, errors, intervals and drift, on made-up series whose answers are known."""

import math

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import analysis
from drumrs.analysis.blocks import longest_blocks
from drumrs.errors import ConfigError


def noise(random: np.random.Generator, count: int, memory: float) -> np.ndarray:
    """Return a first-order autoregressive series of unit variance, steady from the start.

    With memory a, its integrated correlation time is (1 + a) / (1 − a) / 2 intervals.
    """
    kicks = random.standard_normal(count) * math.sqrt(1.0 - memory**2)
    values = np.empty(count)
    values[0] = random.standard_normal()
    for k in range(1, count):
        values[k] = memory * values[k - 1] + kicks[k]
    return values


def run(rates: dict[str, np.ndarray], interval: float = 0.02) -> pl.DataFrame:
    """Return the series of a run whose running integrals grow at such rates."""
    count = len(next(iter(rates.values())))
    sums = {name: np.concatenate([[0.0], np.cumsum(rate) * interval]) for name, rate in rates.items()}
    return pl.DataFrame({"time": interval * np.arange(count + 1), **sums})


def test_means_and_errors_are_those_of_the_summary():
    config = drumrs.baseline(fill=0.1).replace(
        {"run.duration": 0.3, "run.window": [0.1, 0.3], "run.sample_every": 0.001}
    )
    result = drumrs.run(config, progress=False)
    own = analysis.rate_with_error(result.series, "drum_work", (0.1, 0.3))
    mass = 40 * 1000.0 * math.pi * 0.02375**2 / 4.0
    assert own.value / mass == pytest.approx(result.summary.drum_specific_power, rel=1e-12)
    assert own.error / mass == pytest.approx(result.summary.drum_specific_power_error, rel=1e-9)
    inside = result.series.filter((pl.col("time") > 0.1005) & (pl.col("time") < 0.3005))["drum_power"]
    spread = analysis.block_error(inside.to_numpy(), result.series["time"][1])
    assert spread.correlation_time == pytest.approx(result.summary.correlation_time, rel=1e-9)


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.8])
def test_block_error_knows_the_correlation_time(memory):
    random = np.random.default_rng(3)
    inflation = (1.0 + memory) / (1.0 - memory)
    spreads = [analysis.block_error(noise(random, 4096, memory), 0.5) for _ in range(40)]
    assert np.mean([s.correlation_time for s in spreads]) == pytest.approx(
        0.25 * inflation, rel=0.8
    )  # the greatest of many errors is above their mean
    true = math.sqrt(inflation / 4096)
    errors = np.array([s.error for s in spreads])
    assert true * 0.95 < errors.mean() < 1.35 * true


def coverage(memory: float, seeds: int, slow: float = 0.0) -> float:
    """Return how often an interval holds the true mean, 5; `slow` is the scatter of whole runs over their error."""
    random = np.random.default_rng(11)
    runs, rows = 600, 512
    error = math.sqrt((1.0 + memory) / (1.0 - memory) / rows)
    held = 0
    for _ in range(runs):
        states = 5.0 + slow * error * random.standard_normal(seeds)
        series = [run({"work": state + noise(random, rows, memory)}) for state in states]
        means = [analysis.rate_with_error(one, "work", (0.0, rows * 0.02)) for one in series]
        interval = analysis.student([m.value for m in means], [m.error for m in means])
        held += interval.low <= 5.0 <= interval.high
    return held / runs


@pytest.mark.parametrize("memory", [0.0, 0.8])
def test_a_lone_seeds_interval_is_wide(memory):
    assert coverage(memory, seeds=1) >= 0.99
    # Even where whole runs scatter half as much again as their blocks know.
    assert coverage(memory, seeds=1, slow=1.5) >= 0.95


@pytest.mark.parametrize("slow", [0.0, 1.0, 2.0, 5.0])
def test_three_seeds_intervals_hold_the_mean_nearly_as_often_as_they_say(slow):
    assert 0.89 <= coverage(0.5, seeds=3, slow=slow) <= 0.99


def test_seeds_alone_give_students_interval():
    interval = analysis.student([1.0, 2.0, 3.0])
    assert (interval.low, interval.high) == pytest.approx((2.0 - 2.484, 2.0 + 2.484), abs=1e-3)
    # Seeds that agree within their errors: the greater variance, the freedom of both.
    agreed = analysis.estimate([1.0, 2.0, 3.0], [1.5, 1.5, 1.5])
    assert agreed == analysis.Estimate(2.0, pytest.approx(1.5 / math.sqrt(3.0)), 23)
    # Seeds that do not: their scatter alone.
    assert analysis.estimate([1.0, 2.0, 3.0], [0.1, 0.1, 0.1]).freedom == 2


def test_estimates_combine():
    a, b = analysis.Estimate(4.0, 0.3, 5), analysis.Estimate(2.0, 0.1, 5)
    assert (a - b).error == pytest.approx(math.hypot(0.3, 0.1))
    assert (a / b).error == pytest.approx(2.0 * math.hypot(0.3 / 4.0, 0.1 / 2.0))
    assert 5 <= (a - b).freedom <= 10
    equal = analysis.mean_of([analysis.Estimate(float(k), 0.2, 4) for k in range(4)])
    assert (equal.mean, equal.error, equal.freedom) == (1.5, pytest.approx(0.1), 16)
    assert (a - analysis.Estimate(1.0, math.inf, 7)).interval().half_width == math.inf
    assert analysis.Estimate(1.0, 0.0, 3).interval() == analysis.Interval(1.0, 0.0)


def test_a_lone_seed_has_no_interval_without_an_error():
    assert analysis.student([2.0]).half_width == math.inf
    assert analysis.student([2.0], [None]).half_width == math.inf
    assert analysis.student([2.0], [0.5]).half_width == pytest.approx(2.0 * 0.5 * 2.365, rel=1e-3)
    with pytest.raises(ValueError, match="values is empty"):
        analysis.student([])


def test_intervals_are_those_of_students_tables():
    known = {(0.95, 1): 12.706, (0.95, 2): 4.303, (0.95, 7): 2.365, (0.95, 30): 2.042, (0.99, 9): 3.250}
    for (level, freedom), quantile in known.items():
        interval = analysis.Estimate(5.0, 2.0, freedom).interval(level)
        assert interval.half_width == pytest.approx(2.0 * quantile, abs=1.2e-3)


def test_ratio_counts_what_both_rates_share():
    random = np.random.default_rng(5)
    common = noise(random, 4096, 0.0)
    own = noise(random, 4096, 0.0)
    series = run({"above": 2.0 + 0.6 * common, "below": 1.0 + 0.3 * common + 0.01 * own})
    ratio = analysis.ratio_with_error(series, "above", "below", (0.0, 82.0))
    # 2 / 1 whatever they share: the error is that of 2 · 0.01 · own alone.
    assert ratio.value == pytest.approx(2.0, abs=0.002)
    assert ratio.error == pytest.approx(0.02 / math.sqrt(4096), rel=0.5)
    apart = run({"above": 2.0 + 0.3 * common, "below": 1.0 + 0.3 * own})
    expected = math.sqrt(0.3**2 + (2.0 * 0.3) ** 2) / math.sqrt(4096)
    error = analysis.ratio_with_error(apart, "above", "below", (0.0, 82.0)).error
    assert error == pytest.approx(expected, rel=0.5)


def test_ratio_over_nothing():
    series = run({"above": np.ones(20), "below": np.zeros(20)})
    assert analysis.ratio_with_error(series, "above", "below", (0.0, 0.4)) is None


def test_means_are_exact_for_any_sampling():
    series = run({"work": np.arange(100.0)}, interval=0.1)
    assert analysis.rate_with_error(series, "work", (2.0, 5.0)).value == pytest.approx(34.5)
    sparse = series.gather_every(10)
    assert analysis.rate_with_error(sparse, "work", (2.0, 5.0)).value == pytest.approx(34.5)


@pytest.mark.parametrize("window", [(3.0, 3.0), (50.0, 60.0)])
def test_window_without_samples(window):
    with pytest.raises(ConfigError, match="at least two samples"):
        analysis.rate_with_error(run({"work": np.ones(100)}), "work", window)


def drifting(slope: float, runs: int = 300, memory: float = 0.5) -> float:
    """Return how often a run whose rate climbs by `slope` standard deviations is said to drift."""
    random = np.random.default_rng(7)
    climb = slope * np.linspace(-0.5, 0.5, 500)
    found = [analysis.drift(run({"drum_work": 9.0 + climb + noise(random, 500, memory)}), (0.0, 10.0))]
    for _ in range(runs - 1):
        series = run({"drum_work": 9.0 + climb + noise(random, 500, memory)})
        found.append(analysis.drift(series, (0.0, 10.0)))
    return sum(one.drifting for one in found) / runs


def test_steady_runs_seldom_drift():
    assert drifting(0.0, runs=1500) <= 0.004


def test_drifting_runs_are_found():
    assert drifting(1.5) > 0.65
    assert drifting(2.5) > 0.98


def test_drift_has_slope_and_change():
    ramp = 10.0 + 0.2 * (np.arange(512) + 0.5) * 0.02
    found = analysis.drift(run({"drum_work": ramp}), (0.0, 10.24))
    assert found.slope == pytest.approx(0.2, rel=1e-6)
    assert found.change == pytest.approx(0.2 * 10.24 / ramp.mean(), rel=1e-3)
    assert found.drifting
    steady = analysis.drift(run({"drum_work": np.full(512, 3.0)}), (0.0, 10.24))
    assert not steady.drifting
    assert analysis.drift(run({"drum_work": np.ones(7)}), (0.0, 0.14)) is None


def ratio_run(random: np.random.Generator, ratio: np.ndarray) -> pl.DataFrame:
    below = 1.0 + 0.2 * random.standard_normal(len(ratio))
    above = ratio * below + 0.2 * random.standard_normal(len(ratio))
    return run({"above": above, "below": below})


def test_drift_of_a_ratio():
    random = np.random.default_rng(8)
    climb = 2.0 + 0.5 * np.linspace(-0.5, 0.5, 500)
    for _ in range(20):
        found = analysis.ratio_drift(ratio_run(random, climb), "above", "below", (0.0, 10.0))
        assert found.drifting
        assert found.change == pytest.approx(0.25, rel=0.3)
    steady = [
        analysis.ratio_drift(ratio_run(random, np.full(500, 2.0)), "above", "below", (0.0, 10.0))
        for _ in range(300)
    ]
    assert sum(one.drifting for one in steady) <= 2


def test_loads_that_switch_slowly_between_states_are_found():
    random = np.random.default_rng(9)
    # 30 s in two states, the window [20, 30] within one of them.
    states = np.where((np.arange(1500) > 350) & (np.arange(1500) < 800), 2.2, 1.8)
    times = (20.0, 30.0)
    for _ in range(20):
        found = analysis.state_switching(ratio_run(random, states), "above", "below", times)
        assert found.significance < 1e-3
        assert found.spread == pytest.approx(0.4, abs=0.15)
    steady = [
        analysis.state_switching(ratio_run(random, np.full(1500, 2.0)), "above", "below", times).significance
        for _ in range(300)
    ]
    assert sum(one < 1e-3 for one in steady) <= 2
    assert np.median(steady) == pytest.approx(0.5, abs=0.25)
    assert analysis.state_switching(ratio_run(random, states), "above", "below", (0.0, 6.0)) is None
    assert analysis.state_switching(ratio_run(random, states), "above", "below", (5.0, 25.0)) is None


def test_longest_blocks():
    blocks, length = longest_blocks(np.arange(500.0))
    assert (len(blocks), length) == (15, 32)
    assert blocks[0] == pytest.approx(15.5)


def test_seeds_that_keep_to_states_of_their_own_disagree():
    assert analysis.disagreement([1.0, 2.0, 1.1], [0.05, 0.05, 0.05]) < 1e-6
    assert analysis.disagreement([1.0, 1.02, 0.97], [0.05, 0.05, 0.05]) > 0.5
    assert analysis.disagreement([1.0], [0.05]) == 1.0
    assert analysis.disagreement([1.0, 2.0], [0.05, None]) == 1.0


@pytest.mark.parametrize("seeds", [2, 3, 4, 10])
def test_disagreement_is_a_probability(seeds):
    random = np.random.default_rng(13)
    found = [analysis.disagreement(list(row), [1.0] * seeds) for row in random.standard_normal((2000, seeds))]
    # Seeds of one state give every probability as often as any other.
    assert np.quantile(found, [0.1, 0.5, 0.9]) == pytest.approx([0.1, 0.5, 0.9], abs=0.04)


def made_up_statistics(**rates: float | np.ndarray) -> dict:
    rows = 1000
    names = "drum_work dissipated_normal dissipated_sliding normal_work tangential_work"
    given = dict(zip(names.split(), (9.0, 6.0, 3.0, 6.6, 3.0), strict=True)) | rates
    random = np.random.default_rng(1)
    noisy = {n: r + 0.01 * random.standard_normal(rows) * np.ones(rows) for n, r in given.items()}
    series = run(noisy).with_columns(angular_momentum=pl.lit(0.5))
    return analysis.statistics(series, (10.0, 20.0), mass=2.0)


def test_statistics_of_a_made_up_run():
    columns = made_up_statistics()
    expected = {
        "drum_specific_power": 4.5,
        "dissipated_normal_specific_power": 3.0,
        "dissipated_sliding_specific_power": 1.5,
        "dissipation_ratio": 2.0,
        "work_ratio": 2.2,
        "specific_angular_momentum": 0.25,
    }
    assert tuple(columns) == analysis.STATISTICS
    assert {name: columns[name] for name in expected} == pytest.approx(expected, rel=1e-3)
    assert {columns[f"{name}_error"] < 1e-3 for name in expected} == {True}
    assert columns["drifting"] is False


@pytest.mark.parametrize(
    ("change", "drifts"),
    [
        ({"drum_work": np.linspace(8.0, 10.0, 1000)}, True),
        # Sure, but too little to matter.
        ({"drum_work": np.linspace(8.96, 9.04, 1000)}, False),
        ({"dissipated_normal": np.linspace(5.0, 7.0, 1000)}, True),
        # Steady in the window, but of another state than before.
        ({"dissipated_normal": np.where(np.arange(1000) < 450, 5.0, 7.0)}, True),
        # A load that rocks: next to nothing goes into normal contacts, and ever less of it.
        ({"dissipated_normal": np.linspace(0.002, 0.001, 1000)}, False),
    ],
)
def test_what_counts_as_drifting(change, drifts):
    assert made_up_statistics(**change)["drifting"] is drifts


def test_what_terms_take_counts_as_loss():
    # The share of normal damping falls only because rolling takes ever more.
    growing = np.linspace(0.0, 9.0, 1000)
    assert made_up_statistics(dissipated_rolling=growing)["share_drift"] < -0.01
    assert made_up_statistics(dissipated_rolling=growing)["dissipation_ratio"] == pytest.approx(2.0, rel=1e-3)


def test_statistics_without_friction():
    columns = made_up_statistics(dissipated_sliding=0.0 * np.ones(1000), tangential_work=0.0)
    assert columns["drifting"] is False
