"""The bed of a load at rest: how much of the drum it takes, voids counted."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.frames import Frames


def bulk_fill(frames: "Frames", index: int = -1) -> float:
    """Return the area of the bed, voids counted, over the drum's: the J of mills, what ``load.bulk_fill`` asks for.

    The bed is taken for the circular segment whose center of area is where that of the bundles is, at whatever slope:
    in a drum of radius R that of a segment of half-angle Θ is at (2/3) R sin³Θ/(Θ − sin Θ cos Θ) from the axis, and its
    area over the drum's is (Θ − sin Θ cos Θ)/π. It holds for a bed with a straight surface in a drum whose baffles are
    small beside it. The fill over it is the solid fraction of the bed.

    Parameters
    ----------
    frames
        Frames of a run.
    index
        Which of them; the last unless given.

    Raises
    ------
    ConfigError
        Where the drum has no rim.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import bulk_fill
    >>> changes = {"rotation.rpm": 0.0, "load.bulk_fill": 0.3}
    >>> simulation = drumrs.Simulation(drumrs.baseline().replace(changes).softer(100.0))
    >>> simulation.run(duration=0.6)
    >>> 0.27 < bulk_fill(simulation.frames) < 0.33
    True
    """
    from scipy.optimize import brentq

    if frames.drum_radius is None:
        raise ConfigError("drum.rim", False, "true: a bed without a rim fills nothing")
    center = np.average(frames.positions[index], axis=0, weights=frames.radii**2)
    distance = float(np.hypot(*center)) / frames.drum_radius

    def excess(half_angle: float) -> float:
        return 2.0 / 3.0 * math.sin(half_angle) ** 3 / _area(half_angle) - distance

    # A segment's center is at the rim where it is empty, and on the axis where it is the drum.
    return _area(brentq(excess, 1e-3, math.pi)) / math.pi


def _area(half_angle: float) -> float:
    """Return the area of a segment of the unit circle."""
    return half_angle - math.sin(half_angle) * math.cos(half_angle)
