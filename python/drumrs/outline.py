"""`Outline`: a line of the drum, for exports and films."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


class Outline(NamedTuple):
    """A line of the drum.

    Attributes
    ----------
    part
        What it is: ``"rim"``, ``"shell"``, ``"baffle 1"``, ``"wall 1"`` and so on.
    points
        Its points in the drum's own frame [m], shape (k, 2); those of a closed line end where they begin.
    """

    part: str
    points: Points


def circle(radius: float, corners: int = 180) -> Points:
    """Return the corners of a regular polygon, which stands for a circle."""
    angles = np.linspace(0.0, 2.0 * np.pi, corners, endpoint=False)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def turned(points: Points, angle: float) -> Points:
    """Return points, of shape (k, 2), turned about the axis by an angle [rad].

    Examples
    --------
    >>> import numpy as np
    >>> turned(np.array([[1.0, 0.0]]), np.pi / 2).round(12).tolist()
    [[0.0, 1.0]]
    """
    cos, sin = math.cos(angle), math.sin(angle)
    moved: Points = points @ np.array([[cos, sin], [-sin, cos]])
    return moved
