"""Motion relative to the turning drum, by depth below the load's free surface."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array, Mean, ratio_of_sums
from drumrs.measures.clearance import distance_to_solids
from drumrs.measures.frame_window import FrameWindow

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

    Empty are the places where the center of one more bundle would fit. The depth of a bundle is the distance of its
    center from the nearest empty place, in diameters, less 1: 0 for a bundle that lies or flies at the surface.

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
        Speed over the rim's, one a layer; `None` for a layer without bundles, or where the drum rests or has no rim.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    seen = FrameWindow.of(frames, window)
    radius, count = frames.drum_radius, len(layers) - 1
    if seen.turned == 0.0 or radius is None:
        return (None,) * count
    places, diameter = _places(frames, radius), 2.0 * float(frames.radii.mean())
    every = max(1, (len(seen.positions) - 1) // _PLENTY)
    sums, counts = [], []
    # Seen from the drum, where baffles stand still.
    for before, after, angle in seen.pairs_from_the_drum(every):
        if not angle:
            continue  # While the drum rests, its rim has no speed to compare with.
        speeds = np.linalg.norm(after - before, axis=1) / (radius * abs(angle))
        layer = np.digitize(_depths(before, places, diameter), layers[1:-1])
        sums.append(np.bincount(layer, weights=speeds, minlength=count))
        counts.append(np.bincount(layer, minlength=count))
    if not sums:
        return (None,) * count
    return tuple(map(ratio_of_sums, np.array(sums).T, np.array(counts, dtype=np.float64).T))


def surface_energy(frames: "Frames", window: tuple[float, float]) -> Array:
    """Return the mean square of the speeds relative to the turning drum, of the bundles at the free surface.

    They are those less deep than one and a half diameters, see `depth_profile`.

    Parameters
    ----------
    frames
        Frames of a run in a drum with a rim.
    window
        Start and end [s].

    Returns
    -------
    array
        From each frame to the next [m²/s²], shape (frames − 1,); 0 where there is no surface.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    seen = FrameWindow.of(frames, window)
    places = _places(frames, frames.drum_radius or 0.0)
    diameter = 2.0 * float(frames.radii.mean())
    energies = []
    for (before, after, _), span in zip(seen.pairs_from_the_drum(), np.diff(seen.times), strict=True):
        top = _depths(before, places, diameter) < _LAYERS[1]
        squares = ((after - before)[top] ** 2).sum(axis=1)
        energies.append(squares.mean() / span**2 if len(squares) else 0.0)
    return np.array(energies)


def _depths(points: Array, places: Array, diameter: float) -> Array:
    """Return depths below the free surface in diameters, infinite where nothing more would fit."""
    from scipy.spatial import KDTree

    empty = places[KDTree(points).query(places)[0] > diameter]
    if not len(empty):
        return np.full(len(points), np.inf)
    depths: Array = np.maximum(KDTree(empty).query(points)[0] / diameter - 1.0, 0.0)
    return depths


def _places(frames: "Frames", radius: float) -> Array:
    """Return a square grid of where a bundle's center can be in an empty drum, in the drum's own frame."""
    line = np.linspace(-radius, radius, 2 * _FINENESS + 1)
    points = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    room = float(frames.radii.mean())
    free: Array = points[(np.hypot(*points.T) < radius - room) & (distance_to_solids(frames, points) > room)]
    return free
