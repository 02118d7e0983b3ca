"""Flights: what is too short, too flat or cut by the window; what is hit; and no flight at all."""

from dataclasses import replace

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.verification import made_up

WINDOW = (0.0, 1.0)


def path(heights, contacts, x=0.0, knocked=()):
    """Return a disc at these heights that gravity alone makes faster, but for knocks just before some frames."""
    places = np.column_stack([np.full(len(heights), x), heights])[:, np.newaxis]
    knocks = np.isin(np.arange(len(heights)), knocked).cumsum()
    speeds = np.column_stack([0.02 * knocks, -9.81 * made_up.INTERVAL * np.arange(len(heights))])[
        :, np.newaxis
    ]
    touches = np.array(contacts, dtype=np.uint16)[:, np.newaxis]
    return made_up.frames(places, 0.01, contacts=touches, velocities=speeds)


def test_a_flight_lasts_longer_than_half_the_time_of_a_fall_by_a_diameter():
    # ½ √(2 · 0.02 / 9.81) = 0.032 s; frames come every 0.01 s.
    for frames_aloft, count in ((3, 0), (4, 1)):
        heights = np.linspace(0.0, -0.5, 8)
        table = measures.flights(path(heights, [1, *[0] * frames_aloft, *[2] * (7 - frames_aloft)]), WINDOW)
        assert len(table) == count
    assert table.select("start", "end", "start_y", "end_y").row(0) == pytest.approx(
        (0.0, 0.05, 0.0, heights[5]), rel=1e-6
    )


def test_a_knock_between_two_frames_ends_a_flight():
    heights, aloft = np.linspace(0.0, -0.5, 10), [1, *[0] * 8, 1]
    assert len(measures.flights(path(heights, aloft), WINDOW)) == 1
    # Three frames, too few, then five.
    table = measures.flights(path(heights, aloft, knocked=[4]), WINDOW)
    assert table.select("start", "end").rows() == [pytest.approx((0.03, 0.09))]


def test_what_is_knocked_about_between_coarse_frames_does_not_fly():
    # Every frame is further apart than the shortest flight is long, and by chance there is no contact in any.
    heights, aloft = np.zeros(20), [0] * 20
    frames = path(heights, aloft, knocked=range(20))
    coarse = replace(frames, times=5.0 * frames.times, velocities=5.0 * frames.velocities)
    assert measures.flight(coarse, (0.0, 2.0))["share_in_flight"].value == 0.0
    falling = path(heights, aloft)
    coarse = replace(falling, times=5.0 * falling.times, velocities=5.0 * falling.velocities)
    assert measures.flight(coarse, (0.0, 2.0))["share_in_flight"].value == 1.0


def test_a_fall_drops_by_more_than_a_diameter():
    for drop, is_fall in ((0.019, False), (0.021, True)):
        table = measures.flights(path([0.0, 0.1, 0.1, 0.1, 0.1, -drop], [1, 0, 0, 0, 0, 1]), WINDOW)
        assert table["is_fall"].to_list() == [is_fall]
        assert table["apex"][0] == pytest.approx(0.1)


def test_flights_that_the_window_cuts_count_in_the_share_alone():
    frames = path(np.linspace(0.0, -0.5, 12), [0] * 5 + [1] * 2 + [0] * 5)
    assert len(measures.flights(frames, WINDOW)) == 0
    found = measures.flight(frames, WINDOW)
    assert found["share_in_flight"].value == pytest.approx(10.0 / 12.0)
    assert found["falls_per_turn"].value == 0.0
    assert found["mean_drop"] is found["landing_on_drum"] is found["impact_toe_angle"] is None


def test_what_is_hit_is_drum_or_load():
    aloft = [1, 0, 0, 0, 0, 1]
    onto = [
        measures.flights(path(np.linspace(0.0, y, 6), aloft), WINDOW)["onto"][0] for y in (-0.9895, -0.97)
    ]
    assert onto == ["drum", "load"]


def test_turns_to_and_fro_both_count():
    heights, aloft = [0.0, 0.1, 0.1, 0.1, 0.1, -0.5], [1, 0, 0, 0, 0, 1]
    there = replace(path(heights, aloft), drum_angles=np.linspace(0.0, np.pi, 6))
    to_and_fro = replace(there, drum_angles=np.pi * np.array([0.0, 0.5, 0.5, 0.25, 0.0, 0.0]))
    rates = [measures.flight(frames, WINDOW)["falls_per_turn"].value for frames in (there, to_and_fro)]
    assert rates == pytest.approx([2.0, 2.0])


def test_a_drum_at_rest_has_no_turns():
    frames = made_up.frames(np.zeros((4, 2, 2)), 0.1, drum_angles=np.zeros(4), contacts=np.ones((4, 2)))
    found = measures.flight(frames, WINDOW)
    assert found["falls_per_turn"] is None
    assert found["share_in_flight"].value == 0.0
    assert found["head_height"] is None


def test_a_zone_that_no_disc_comes_back_to_has_no_visits():
    zone = [[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [-1.0, 0.0]]
    once = path([0.5, 0.5, -0.5, -0.5, 0.5, 0.5], [1] * 6)
    with pytest.raises(ConfigError, match="twice"):
        measures.zone_visits(once, WINDOW, zone)


def test_visits_that_the_window_cuts_do_not_count():
    zone = [[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [-1.0, 0.0]]
    # In the zone from the start, then for two frames, five, and three; the next one is cut.
    where = [1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1]
    visits = measures.zone_visits(path(np.where(where, -0.5, 0.5), [1] * len(where)), WINDOW, zone)
    assert visits.count == 3
    assert visits.residence == pytest.approx(0.01 * (2 + 5 + 3) / 3)
    assert visits.cycle == pytest.approx(0.01 * (5 + 6 + 4) / 3)
