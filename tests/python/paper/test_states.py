"""The two states of a load about half full: made-up histories whose states, residence times and powers are known."""

import numpy as np
import polars as pl
import pytest

from drumrs import baseline
from drumrs.paper import plots
from drumrs.paper.states import Turning, is_ring, of_runs
from drumrs.paper.verdict import MissingError

CONFIG = baseline(0.5).replace({"run.duration": 120.0})
STEP = 0.02
LEVELS = (0.3, 0.5)
POWERS = (3.0, 2.0)
RATIOS = (1.5, 2.5)


def history(*stays: tuple[bool, float], noise: float = 0.0, seed: int = 1) -> pl.DataFrame:
    """Return the series of a load that is a ring or not for so many seconds at a time."""
    states = np.concatenate([np.full(round(seconds / STEP), int(ring)) for ring, seconds in stays])
    derived = CONFIG.derived
    scale = derived.load_mass * derived.angular_velocity * (CONFIG.drum.diameter / 2.0) ** 2
    level = np.array(LEVELS)[states] + noise * np.random.default_rng(seed).normal(size=len(states))
    times = STEP * np.arange(len(states))
    work = np.cumsum(np.array(POWERS)[states] * STEP) * derived.load_mass
    return pl.DataFrame(
        {
            "time": times,
            "angular_momentum": level * scale,
            "drum_work": work,
            "gross_work_normal": np.cumsum(np.array(RATIOS)[states] * STEP),
            "gross_work_tangential": times,
        }
    )


def turning(*stays: tuple[bool, float], **noise: float) -> Turning:
    return Turning.of(history(*stays, **noise), CONFIG)


def test_between_the_levels_a_load_stays_what_it_was():
    rising = np.array([0.3, 0.42, 0.44, 0.45, 0.5, 0.38, 0.36, 0.42])
    assert is_ring(rising, 0.3, 0.5).tolist() == [False, False, True, True, True, True, False, False]
    assert is_ring(np.array([0.41, 0.41]), 0.3, 0.5).all()
    assert not is_ring(np.array([0.39, 0.39]), 0.3, 0.5).any()


def test_residence_times_power_and_ratio_are_those_of_the_history():
    runs = [
        turning((False, 30.0), (True, 40.0), (False, 20.0), (True, 30.0)),
        turning((True, 60.0), (False, 60.0)),
    ]
    found = of_runs(0.5, runs, *LEVELS)
    # Of each run the first 5 s and half a turn, and half a turn at its end, are left out.
    settled = 5.0 + 2.0 * np.pi / CONFIG.derived.angular_velocity
    assert found.ring.time + found.circulating.time == pytest.approx(2.0 * 120.0 - 2.0 * settled, abs=0.5)
    assert found.share == pytest.approx(130.0 / 240.0, abs=0.02)
    assert (found.ring.passages, found.circulating.passages) == (2, 2)
    assert found.ring.residence == pytest.approx(found.ring.time / 2.0)
    assert found.circulating.residence == pytest.approx(110.0 / 2.0, rel=0.1)
    # The mean over a turn takes a third of a turn to pass from one level to the next.
    assert found.circulating.power.mean == pytest.approx(POWERS[0], abs=0.02)
    assert found.ring.power.mean == pytest.approx(POWERS[1], abs=0.02)
    assert found.circulating.ratio.mean == pytest.approx(RATIOS[0], abs=0.02)
    assert found.ring.ratio.mean == pytest.approx(RATIOS[1], abs=0.02)


def test_noise_from_sample_to_sample_makes_no_passages():
    run = turning((False, 60.0), (True, 60.0), noise=0.2)
    found = of_runs(0.5, [run], *LEVELS)
    assert (found.ring.passages, found.circulating.passages) == (0, 1)
    assert found.ring.residence is None


def test_a_state_that_no_run_was_in_is_none():
    found = of_runs(0.45, [turning((False, 80.0)), turning((False, 80.0))], *LEVELS)
    assert found.ring is None
    assert found.share == 0.0
    assert np.isfinite(found.circulating.power.error)


def test_the_error_is_how_runs_differ():
    runs = [turning((True, 120.0)) for _ in range(3)]
    alike = of_runs(0.55, runs, *LEVELS).ring.power
    assert alike.error == pytest.approx(0.0, abs=1e-9)
    assert alike.freedom == 2
    other = Turning(
        *(getattr(runs[0], name) for name in ("times", "momentum")), 1.5 * runs[0].work, *[runs[0].normal] * 2
    )
    assert of_runs(0.55, [*runs, other], *LEVELS).ring.power.error == pytest.approx(0.25, rel=0.01)


def test_short_runs_are_missing():
    with pytest.raises(MissingError, match=r"runs of 60 s and more at 50 % fill"):
        Turning.of(history((True, 30.0)), CONFIG.replace({"run.duration": 30.0, "run.window": None}))


def test_the_figure_shows_each_fill_and_each_state():
    states = [
        of_runs(0.45, [turning((False, 60.0)), turning((False, 60.0))], *LEVELS),
        of_runs(0.50, [turning((False, 60.0), (True, 60.0))], *LEVELS),
        of_runs(0.55, [turning((True, 60.0)), turning((True, 60.0))], *LEVELS),
    ]
    figure = plots.states_over_time(states)
    assert [axes.get_title() or axes.get_title(loc="left") for axes in figure.axes[:3]] == [
        "45 % fill",
        "50 % fill",
        "55 % fill",
    ]
    share, power, _ = figure.axes[3:]
    assert share.lines[0].get_ydata()[[0, -1]].tolist() == [0.0, 100.0]
    assert [text.get_text() for text in power.get_legend().get_texts()] == ["circulating", "ring"]
