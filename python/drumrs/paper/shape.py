"""`Shape`: the cross-section of a baffle, and the region of shapes that are searched for the paper's."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs.config import baseline

Array = NDArray[np.float64]

# Shapes that are searched, in m: heights as of washers' baffles and far beyond; bases from less than a bundle's radius,
# a blade whose width no longer matters, to a quarter of the drum's diameter, beyond which it is a hump; tips from 0, a
# triangle, to the base, an upright block. Wider tips would trap bundles behind them.
HEIGHTS = (0.02, 0.11)
BASES = (0.01, 0.12)
# Figure 3(c) shows a load of 75 % fill among the baffles. What is left to it then is packed as densely as discs that
# move can be where three baffles take 6 % of the drum, and it does not fit where they take 7 %.
ROOM = 0.06
_BAFFLES = 3
RADIUS = 0.5 * baseline().drum.diameter


@dataclass(frozen=True, order=True)
class Shape:
    """A baffle symmetric about its axis, its two base corners on the rim.

    Attributes
    ----------
    height
        Distance of the tip from the rim [m].
    base
        Distance of the two base corners [m].
    tip
        Distance of the two tip corners [m]; 0 for a triangle.

    Examples
    --------
    >>> from drumrs.paper.shape import Shape
    >>> paddle = Shape(0.035, 0.08, 0.05)
    >>> str(paddle), round(paddle.share_of_drum, 3)
    ('3.5 / 8 / 5 cm', 0.038)
    """

    height: float
    base: float
    tip: float

    def __str__(self) -> str:
        """Give height, base and tip in cm."""
        return " / ".join(f"{100.0 * length:.4g}" for length in self.lengths) + " cm"

    @property
    def lengths(self) -> tuple[float, float, float]:
        """Height, base and tip [m]."""
        return self.height, self.base, self.tip

    @property
    def keys(self) -> dict[str, Any]:
        """The keys of a configuration that make three baffles of this shape, as `Config.replace` takes them."""
        keys: dict[str, Any] = {"count": _BAFFLES, "height": self.height, "base": self.base}
        if self.tip:
            keys |= {"shape": "trapezoid", "tip": self.tip}
        else:
            keys |= {"shape": "triangle"}
        return {f"drum.baffles.{key}": value for key, value in keys.items()}

    @property
    def share_of_drum(self) -> float:
        """The part of the drum's area that three of them take."""
        return float(shares_of_drum(np.array([self.lengths]))[0])


# The shape assumed before anything was inferred, and two that are common in washers.
TRIANGLE = Shape(0.05, 0.06, 0.0)
PADDLE = Shape(0.035, 0.08, 0.05)
BLOCK = Shape(0.035, 0.05, 0.05)
# What the paper's sentences say it was, as far as they do: docs/study/baffle.md.
INFERRED = Shape(0.04, 0.02, 0.0)
MARKED = {"assumed triangle": TRIANGLE, "washer paddle": PADDLE, "block": BLOCK}


def shares_of_drum(shapes: Array) -> Array:
    """Return the part of the drum's area that three baffles take, for rows of height, base and tip [m]."""
    height, base, tip = shapes.T
    foot = np.sqrt(RADIUS**2 - 0.25 * base**2)
    between_chord_and_rim = RADIUS**2 * np.arcsin(0.5 * base / RADIUS) - 0.5 * base * foot
    trapezoid = 0.5 * (base + tip) * (height - (RADIUS - foot))
    area: Array = _BAFFLES * (trapezoid + between_chord_and_rim) / (math.pi * RADIUS**2)
    return area


def shapes_in_region(count: int, seed: int = 1) -> Array:
    """Return shapes spread evenly over the region, rows of height, base and tip [m]: a Sobol sequence.

    Examples
    --------
    >>> from drumrs.paper.shape import ROOM, shapes_in_region, shares_of_drum
    >>> shapes = shapes_in_region(100)
    >>> shapes.shape, bool((shares_of_drum(shapes) <= ROOM).all())
    ((100, 3), True)
    """
    from scipy.stats import qmc

    sampler = qmc.Sobol(3, rng=seed)
    found = np.zeros((0, 3))
    while len(found) < count:
        low, high = (HEIGHTS[0], BASES[0], 0.0), (HEIGHTS[1], BASES[1], BASES[1])
        cube = qmc.scale(sampler.random(2 ** math.ceil(math.log2(8 * count))), low, high)
        inside = (cube[:, 2] <= cube[:, 1]) & (shares_of_drum(cube) <= ROOM)
        found = np.concatenate([found, cube[inside]])
    return found[:count]
