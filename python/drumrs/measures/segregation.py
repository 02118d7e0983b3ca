"""Indices of mixing and segregation without cells: by mean places, by memory, by neighbors, by the core."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array


def mean_position_index(points: ArrayLike, colors: ArrayLike, masses: ArrayLike | None = None) -> Array:
    """Return Asmar's generalized mean mixing index along x and y, shape (2,).

    GMMI = (x̄_c − x₀) / (x̄ − x₀), with the mean place of the colored discs, that of all, and the lower corner of the
    region that the centers span (Asmar, Langston & Matchett, Granular Matter 4 (2002) 129).

    Returns
    -------
    array
        1 for a mixed load; below 1 where the colored discs lie towards the lower corner.
    """
    places, colored = np.asarray(points, dtype=np.float64), np.asarray(colors, dtype=bool)
    weights = np.ones(len(places)) if masses is None else np.asarray(masses, dtype=np.float64)
    from_corner = places - places.min(axis=0)
    part = np.average(from_corner[colored], axis=0, weights=weights[colored])
    index: Array = part / np.average(from_corner, axis=0, weights=weights)
    return index


def memory_of_places(points: ArrayLike, start: ArrayLike) -> float:
    """Return how far places still tell where discs were at the start (the weak index of Doucet, Bertrand & Chaouki).

    It is the greatest singular value of the 2 × 2 matrix of correlations of the coordinates now with those at the start
    (Chem. Eng. Res. Des. 86 (2008) 1313).

    Parameters
    ----------
    points, start
        Centers of the same discs now, and at the start [m], shape (n, 2).

    Returns
    -------
    float
        1 for a round cloud that has turned as one body, of the order 1/√n for a load that has forgotten its start.
    """
    now, then = (_standardized(np.asarray(places, dtype=np.float64)) for places in (points, start))
    return float(np.linalg.svd(now.T @ then / len(now), compute_uv=False)[0])


def _standardized(points: Array) -> Array:
    standardized: Array = (points - points.mean(axis=0)) / points.std(axis=0)
    return standardized


def unlike_contacts(points: ArrayLike, radii: ArrayLike, colors: ArrayLike, gap: float = 0.1) -> float:
    """Return the share of unlike pairs among touching discs, over that of colorings at random: mixing at their scale.

    With n colored discs of N, two discs at random are unlike with the probability 2 n (N − n) / (N (N − 1)).

    Parameters
    ----------
    points, radii, colors
        Centers [m] and radii [m] of the discs, and which of them are colored.
    gap
        Discs touch that are no further apart than this part of the mean radius.

    Returns
    -------
    float
        Near 0 for a load that lies apart, 1 on average for colorings at random; not a number where none touch.
    """
    from scipy.spatial import KDTree

    places, sizes = np.asarray(points, dtype=np.float64), np.asarray(radii, dtype=np.float64)
    colored = np.asarray(colors, dtype=bool)
    room = gap * float(sizes.mean())
    pairs = KDTree(places).query_pairs(2.0 * float(sizes.max()) + room, output_type="ndarray")
    one, other = pairs.T
    touches = np.linalg.norm(places[one] - places[other], axis=1) <= sizes[one] + sizes[other] + room
    count, part = len(places), int(colored.sum())
    unlike = colored[one[touches]] != colored[other[touches]]
    expected = 2.0 * part * (count - part) / (count * (count - 1.0))
    return float(unlike.mean() / expected) if len(unlike) else float("nan")


@dataclass(frozen=True)
class RadialSegregation:
    """How far small discs lie inside.

    Attributes
    ----------
    distance
        Mean distance of the small discs from the center over that of the large ones, less 1: negative for a core.
    core
        Share of the small discs' area that lies within the core that holds as much area as they have, scaled so that it
        is 0 for a load at random and 1 where they fill the core.
    """

    distance: float
    core: float


def radial_segregation(
    points: ArrayLike, radii: ArrayLike, small: ArrayLike, center: ArrayLike = (0.0, 0.0)
) -> RadialSegregation:
    """Return how far small discs lie inside: in a core about the center of circulation, or the axis.

    Parameters
    ----------
    points, radii
        Centers [m] and radii [m] of the discs.
    small
        Which of them are the small ones.
    center
        Center of the core [m], such as `center_of_circulation`; the axis, for a load that is centrifuged.
    """
    areas, is_small = np.asarray(radii, dtype=np.float64) ** 2, np.asarray(small, dtype=bool)
    distances = np.linalg.norm(np.asarray(points, dtype=np.float64) - np.asarray(center), axis=1)
    means = [np.average(distances[part], weights=areas[part]) for part in (is_small, ~is_small)]
    share = float(areas[is_small].sum() / areas.sum())
    order = np.argsort(distances, kind="stable")
    # Area of the load up to each disc's middle, over all.
    within_reach = (np.cumsum(areas[order]) - 0.5 * areas[order]) / areas.sum() <= share
    inside = float(areas[order][within_reach & is_small[order]].sum() / areas[is_small].sum())
    return RadialSegregation(float(means[0] / means[1]) - 1.0, (inside - share) / (1.0 - share))
