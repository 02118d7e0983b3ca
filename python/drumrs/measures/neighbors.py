"""Mixing without a coloring: how far nearest neighbors part."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis.blocks import Array, Mean, mean_with_error
from drumrs.measures.frame_window import FrameWindow

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Rows of a matrix of distances that are held at a time.
_ROWS = 512


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
