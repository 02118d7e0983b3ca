"""Colorings of the discs, by where they start or by species, and the square cells in which colors are counted."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.frames import Frames

Colors = NDArray[np.bool_]

# How the discs of a frame may be colored, beside the names of species.
COLORINGS = ("side", "layer", "depth")
# Discs in the median cell, unless its side is given.
_PER_CELL = 10


def coloring(frames: "Frames", by: str, index: int = 0) -> Colors:
    """Return which discs are colored.

    Parameters
    ----------
    frames
        Frames of a run.
    by
        ``"side"``: right of the median; ``"layer"``: above it; ``"depth"``: nearer to the axis; or a species.
    index
        The frame whose places are meant.

    Raises
    ------
    ConfigError
        Where it is none of these, or no disc or every disc would be colored.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import coloring
    >>> frames = drumrs.run(drumrs.baseline().replace({"run.duration": 0.1}), progress=False).frames
    >>> colors = coloring(frames, "side")
    >>> int(colors.sum()), len(colors)
    (50, 100)
    """
    x, y = frames.positions[index].astype(np.float64).T
    values = {"side": x, "layer": y, "depth": -np.hypot(x, y)}
    if by in values:
        colors: Colors = values[by] > np.median(values[by])
    else:
        colors = np.array([name == by for name in frames.species], dtype=bool)
    if len(set(colors.tolist())) <= 1:
        names = ", ".join([*COLORINGS, *sorted(set(frames.species))])
        raise ConfigError("by", by, f"a coloring that leaves some discs uncolored: one of {names}")
    return colors


def cell_side(points: ArrayLike, per_cell: float = _PER_CELL) -> float:
    """Return the side of square cells [m] of which the median one, discs counted, holds about so many discs.

    Parameters
    ----------
    points
        Centers of the discs [m], shape (n, 2).
    per_cell
        How many.
    """
    places = np.asarray(points, dtype=np.float64)
    low, high = 0.0, float(np.ptp(places, axis=0).max())
    for _ in range(30):
        side = 0.5 * (low + high)
        cells = cells_of(places, side)
        crowd = float(np.median(np.bincount(cells)[cells]))
        low, high = (side, high) if crowd < per_cell else (low, side)
    return high


def cells_of(points: Array, side: float) -> NDArray[np.intp]:
    """Return the number of the square cell that each place lies in, from 0 on without gaps; one corner is the axis."""
    corners = np.floor(points / side).astype(np.int64)
    numbers: NDArray[np.intp] = np.unique(corners, axis=0, return_inverse=True)[1].ravel()
    return numbers
