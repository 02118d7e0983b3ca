"""The shape of the charge: a drum that turns the other way, baffles, several sizes, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.measures.clearance import clearance
from drumrs.measures.frame_window import FrameWindow
from drumrs.measures.toe import toe_and_shoulder
from drumrs.verification import made_up

WINDOW = (0.0, 1.0)
TILTED = made_up.segment(1.4, 0.5, 0.03)


def test_a_drum_that_turns_clockwise_has_the_measures_of_its_mirror_image():
    flip = np.array([-1.0, 1.0])
    mirrored = replace(TILTED, positions=TILTED.positions * flip, drum_angles=-TILTED.drum_angles)
    assert measures.charge(mirrored, WINDOW) == measures.charge(TILTED, WINDOW)
    ring, other = (measures.occupancy(frames, WINDOW, bins=36) for frames in (TILTED, mirrored))
    assert np.array_equal(ring.solid_fraction, other.solid_fraction)


def test_a_charge_of_both_ways_is_refused():
    ahead, back = TILTED.drum_angles[-1] + 1.0, TILTED.drum_angles[-1] + 0.5
    angles = np.linspace(0.0, ahead, len(TILTED))
    angles[-1] = back
    with pytest.raises(ConfigError, match="one in which the drum turns one way"):
        measures.charge(replace(TILTED, drum_angles=angles), WINDOW)


def test_the_surface_is_a_radius_above_the_bed_at_its_slope():
    surface = measures.free_surface(TILTED, WINDOW)
    up = np.array([-np.sin(0.5), np.cos(0.5)])
    inner = np.abs(surface.along) < 0.5
    assert (surface.points() @ up)[inner] == pytest.approx(-np.cos(1.4) + 0.03, abs=0.015)


def test_few_frames_do_not_draw_the_ends_of_the_charge_in():
    """Discs at random at a shell that thins out over 40°: half of the filling is in the middle, seen often or not."""
    rng = np.random.default_rng(1)

    def seen(count):
        angles = rng.uniform(-120.0, 60.0, (count, 1000))
        kept = rng.uniform(0.0, 40.0, angles.shape) > angles - 20.0
        # As many discs in each frame; those that are not at the shell lie deeper, about the same middle.
        reach, angle = np.where(kept, 0.97, 0.4), np.radians(np.where(kept, angles, -40.0))
        positions = np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=-1)[:, :30]
        found = toe_and_shoulder(FrameWindow(positions, np.arange(count), np.arange(count)), 0.1, 1.0)
        return np.degrees([found.toe, found.shoulder])

    often = seen(3000)
    assert often == pytest.approx([240.0, 40.0], abs=2.0)
    few = np.array([seen(30) for _ in range(40)])
    assert few.mean(axis=0) == pytest.approx(often, abs=2.5)


def test_area_of_baffles_is_taken_out():
    # A baffle covers the shell about the bottom, and turns with the drum.
    baffle = np.array([[-0.2, -1.0], [0.2, -1.0], [0.2, -0.8], [-0.2, -0.8]])
    still = replace(TILTED, baffles=(baffle,), drum_angles=np.zeros(len(TILTED)))
    turned = replace(TILTED, baffles=(baffle @ made_up.turned(1.0),), drum_angles=np.full(len(TILTED), -1.0))
    bare, one, other = (measures.occupancy(frames, WINDOW, bins=36) for frames in (TILTED, still, turned))
    bottom = np.abs(bare.angles - 1.5 * np.pi) < 0.15
    assert np.isnan(one.solid_fraction[0, bottom]).all()
    assert np.array_equal(bare.solid_fraction[0, ~bottom][:20], one.solid_fraction[0, ~bottom][:20])
    assert one.solid_fraction == pytest.approx(other.solid_fraction, nan_ok=True)


def test_occupancy_knows_its_error():
    # Sixteen packings drawn independently: the error is the deviation over them, over 4.
    ring = measures.occupancy(TILTED, WINDOW, bins=36)
    frames = [measures.occupancy(TILTED.picked(slice(k, k + 2)), WINDOW, bins=36) for k in range(0, 16, 2)]
    deviation = np.std([each.solid_fraction for each in frames], axis=0, ddof=1) / np.sqrt(8.0)
    bed = np.abs(ring.angles - 1.5 * np.pi - 0.5) < 1.0
    assert np.median(ring.error[0, bed] / deviation[0, bed]) == pytest.approx(1.0, abs=0.4)
    assert np.isnan(frames[0].error).all()


def test_room_counts_the_size_of_each_disc_and_baffles():
    frames = made_up.frames([[[0.0, 0.0], [0.5, 0.0]]] * 2, [0.2, 0.05], drum_angles=[0.0, np.pi / 2.0])
    points = np.array([[0.35, 0.0], [0.0, 0.9]])
    assert clearance(frames, 0, points) == pytest.approx([0.1, 0.7])
    baffled = replace(frames, baffles=(np.array([[0.8, 0.1], [1.0, 0.1], [1.0, 0.2], [0.8, 0.2]]),))
    # A quarter of a turn later the baffle is at the top, 0.1 to the left.
    assert clearance(baffled, 1, points) == pytest.approx([0.1, 0.1])


def test_a_drum_without_a_rim_is_refused():
    bare = replace(TILTED, drum_radius=None)
    for measure in (measures.charge, measures.occupancy, measures.free_surface):
        with pytest.raises(ConfigError, match=r"drum\.rim is False"):
            measure(bare, WINDOW)
