"""Clearance of points in the drum: the distance to baffles and walls, and to the nearest disc."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.measures.frame_window import turn_back

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Nearest centers among which the nearest disc is searched, where sizes differ.
_NEAREST = 6


def distance_to_solids(frames: "Frames", points: Array) -> Array:
    """Return the distances of points in the drum's own frame from baffles and walls [m]: 0 within, ∞ without any."""
    import shapely

    distances = np.full(len(points), np.inf)
    solids = [*map(shapely.Polygon, frames.baffles), *map(shapely.LineString, frames.walls)]
    if solids:
        distances[:] = shapely.distance(shapely.GeometryCollection(solids), shapely.points(points))
    return distances


def clearance(frames: "Frames", index: int, points: Array) -> Array:
    """Return the distances of points in the laboratory from the nearest disc, baffle or wall of a frame [m].

    They are negative within a disc, 0 within a baffle. The rim does not count.
    """
    from scipy.spatial import KDTree

    equal = np.ptp(frames.radii) == 0.0
    count = 1 if equal else min(_NEAREST, frames.count)
    distances, which = KDTree(frames.positions[index]).query(points, k=[*range(1, count + 1)])
    clearances: Array = (distances - frames.radii[which]).min(axis=1)
    corners = [*frames.baffles, *frames.walls]
    if not corners:
        return clearances
    # Solids reach no nearer to the axis than the nearest of their edges, and need be asked only from there on.
    inner = min(_from_axis(line) for line in corners)
    near = np.hypot(*points.T) + clearances > inner
    clearances[near] = np.minimum(
        clearances[near], distance_to_solids(frames, points[near] @ turn_back(frames.drum_angles[index]))
    )
    return clearances


def _from_axis(line: Array) -> float:
    """Return the distance of a line, open or closed, from the axis."""
    import shapely

    return float(shapely.LineString(line).distance(shapely.Point(0.0, 0.0)))
