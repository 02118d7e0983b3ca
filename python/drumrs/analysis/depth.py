"""Motion relative to the turning drum, by depth below the load's free surface."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis.blocks import Array, Mean, block_error
from drumrs.analysis.seen import distances, within

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Edges of the layers, in diameters.
_LAYERS = (0.0, 1.5, 3.0, np.inf)
# Pairs of frames that are plenty for a mean.
_PLENTY = 50
# Points along a radius of the grid on which the empty part of the drum is found.
_FINENESS = 30


def depth_profile(
    frames: "Frames", window: tuple[float, float], layers: Sequence[float] = _LAYERS
) -> tuple[Mean | None, ...]:
    """Return the mean speed relative to the turning drum, by depth below the free surface.

    The free surface bounds the places where one more bundle would fit. Depth is the distance of a bundle's center
    from the nearest such place, in diameters beyond the first: 0 for who lies or flies at the surface.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    layers
        Edges of the layers, in diameters.

    Returns
    -------
    tuple
        Speed over the rim's, one a layer; `None` for a layer without bundles, or where the drum rests.
    """
    seen = within(frames, window)
    radius, count = frames.drum_radius, len(layers) - 1
    if seen.turned == 0.0 or radius is None:
        return (None,) * count
    places, diameter = _places(frames, radius), 2.0 * float(frames.radii.mean())
    every = max(1, (len(seen.positions) - 1) // _PLENTY)
    sums, counts = [], []
    # Seen from the drum, where baffles stand still.
    for before, after, angle in seen.pairs_from_the_drum(every):
        speeds = np.linalg.norm(after - before, axis=1) / (radius * abs(angle))
        layer = np.digitize(_depths(before, places, diameter), layers[1:-1])
        sums.append(np.bincount(layer, weights=speeds, minlength=count))
        counts.append(np.bincount(layer, minlength=count))
    totals = np.array(sums).T, np.array(counts, dtype=np.float64).T
    return tuple(_ratio(s, n, every * seen.interval) for s, n in zip(*totals, strict=True))


def _depths(points: Array, places: Array, diameter: float) -> Array:
    """Return depths below the free surface in diameters, infinite where nothing more would fit."""
    empty = places[distances(places, points).min(axis=1) > diameter]
    if not len(empty):
        return np.full(len(points), np.inf)
    depths: Array = np.maximum(distances(points, empty).min(axis=1) / diameter - 1.0, 0.0)
    return depths


def _ratio(sums: Array, counts: Array, interval: float) -> Mean | None:
    if not counts.sum():
        return None
    ratio = float(sums.sum() / counts.sum())
    spread = block_error(sums - ratio * counts, interval)
    return Mean(ratio, spread.error / float(counts.mean()) if spread is not None else None)


def _places(frames: "Frames", radius: float) -> Array:
    """Return a square grid of where a bundle's center can be in an empty drum, in the drum's own frame."""
    line = np.linspace(-radius, radius, 2 * _FINENESS + 1)
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    room = float(frames.radii.mean())
    free = np.hypot(*points.T) < radius - room
    for baffle in frames.baffles:
        free &= ~_is_inside(points, baffle) & (_distance_to_outline(points, baffle) > room)
    chosen: Array = points[free]
    return chosen


def _sides(outline: Array) -> tuple[Array, Array]:
    """Return where the sides of a closed outline start, and how they run."""
    return outline, np.roll(outline, -1, axis=0) - outline


def _is_inside(points: Array, outline: Array) -> NDArray[np.bool_]:
    """Tell which points lie within a polygon: those from which a ray crosses its outline an odd number of times."""
    starts, runs = _sides(outline)
    height = points[:, np.newaxis, 1] - starts[:, 1]
    passes = (height >= 0.0) != (height >= runs[:, 1])
    across = (points[:, np.newaxis, 0] - starts[:, 0]) * runs[:, 1] - height * runs[:, 0]
    crossings = passes & ((across < 0.0) == (runs[:, 1] > 0.0))
    inside: NDArray[np.bool_] = crossings.sum(axis=1) % 2 == 1
    return inside


def _distance_to_outline(points: Array, outline: Array) -> Array:
    starts, runs = _sides(outline)
    lengths = np.maximum((runs**2).sum(axis=1), np.finfo(float).tiny)
    from_start = points[:, np.newaxis] - starts
    along = np.clip((from_start * runs).sum(axis=2) / lengths, 0.0, 1.0)
    nearest: Array = np.linalg.norm(from_start - along[..., np.newaxis] * runs, axis=2).min(axis=1)
    return nearest
