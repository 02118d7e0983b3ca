"""What each trade is told of loads of which it is known."""

from dataclasses import replace

import numpy as np
import pytest

import drumrs
from drumrs.frames import Frames
from drumrs.registry import quantity
from drumrs.studio.trades import TRADES, Load, means_of


def bed() -> Frames:
    """Return a close bed in the lower half of a drum, in one place for two turns of 40 frames each."""
    x, y = np.meshgrid(np.arange(-0.2, 0.21, 0.02), np.arange(-0.2, -0.009, 0.02))
    places = np.column_stack([x.ravel(), y.ravel()])
    places = places[np.hypot(*places.T) < 0.22]
    times = np.arange(80) / 40.0
    shape = (len(times), len(places))
    return Frames(
        times=times,
        drum_angles=2.0 * np.pi * times,
        positions=np.broadcast_to(places, (*shape, 2)).astype(np.float32),
        angles=np.zeros(shape, np.float32),
        velocities=np.zeros((*shape, 2), np.float32),
        contacts=np.ones(shape, np.uint16),
        radii=np.full(len(places), 0.01),
        drum_radius=0.23,
    )


def turning(frames: Frames) -> Frames:
    """Return the same load as it rides whole with the drum."""
    phases = np.exp(1j * frames.drum_angles)[:, np.newaxis]
    moved = (frames.positions[..., 0] + 1j * frames.positions[..., 1]) * phases
    return replace(frames, positions=np.stack([moved.real, moved.imag], axis=-1))


def test_a_load_that_rides_with_the_drum():
    known, config = turning(bed()), drumrs.baseline(baffles=False)
    washer = means_of("washer", Load(config, known))
    assert tuple(washer) == TRADES["washer"]
    assert washer["wall_slip"].value == pytest.approx(0.0, abs=1e-6)
    assert washer["carried_round"].value == pytest.approx(1.0, abs=0.04)
    assert washer["mixed_in_a_turn"].value == pytest.approx(0.0, abs=1e-6)
    center = known.positions[0].mean(axis=0)
    assert washer["eccentricity"].value == pytest.approx(np.hypot(*center), rel=1e-5)


def test_a_load_that_stays_where_it_is():
    known, config = bed(), drumrs.baseline(baffles=False)
    assert means_of("washer", Load(config, known))["wall_slip"].value == pytest.approx(1.0)
    coater = means_of("coater", Load(config, known))
    assert tuple(coater) == TRADES["coater"]
    assert coater["center_slope"].value == pytest.approx(0.0, abs=1e-6)
    # From the rim up to half a row above the highest centers.
    assert coater["bed_depth"].value == pytest.approx(0.22, abs=0.01)
    mill = means_of("mill", Load(config, known))
    assert tuple(mill) == TRADES["mill"]
    assert mill["filling"].value == pytest.approx(0.5, abs=0.05)


def test_openness_and_curtain_of_discs_apart():
    frames = bed()
    apart = frames.positions[:, ::30]
    lone = replace(
        frames,
        positions=apart,
        **{name: getattr(frames, name)[:, ::30] for name in ("angles", "velocities", "contacts")},
        radii=frames.radii[::30],
    )
    dryer = means_of("dryer", Load(drumrs.baseline(baffles=False), lone))
    assert tuple(dryer) == TRADES["dryer"]
    close = means_of("dryer", Load(drumrs.baseline(baffles=False), frames))
    assert (dryer["openness"].value > 0.8, close["openness"].value < 0.2) == (True, True)
    # They hover, which is no flight.
    assert dryer["curtain"].value == 0.0


def test_what_takes_too_long_is_left_out_and_what_cannot_be_is_none():
    frames, config = bed(), drumrs.baseline(baffles=False)
    many = 20
    crowd = replace(
        frames,
        **{
            name: np.repeat(getattr(frames, name), many, axis=1)
            for name in ("positions", "angles", "velocities", "contacts")
        },
        radii=np.repeat(frames.radii, many),
    )
    assert "openness" not in means_of("dryer", Load(config, crowd))
    assert "mixed_in_a_turn" not in means_of("coater", Load(config, crowd))
    square = np.array([[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]])
    shell = replace(frames, drum_radius=None, shell=square[::-1])
    mill = means_of("mill", Load(config, shell))
    assert mill["toe_angle"] is mill["filling"] is None
    rest = replace(frames, drum_angles=np.zeros(len(frames)))
    for trade in TRADES:
        assert tuple(means_of(trade, Load(config, rest))) == TRADES[trade]


def test_all_of_it_is_in_the_registry():
    assert all(quantity(name).meaning for names in TRADES.values() for name in names)
