"""Loose lines that meet end to end, made into one."""

from typing import Any

import numpy as np
import shapely

from drumrs.drawing.line import Line, Points


def joined(lines: list[Line], gap: float) -> list[Line]:
    """Return the lines of each layer with those joined whose ends are at most `gap` [m] apart, in the order drawn.

    Where more than two ends meet, none of them are. Points keep their bits but for ends that are moved onto each other.
    """
    found = []
    for layer in dict.fromkeys(line.layer for line in lines):
        own = [
            cleaned for line in lines if line.layer == layer and len(cleaned := _distinct(line.points)) > 1
        ]
        found += [Line(layer, points) for points in _merged(_snapped(own, gap))]
    return found


def _distinct(points: Points) -> Points:
    """Leave out points that repeat the one before them."""
    kept = np.ones(len(points), dtype=bool)
    kept[1:] = (points[1:] != points[:-1]).any(axis=1)
    return points[kept]


def _snapped(lines: list[Points], gap: float) -> list[Points]:
    """Move ends that are close to each other onto the first of them; those of a line shorter than that stay apart."""
    from scipy.cluster.hierarchy import DisjointSet
    from scipy.spatial import KDTree

    ends = np.array([line[end] for line in lines for end in (0, -1)]).reshape(-1, 2)
    sets = DisjointSet(range(len(ends)))
    for one, other in sorted(KDTree(ends).query_pairs(gap)) if len(ends) else ():
        is_short = one // 2 == other // 2 and _length(lines[one // 2]) <= 2.0 * gap
        if not is_short:
            sets.merge(one, other)
    moved = [line.copy() for line in lines]
    for index in range(len(ends)):
        moved[index // 2][-(index % 2)] = ends[min(sets.subset(index))]
    return moved


def _length(line: Points) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _merged(lines: list[Points]) -> list[Points]:
    """Join lines at the ends that two of them share; lines that are closed already stay as they are."""
    closed = [line for line in lines if (line[0] == line[-1]).all()]
    loose = [line for line in lines if not (line[0] == line[-1]).all()]
    if not loose:
        return closed
    merged: Any = shapely.get_parts(shapely.line_merge(shapely.MultiLineString(loose)))
    return [*closed, *map(shapely.get_coordinates, merged)]
