"""Measures of motion, on made-up loads: rings that centrifuge, loads at rest, gases, flowing layers."""

import math

import numpy as np
import pytest

from drumrs import measures
from drumrs.errors import ConfigError
from drumrs.frames import Frames
from drumrs.measures import depth, neighbors

RADIUS, DIAMETER = 1.0, 0.1
TIMES = 0.04 * np.arange(151)
OMEGA = 5.0
WINDOW = (0.0, 6.0)
# Five whole turns in the window.
TURNING = 10.0 * math.pi / 6.0


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def made_up(positions: np.ndarray, omega: float = OMEGA) -> Frames:
    frames, count = positions.shape[:2]
    return Frames(
        times=TIMES[:frames],
        drum_angles=omega * TIMES[:frames],
        positions=positions.astype(np.float32),
        angles=np.zeros((frames, count), dtype=np.float32),
        velocities=np.zeros((frames, count, 2), dtype=np.float32),
        contacts=np.zeros((frames, count), dtype=np.uint16),
        radii=np.full(count, DIAMETER / 2.0),
        drum_radius=RADIUS,
    )


def ring(count: int, radius: float) -> np.ndarray:
    angles = 2.0 * math.pi * np.arange(count) / count
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def bed() -> np.ndarray:
    """Return a square packing that fills the lower half of the drum."""
    line = np.arange(-0.95, 0.96, DIAMETER)
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    return points[(np.hypot(*points.T) < RADIUS - DIAMETER / 2.0) & (points[:, 1] < 0.0)]


def moving(start: np.ndarray, omega: float = OMEGA) -> np.ndarray:
    return np.stack([turned(start, omega * time) for time in TIMES])


def rider(start: np.ndarray, omega: float = TURNING) -> Frames:
    """Return a load that turns at the drum's angular velocity, or not at all, five whole turns long."""
    return made_up(moving(start, omega), omega)


def annulus(fill: float, size_ratio: float) -> np.ndarray:
    """Return a square packing between the rim and the circle that leaves room for such a fill."""
    line = np.arange(-1.0, 1.0, 2.0 * RADIUS / size_ratio) + 0.3 / size_ratio
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    distance = np.hypot(*points.T)
    return points[(distance < RADIUS) & (distance > RADIUS * math.sqrt(1.0 - fill))]


