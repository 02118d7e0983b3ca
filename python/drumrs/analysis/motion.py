"""How the bundles move: carried round the rim, and mixed."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis.blocks import Array, Mean, block_error
from drumrs.analysis.seen import distances, within

if TYPE_CHECKING:
    from drumrs.frames import Frames

# The layer at the rim, in diameters from the wall to a bundle's center.
_LAYER = 1.5
# An angular velocity this near that of the drum, as a share of it, is that of a bundle carried along.
_NEAR = 0.2


def carried_round(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return how often a bundle is carried over the top along the rim, in a turn of the drum.

    Counted is what passes the line from the axis straight up within one and a half diameters of the wall and at the
    drum's angular velocity, to 20 %. 1 is a load that centrifuges whole, 0 one that falls before it gets there.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn.
    """
    seen = within(frames, window)
    if seen.turned == 0.0 or frames.drum_radius is None:
        return None
    reach = frames.drum_radius - 2.0 * _LAYER * frames.radii
    passages = [_passages(*pair, reach) / frames.count for pair in seen.pairs()]
    per_turn = np.array(passages) * len(passages) / seen.turns
    return _mean(per_turn, seen.interval)


def along_the_rim(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the share of the time that a bundle rides along the rim.

    Riding is to be within one and a half diameters of the wall and at the drum's angular velocity, to 20 %, as for
    `carried_round`, wherever that is.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn.
    """
    seen = within(frames, window)
    if seen.turned == 0.0 or frames.drum_radius is None:
        return None
    reach = frames.drum_radius - 2.0 * _LAYER * frames.radii
    return _mean(np.array([_rides(*pair, reach).mean() for pair in seen.pairs()]), seen.interval)


def _passages(before: Array, after: Array, angle: float, reach: Array) -> int:
    """Count the bundles carried over the top between two frames."""
    # Angle still to go to the top, in the sense of rotation.
    ahead = np.sign(angle) * (np.pi / 2.0 - np.arctan2(before[:, 1], before[:, 0])) % (2.0 * np.pi)
    return int((_rides(before, after, angle, reach) & (ahead < np.abs(_swept(before, after)))).sum())


def _rides(before: Array, after: Array, angle: float, reach: Array) -> NDArray[np.bool_]:
    """Tell which bundles go with the drum between two frames, beyond a distance from its axis."""
    carried = np.abs(_swept(before, after) - angle) <= _NEAR * abs(angle)
    outside: NDArray[np.bool_] = np.hypot(*before.T) >= reach
    return carried & outside


def mixing(frames: "Frames", window: tuple[float, float], turns: float = 1.0) -> tuple[Array, Array]:
    """Return how far neighbors have parted after so many turns of the drum.

    Nearest neighbors are noted at a moment. Their mean distance, from what it was towards that of any two
    bundles, is the index: 0 at first, 1 where neighbors are no nearer than others (the neighbor-distance method
    of Godlieb, Deen & Kuipers, Characterizing solids mixing in DEM simulations, 2007). Turning as a rigid body
    leaves it at 0, and neither a grid nor a coloring enters.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    turns
        How long to follow neighbors, in turns of the drum.

    Returns
    -------
    turns, index
        Turns of the drum since the moment, shape (k,), and the index for every frame of the window that is followed
        so long, shape (moments, k); no moments where the window is shorter than that, or the drum rests.
    """
    seen = within(frames, window)
    positions, last = seen.positions, len(seen.positions) - 1
    span = round(turns * last / seen.turns) if seen.turns else last + 1
    passed = np.arange(span + 1) * seen.turns / last
    if span > last or frames.count <= 1:
        return passed, np.zeros((0, span + 1))
    apart = np.array([_mean_distance(points) for points in positions])
    index = np.empty((last - span + 1, span + 1))
    for moment, row in enumerate(index):
        path, mates = positions[moment : moment + span + 1], _nearest(positions[moment])
        distance = np.linalg.norm(path - path[:, mates], axis=2).mean(axis=1)
        row[:] = (distance - distance[0]) / (apart[moment : moment + span + 1] - distance[0])
    return passed, index


def mixed_in_a_turn(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the index of `mixing` after one turn of the drum.

    Returns
    -------
    Mean or None
        `None` where the window is shorter than a turn, or the drum rests.
    """
    _, index = mixing(frames, window)
    return _mean(index[:, -1], within(frames, window).interval) if len(index) else None


def _mean(values: Array, interval: float) -> Mean:
    spread = block_error(values, interval)
    return Mean(float(values.mean()), spread.error if spread is not None else None)


def _nearest(points: Array) -> NDArray[np.intp]:
    apart = distances(points, points)
    np.fill_diagonal(apart, np.inf)
    nearest: NDArray[np.intp] = apart.argmin(axis=1)
    return nearest


def _mean_distance(points: Array) -> float:
    count = len(points)
    return float(distances(points, points).sum()) / (count * (count - 1))


def _swept(before: Array, after: Array) -> Array:
    """Return the angles about the axis by which bundles went, within ±π."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angles: Array = np.arctan2(cross, (before * after).sum(axis=1))
    return angles
