"""How much room there is at places in the drum: up to baffles and walls, and up to the next disc."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.measures.frame_window import turn_back

if TYPE_CHECKING:
    from drumrs.frames import Frames

# So many nearest centers are looked at for the nearest disc, where sizes differ.
_NEAREST = 6


def from_solids(frames: "Frames", points: Array) -> Array:
    """Return the distances of points in the drum's own frame from baffles and walls [m]: 0 within, ∞ without any."""
    import shapely

    distances = np.full(len(points), np.inf)
    solids = [*map(shapely.Polygon, frames.baffles), *map(shapely.LineString, frames.walls)]
    if solids:
        distances[:] = shapely.distance(shapely.GeometryCollection(solids), shapely.points(points))
    return distances


def around(frames: "Frames", index: int, points: Array) -> Array:
    """Return the distances of points in the laboratory from what is nearest in a frame, discs, baffles or walls [m].

    They are negative within a disc, 0 within a baffle. The rim does not count.
    """
    from scipy.spatial import KDTree

    equal = np.ptp(frames.radii) == 0.0
    count = 1 if equal else min(_NEAREST, frames.count)
    distances, which = KDTree(frames.positions[index]).query(points, k=[*range(1, count + 1)])
    room: Array = (distances - frames.radii[which]).min(axis=1)
    corners = [*frames.baffles, *frames.walls]
    if not corners:
        return room
    # Solids reach no nearer to the axis than the nearest of their edges, and need be asked only from there on.
    inner = min(_from_axis(line) for line in corners)
    near = np.hypot(*points.T) + room > inner
    room[near] = np.minimum(
        room[near], from_solids(frames, points[near] @ turn_back(frames.drum_angles[index]))
    )
    return room


def _from_axis(line: Array) -> float:
    """Return the distance of a line, open or closed, from the axis."""
    import shapely

    return float(shapely.LineString(line).distance(shapely.Point(0.0, 0.0)))