@pytest.mark.parametrize("omega", [TURNING, -TURNING])
@pytest.mark.parametrize("fill", [0.1, 0.25, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("size_ratio", [10, 40])
def test_a_load_that_rides_whole_is_carried_round_at_any_fill_and_size(fill, size_ratio, omega):
    assert measures.carried_round(rider(annulus(fill, size_ratio), omega), WINDOW).value == pytest.approx(1.0)


@pytest.mark.parametrize("speed", [0.0, 0.5, 1.5])
def test_half_a_load_that_rides_counts_half(speed):
    # The other half rests, or slides at half or one and a half of the drum's speed.
    halves = [moving(annulus(0.5, 20), TURNING), moving(annulus(0.5, 20), speed * TURNING)]
    frames = made_up(np.concatenate(halves, axis=1), TURNING)
    assert measures.carried_round(frames, WINDOW).value == pytest.approx(0.5)


def test_a_load_at_rest_in_a_turning_drum_is_not_carried_round():
    assert measures.carried_round(made_up(moving(bed(), 0.0)), WINDOW).value == 0.0
    assert measures.carried_round(made_up(moving(bed(), 0.0), 0.0), WINDOW) is None


def test_a_load_that_rocks_below_the_axis_is_not_carried_round():
    # Rides up by 80° and slides back.
    start, swing = np.array([[0.0, -0.95], [0.0, -0.3]]), np.minimum(TURNING * TIMES % 2.8, 1.4)
    assert measures.carried_round(made_up(np.stack([turned(start, a) for a in swing])), WINDOW).value == 0.0


def test_time_along_the_rim_is_that_of_the_outer_layers_that_ride():
    # Of three bundles one rides at the rim, one turns as fast near the axis, and one rests at the rim.
    rim, inner = np.array([[0.95, 0.0]]), np.array([[0.3, 0.0]])
    resting = np.broadcast_to(-rim, (len(TIMES), 1, 2))
    paths = np.concatenate([moving(rim), moving(inner), resting], axis=1)
    assert measures.along_the_rim(made_up(paths), WINDOW).value == pytest.approx(1.0 / 3.0)
    assert measures.along_the_rim(made_up(paths, omega=0.0), WINDOW) is None


def test_a_passage_counts_once_and_in_the_sense_of_rotation_only():
    top = np.array([[0.0, 0.95]])
    # An eighth of a turn to either side of the top, five frames each.
    angles = np.linspace(-math.pi / 4.0, math.pi / 4.0, 11) + 0.01
    for sense in (1.0, -1.0):
        frames = made_up(
            np.stack([turned(top, sense * a) for a in angles]), sense * math.pi / 20.0 / TIMES[1]
        )
        assert measures.carried_round(frames, WINDOW).value == pytest.approx(4.0)
        back = made_up(frames.positions[::-1].copy(), sense * math.pi / 20.0 / TIMES[1])
        assert measures.carried_round(back, WINDOW).value == 0.0


@pytest.mark.parametrize("speed", [0.5, 0.75, 1.25, 1.5])
def test_what_slips_is_not_carried(speed):
    frames = made_up(moving(ring(40, 0.95), speed * OMEGA))
    assert measures.carried_round(frames, WINDOW).value == 0.0


@pytest.mark.parametrize("froude", [0.5, 0.9, 1.0])
def test_what_is_thrown_over_the_axis_is_not_carried(froude):
    """A parabola whose vertex lies above the axis, where it has the drum's angular velocity."""
    height, gravity = 0.8, 9.81
    omega = math.sqrt(froude * gravity / height)
    times = TIMES[:21] - TIMES[10] + 0.001
    path = np.column_stack([-omega * height * times, height - 0.5 * gravity * times**2])
    frames = made_up(path[:, np.newaxis, :], omega)
    assert measures.carried_round(frames, (0.0, TIMES[20])).value == 0.0


def test_what_flies_over_the_axis_is_not_carried():
    # Straight through the line above the axis, at the drum's angular velocity when it passes.
    x = 0.5 * OMEGA * (0.7 - TIMES % 1.4)
    path = np.stack([np.column_stack([np.full(5, at), np.full(5, 0.5)]) for at in x])
    assert measures.carried_round(made_up(path), WINDOW).value == 0.0


def test_a_rigid_body_does_not_mix():
    turns, index = measures.mixing(made_up(moving(bed())), WINDOW)
    assert turns[-1] == pytest.approx(1.0, abs=0.02)
    assert np.abs(index).max() < 1e-5
    assert measures.mixed_in_a_turn(made_up(moving(bed())), WINDOW).value == pytest.approx(0.0, abs=1e-5)


def test_a_shuffled_load_is_mixed_at_once():
    random = np.random.default_rng(2)
    start = bed()
    frames = made_up(np.stack([random.permutation(start) for _ in TIMES]))
    _, index = measures.mixing(frames, WINDOW)
    assert index[:, 0] == pytest.approx(0.0)
    assert index[:, 1:].mean() == pytest.approx(1.0, abs=0.02)


def test_mixing_grows_with_disorder():
    random = np.random.default_rng(4)
    found = []
    for stride in (0.0, 0.01, 0.03):
        steps = stride * random.standard_normal((len(TIMES), 60, 2))
        walk = ring(60, 0.5) + np.cumsum(steps, axis=0)
        found.append(measures.mixed_in_a_turn(made_up(walk), WINDOW).value)
    assert found[0] < 0.01 < found[1] < found[2]


def test_distances_of_many_bundles_are_taken_in_parts():
    # More points than rows of the matrix that are held at a time, on a line with known distances.
    count = 3 * neighbors._ROWS // 2
    line = np.column_stack([np.arange(float(count)), np.zeros(count)])
    assert neighbors._mean_distance(line) == pytest.approx((count + 1) / 3.0)
    order = np.random.default_rng(6).permutation(count)
    steps = np.abs(line[order][neighbors._nearest(line[order]), 0] - line[order, 0])
    assert (steps == 1.0).all()


def test_mixing_needs_a_turn():
    frames = made_up(moving(bed()))
    assert measures.mixed_in_a_turn(frames, (0.0, 1.0)) is None
    assert measures.mixed_in_a_turn(made_up(moving(bed(), 0.0), 0.0), WINDOW) is None


def test_depth_profile_of_a_flowing_layer():
    start = bed()
    flowing = start[:, 1] > -0.1
    # Turns with the drum, but for the uppermost layer, which slides by 0.2 of the rim's speed: pairs of frames, each
    # from the same start.
    path = np.empty((2, *start.shape))
    path[0] = start
    path[1] = turned(start, OMEGA * TIMES[1])
    path[1, flowing, 0] -= 0.2 * RADIUS * OMEGA * TIMES[1]
    surface, middle, deep = measures.depth_profile(made_up(path), (0.0, 0.04), (0.0, 0.75, 3.0, np.inf))
    assert surface.value == pytest.approx(0.2, abs=0.005)
    assert middle.value < 1e-5
    assert deep.value < 1e-5
    assert surface.error is None


def test_depth_profile_without_a_surface():
    alone = made_up(moving(ring(3, 0.95)), 0.0)
    assert measures.depth_profile(alone, WINDOW) == (None, None, None)
    line = np.arange(-1.0, 1.01, 0.08)
    full = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    surface, middle, deep = measures.depth_profile(made_up(moving(full)), WINDOW)
    # Nothing is empty in a full drum: all of it is deep.
    assert surface is None
    assert middle is None
    assert deep.value == pytest.approx(0.0, abs=1e-5)


def test_window_without_frames():
    with pytest.raises(ConfigError, match="at least two frames"):
        measures.carried_round(made_up(moving(bed())), (7.0, 8.0))


def test_a_bundle_finds_room_beside_baffles_and_walls_only():
    baffle = np.array([[0.0, -0.95], [0.25, -0.95], [0.12, -0.6]])
    wall = np.array([[0.4, 0.0], [0.8, 0.0]])
    frames = made_up(moving(bed()))
    bare = depth._places(frames, RADIUS)
    places = depth._places(Frames(**{**vars(frames), "baffles": (baffle,), "walls": (wall,)}), RADIUS)
    taken = {tuple(place) for place in bare} - {tuple(place) for place in places}
    # Within a radius of the wall, or of the triangle, or inside of that.
    assert all((y > -0.05) if x > 0.34 else (y < -0.5) for x, y in taken)
    assert (np.hypot(*(places - wall[1]).T) > 0.0).all()
    near_the_wall = (np.abs(bare[:, 1]) <= 0.05) & (bare[:, 0] >= 0.4) & (bare[:, 0] <= 0.8)
    inside = (bare[:, 1] > -0.95) & (bare[:, 1] < -0.7) & (np.abs(bare[:, 0] - 0.12) < 0.03)
    assert near_the_wall.sum() > 10
    assert inside.sum() > 3
    assert all(tuple(place) in taken for place in bare[near_the_wall | inside])
