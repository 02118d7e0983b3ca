"""Measures of mixing and segregation: colorings at random, colorings of which the index is known, a made-up curve."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from drumrs import measures
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at, vanishing

Array = NDArray[np.float64]

_COUNT, _SHARE, _COLORINGS = 400, 0.3, 400
# Entropy of the shares ¾ and ¼ over that of ½ and ½.
_THREE_QUARTERS = 2.0 - 0.75 * math.log2(3.0)
# Standard errors by which a mean over colorings at random may be off: beyond 4.5 once in 150 000 means.
_STANDARD_ERRORS = 4.5


@case(
    "mixing-null",
    source="sampling without replacement",
    formula="mean over colorings at random: Lacey, entropy, unlike contacts, mean position 1, radial segregation 0",
    cost=3e6,
)
def mixing_null() -> Evidence:
    """Indices of 400 discs at random places, three tenths of them colored at random.

    Four and a half standard errors of the mean over 400 colorings, or 20 where the null is itself a mean over 200.
    """
    draws = np.random.default_rng(5)
    points = _cloud(draws)
    masses = draws.uniform(1.0, 3.0, len(points))
    radii = np.full(len(points), 0.03)
    side = measures.cell_side(points)
    colors = np.arange(len(points)) < _SHARE * len(points)
    names = ("Lacey", "Lacey by mass", "entropy", "unlike contacts", "mean position", "distance", "core")
    rows = []
    for k in range(_COLORINGS):
        other = draws.permutation(colors)
        radial = measures.radial_segregation(points, radii, other)
        slow = k < _COLORINGS // 20  # which take 200 permutations each
        rows.append(
            (
                measures.lacey(points, other, side),
                measures.lacey(points, other, side, masses) if slow else math.nan,
                measures.entropy(points, other, side) if slow else math.nan,
                measures.unlike_contacts(points, radii, other),
                measures.mean_position_index(points, other)[0],
                radial.distance,
                radial.core,
            )
        )
    values = np.array(rows)
    expected = np.array([1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0])
    errors = np.nanstd(values, axis=0) / np.sqrt(np.isfinite(values).sum(axis=0))
    means, allowed = np.nanmean(values, axis=0), _STANDARD_ERRORS * errors
    traces = [Trace("", range(1, len(names) + 1), (means - expected) / allowed)]
    return Evidence(tuple(checks_at(names, expected, means, allowed)), vanishing("index", traces))


@case(
    "mixing-known",
    source="definitions",
    formula="pure cells 0; all cells alike σ₀²/(σ₀² − σ_r²); rigid turn of a round cloud 1; a core of small discs 1",
    cost=1e5,
)
def mixing_known() -> Evidence:
    """Indices of loads of which they are known, and the curve of mixing from points on it.

    Round-off: 10⁻¹² of 1. The curve: 10⁻⁶, what least squares leave.
    """
    # Four cells of four discs, a square lattice.
    x, y = (axis.ravel() for axis in np.meshgrid(0.25 + 0.5 * np.arange(4), 0.25 + 0.5 * np.arange(4)))
    points = np.column_stack([x, y])
    pure, alike = x > 1.0, (4.0 * x + 0.5).astype(int) % 4 == 1
    null = 3.0 / 15.0  # (K − 1)/(N − 1)
    # In each cell one disc is as heavy as the three others; colored are three or one of a cell, all shares by mass ½.
    corner = (2.0 * x).astype(int) % 2 + 2 * ((2.0 * y).astype(int) % 2)
    first, second, third, _ = (corner == k for k in range(4))
    mostly = first ^ pure
    masses = np.where(first, 3.0, 1.0)
    heavier = np.where(pure, first | second, second | third)

    def by_mass(points: Array, colors: NDArray[np.bool_], side: float) -> float:
        return measures.lacey(points, colors, side, masses)

    draws = np.random.default_rng(2)
    cloud = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    cloud = np.concatenate(
        [(radius * cloud) @ _turn(k) for k, radius in enumerate(draws.uniform(0.1, 1.0, 60))]
    )
    inner = np.hypot(*cloud.T) < np.median(np.hypot(*cloud.T))
    radial = measures.radial_segregation(cloud, np.ones(len(cloud)), inner)
    rows = [
        ("Lacey, pure cells", 0.0, measures.lacey(points, pure, 1.0)),
        ("Lacey, all cells alike", 1.0 / (1.0 - null), measures.lacey(points, alike, 1.0)),
        ("entropy, pure cells", 0.0, measures.entropy(points, pure, 1.0)),
        (
            "entropy of shares ¾ and ¼ over that of ½",
            _THREE_QUARTERS,
            _over(measures.entropy, points, mostly, alike),
        ),
        (
            "Lacey by mass of shares ⅔ and ⅓ over that of ½",
            8.0 / 9.0,
            _over(by_mass, points, heavier, mostly),
        ),
        ("σ/p, pure cells of equal shares", 1.0, measures.relative_deviation(points, pure, 1.0)),
        ("mean position, right half", 5.0 / 3.0, float(measures.mean_position_index(points, pure)[0])),
        ("memory of places, rigid turn", 1.0, measures.memory_of_places(cloud @ _turn(0.7), cloud)),
        ("memory of places, one in four on the other side", 0.5, _one_in_four_flipped(cloud)),
        ("unlike contacts of columns", (4.0 / 24.0) / (8.0 / 15.0), _unlike(points, pure)),
        (
            "unlike contacts of a chessboard",
            15.0 / 8.0,
            _unlike(points, (2.0 * (x + y)).astype(int) % 2 == 1),
        ),
        ("core of small discs", 1.0, radial.core),
        ("their distance", _ratio(cloud, inner), radial.distance),
    ]
    found = [Check(name, "1", expected, value, 1e-12) for name, expected, value in rows]
    turns = np.linspace(0.0, 8.0, 41)
    made = measures.MixingRate(start=0.05, end=0.93, rate=0.6, delay=0.5)
    fitted = measures.mixing_rate(turns, made.at(turns))
    found += checks_at(
        ["M∞", "k", "τ"], [made.end, made.rate, made.delay], [fitted.end, fitted.rate, fitted.delay], 1e-6
    )
    fine = np.linspace(0.0, 8.0, 200)
    trace = Trace(
        "", turns, fitted.at(turns), (fine, 0.93 - 0.88 * np.exp(-0.6 * np.maximum(fine - 0.5, 0.0)))
    )
    return Evidence(tuple(found), Panel("turns", "M", (trace,)))


def _cloud(draws: np.random.Generator) -> Array:
    radius = np.sqrt(draws.uniform(0.0, 1.0, _COUNT))
    angle = draws.uniform(0.0, math.tau, _COUNT)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _turn(angle: float) -> Array:
    return np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])


def _over(
    index: Callable[[Array, NDArray[np.bool_], float], float],
    points: Array,
    one: NDArray[np.bool_],
    other: NDArray[np.bool_],
) -> float:
    """Return the ratio of an index for two colorings of as many discs: the null drops out."""
    return index(points, one, 1.0) / index(points, other, 1.0)


def _one_in_four_flipped(cloud: Array) -> float:
    return measures.memory_of_places(np.concatenate([cloud, cloud, cloud, -cloud]), np.tile(cloud, (4, 1)))


def _unlike(points: Array, colors: NDArray[np.bool_]) -> float:
    """Return the index of a square lattice whose discs touch four others: 24 contacts, of which 4 join two columns."""
    return measures.unlike_contacts(points, np.full(len(points), 0.25), colors)


def _ratio(cloud: Array, inner: NDArray[np.bool_]) -> float:
    distance = np.hypot(*cloud.T)
    return float(distance[inner].mean() / distance[~inner].mean()) - 1.0


CASES = (mixing_null, mixing_known)
