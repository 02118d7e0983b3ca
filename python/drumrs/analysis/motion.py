"""How the bundles move: carried round by the drum, along its rim, and mixed."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis.blocks import Array, Mean, mean_with_error
from drumrs.analysis.frame_window import FrameWindow, turn_back

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Motion relative to the drum, over the motion of the drum, up to which a bundle goes with it.
_NEAR = 0.2
# The angle to either side of the top within which a bundle must go with the drum to be carried over it.
_EIGHTH_OF_A_TURN = np.pi / 4.0
# The layer at the rim, in diameters from the wall to a bundle's center.
_LAYER = 1.5
# Rows of a matrix of distances that are held at a time.
_ROWS = 512


def carried_round(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return how often a bundle is carried over the top, in a turn of the drum.

    C = P / (N τ) with N bundles and τ turns of the drum. P counts the times that a bundle passes the line from the
    axis straight up, at any distance, while it goes with the drum: from one frame to the next, within an eighth of
    a turn before and after, |Δr'| ≤ 0.2 |r| |Δφ|, where r' is its place seen from the turning drum, |r| its distance
    from the axis and Δφ the angle by which the drum turns between the two frames.

    C is 1 for a load that rides whole with the drum, at any fill and size of bundles, ½ where half of it does, and 0
    for one that never comes over the top, slides, or falls or flies there.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn; a sixteenth or less tells flight from riding best.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.analysis import carried_round
    >>> config = drumrs.baseline().replace({"run.duration": 0.1, "run.frame_every": 0.01})
    >>> frames = drumrs.run(config, progress=False).frames
    >>> carried_round(frames, window=(0.0, 0.1)).value  # the load falls to the bottom
    0.0
    """
    seen = FrameWindow.of(frames, window)
    if seen.turned == 0.0:
        return None
    pairs = list(seen.pairs())
    rides = np.array([_goes_with_the_drum(*pair) for pair in pairs])
    tops = np.array([_passes_the_top(*pair) for pair in pairs])
    reach = max(1, round(_EIGHTH_OF_A_TURN * len(pairs) / abs(seen.turned)))
    passages = [
        (tops[k] & rides[max(k - reach, 0) : k + reach + 1].all(axis=0)).mean() for k in range(len(pairs))
    ]
    return mean_with_error(np.array(passages) * len(pairs) / seen.turns, seen.interval)


def along_the_rim(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the share of the time that a bundle rides along the rim.

    Riding is to be within one and a half diameters of the wall and at the drum's angular velocity, to 20 %.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn, or has no rim.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.analysis import along_the_rim
    >>> config = drumrs.baseline().replace({"run.duration": 0.1, "run.frame_every": 0.01})
    >>> frames = drumrs.run(config, progress=False).frames
    >>> 0.0 <= along_the_rim(frames, window=(0.0, 0.1)).value <= 1.0
    True
    """
    seen = FrameWindow.of(frames, window)
    if seen.turned == 0.0 or frames.drum_radius is None:
        return None
    reach = frames.drum_radius - 2.0 * _LAYER * frames.radii
    shares = [
        (
            (np.abs(_swept(before, after) - angle) <= _NEAR * abs(angle)) & (np.hypot(*before.T) >= reach)
        ).mean()
        for before, after, angle in seen.pairs()
    ]
    return mean_with_error(shares, seen.interval)


def _goes_with_the_drum(before: Array, after: Array, angle: float) -> NDArray[np.bool_]:
    """Tell which bundles hardly move as seen from the drum, between two frames."""
    moved = np.hypot(*(after @ turn_back(angle) - before).T)
    goes: NDArray[np.bool_] = moved <= _NEAR * abs(angle) * np.hypot(*before.T)
    return goes


def _passes_the_top(before: Array, after: Array, angle: float) -> NDArray[np.bool_]:
    """Tell which bundles pass the line from the axis straight up between two frames, in the sense of rotation."""
    ahead = np.sign(angle) * (np.pi / 2.0 - np.arctan2(before[:, 1], before[:, 0])) % (2.0 * np.pi)
    passes: NDArray[np.bool_] = ahead < np.sign(angle) * _swept(before, after)
    return passes


def mixing(frames: "Frames", window: tuple[float, float], turns: float = 1.0) -> tuple[Array, Array]:
    """Return how far nearest neighbors have parted after so many turns of the drum.

    The index is M = (d − d₀) / (D − d₀), where d is the mean distance of pairs that were nearest neighbors at the
    start, d₀ what it was then, and D the mean distance of any two bundles: 0 at first, 1 where former neighbors are
    no nearer than others (the neighbor-distance method of Godlieb, Deen & Kuipers, Characterizing solids mixing in
    DEM simulations, 2007). Turning as a rigid body leaves it at 0, and neither a grid nor a coloring enters.

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
        Turns of the drum since the start, shape (k,), and the index, shape (starts, k): every frame of the window that
        is followed so long is a start. There are none where the window is shorter than that, or the drum rests.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    seen = FrameWindow.of(frames, window)
    positions, last = seen.positions, len(seen.positions) - 1
    span = round(turns * last / seen.turns) if seen.turns else last + 1
    passed = np.arange(span + 1) * seen.turns / last
    if span > last or frames.count <= 1:
        return passed, np.zeros((0, span + 1))
    apart = np.array([_mean_distance(points) for points in positions])
    index = np.empty((last - span + 1, span + 1))
    for start, row in enumerate(index):
        path, mates = positions[start : start + span + 1], _nearest(positions[start])
        distance = np.linalg.norm(path - path[:, mates], axis=2).mean(axis=1)
        row[:] = (distance - distance[0]) / (apart[start : start + span + 1] - distance[0])
    return passed, index


def mixed_in_a_turn(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the index of `mixing` after one turn of the drum.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the window is shorter than a turn, or the drum rests.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    _, index = mixing(frames, window)
    return mean_with_error(index[:, -1], FrameWindow.of(frames, window).interval) if len(index) else None


def _nearest(points: Array) -> NDArray[np.intp]:
    """Return the nearest neighbor of every point."""
    from scipy.spatial import KDTree

    # The nearest to a point is the point itself.
    _, indices = KDTree(points).query(points, k=2)
    nearest: NDArray[np.intp] = np.asarray(indices)[:, 1]
    return nearest


def _mean_distance(points: Array) -> float:
    """Return the mean distance of any two points, from a part of the matrix of distances at a time."""
    from scipy.spatial.distance import cdist

    count = len(points)
    total = sum(float(cdist(points[first : first + _ROWS], points).sum()) for first in range(0, count, _ROWS))
    return total / (count * (count - 1))


def _swept(before: Array, after: Array) -> Array:
    """Return the angles about the axis by which bundles went, within ±π."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angles: Array = np.arctan2(cross, (before * after).sum(axis=1))
    return angles
