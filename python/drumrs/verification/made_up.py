"""Frames that nobody simulated: loads of which every measure is known beforehand."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import Frames

Array = NDArray[np.float64]

# Radius of the drum, and time between frames, of made-up loads.
DRUM_RADIUS, INTERVAL = 1.0, 0.01


def frames(positions: ArrayLike, radii: ArrayLike, **others: Any) -> Frames:
    """Return frames of these positions, of shape (frames, n, 2) [m], in a round drum of radius 1 m.

    The drum turns counter-clockwise at 1 rad/s, the discs are at rest and touch nothing, unless given otherwise.
    """
    places: Any = np.asarray(positions, dtype=np.float64)
    shape, times = places.shape[:2], INTERVAL * np.arange(len(places))
    made: dict[str, Any] = {
        "times": times,
        "drum_angles": times,
        "positions": places,
        "angles": np.zeros(shape),
        "velocities": np.zeros_like(places),
        "contacts": np.zeros(shape, dtype=np.uint16),
        "radii": np.broadcast_to(np.asarray(radii, dtype=np.float64), shape[1]).copy(),
        "drum_radius": DRUM_RADIUS,
    }
    return Frames(**{**made, **others})


def lattice(radius: float, draws: np.random.Generator | None = None) -> Array:
    """Return the centers of discs in a hexagonal packing all over the drum, turned and moved at random if asked to."""
    across = np.arange(-2.0 * DRUM_RADIUS, 2.0 * DRUM_RADIUS, 2.0 * radius)
    up = np.arange(-2.0 * DRUM_RADIUS, 2.0 * DRUM_RADIUS, math.sqrt(3.0) * radius)
    x, y = np.meshgrid(across, up)
    x = x + radius * (np.arange(len(up)) % 2)[:, np.newaxis]
    points: Array = np.stack([x, y], axis=-1).reshape(-1, 2)
    if draws is not None:
        points = points @ turned(draws.uniform(0.0, math.tau)) + draws.uniform(-radius, radius, 2)
    inside: Array = points[np.hypot(*points.T) < DRUM_RADIUS - radius]
    return inside


def segment(half_angle: float, slope: float, radius: float, count: int = 16) -> Frames:
    """Return frames of a packing, each turned and moved at random, that fills a segment of the drum.

    Parameters
    ----------
    half_angle
        Half of the angle that the segment spans, as seen from the axis [rad].
    slope
        Slope of its surface [rad].
    radius
        Radius of the discs [m].
    count
        Number of frames.
    """
    draws = np.random.default_rng(1)
    level = -DRUM_RADIUS * math.cos(half_angle)
    up = np.array([-math.sin(slope), math.cos(slope)])
    loads = [points[points @ up < level] for points in (lattice(radius, draws) for _ in range(count))]
    least = min(map(len, loads))
    return frames([draws.permutation(load)[:least] for load in loads], radius)


def turned(angle: float) -> Array:
    """Return the matrix that turns rows of points by an angle, counter-clockwise."""
    return np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
