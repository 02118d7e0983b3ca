"""Measures of washing and drying: how the load turns over, spreads, opens to the air, is knocked and rubbed.

They are measures of mechanical action, not of cleaning: soil removal does not go with any of them alone.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array, Mean, mean_with_error
from drumrs.measures.airborne import in_flight
from drumrs.measures.frame_window import counter_clockwise, within
from drumrs.measures.recorded import required

if TYPE_CHECKING:
    import polars as pl

    from drumrs.frames import Frames

# Directions in which the surroundings of a disc are sampled, and frames that are plenty for a mean.
_DIRECTIONS, _MAX_FRAMES = 72, 50
# Directions between discs that touch are known to round-off.
_ROUND_OFF = 1e-9
_GRAVITY = 9.81


def washing(frames: "Frames", window: tuple[float, float], gravity: float = _GRAVITY) -> dict[str, Mean]:
    """Return how a load of laundry moves in a window.

    Parameters
    ----------
    frames
        Frames of a run in a drum that turns; close together, for displacements stand for paths.
    window
        Start and end [s].
    gravity
        Acceleration of gravity [m/s²], which tells a flight, see `flights`.

    Returns
    -------
    dict
        By name of the registry, with standard errors:
        ``center_turning`` [rad/s], by how much the polar angle of the center of mass changes, without its sign, per
        second; ``disc_turning`` [rad/s], the same of each disc, on average; ``moving_speed`` [m/s], the mean
        displacement of a disc between frames over their interval, and ``moving_spread``, its standard deviation over
        discs, over itself;
        ``axis_distance_spread`` [m], standard deviation of the distances from the axis;
        ``shape_factor``, see `shape_factor`; ``openness``, see `openness`; ``curtain``, see `curtain`.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    References
    ----------
    The first five after Textile Research Journal, doi 10.1177/0040517515590417 and Fibers and Polymers, doi
    10.1007/s12221-022-4802-z.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import washing
    >>> config = drumrs.baseline().replace({"run.duration": 0.3, "run.frame_every": 0.01})
    >>> found = washing(drumrs.run(config, progress=False).frames, window=(0.0, 0.3))
    >>> 0.0 < found["openness"].value < 1.0
    True
    """
    inside = counter_clockwise(within(frames, window))
    positions, interval = inside.positions.astype(np.float64), float(np.diff(inside.times).mean())
    speeds = np.hypot(*np.moveaxis(np.diff(positions, axis=0), -1, 0)) / interval
    weights = inside.radii**2 / (inside.radii**2).sum()
    chosen = [*range(0, len(inside), max(1, len(inside) // _MAX_FRAMES))]
    airborne = in_flight(inside, gravity)
    span = inside.reach or float(np.hypot(*np.moveaxis(positions, -1, 0)).max())
    frame_interval = interval * (chosen[1] - chosen[0])
    return {
        "center_turning": mean_with_error(
            _turned(np.einsum("fnk,n->fk", positions, weights)) / interval, interval
        ),
        "disc_turning": mean_with_error(_turned(positions).mean(axis=1) / interval, interval),
        "moving_speed": mean_with_error(speeds.mean(axis=1), interval),
        "moving_spread": mean_with_error(speeds.std(axis=1) / speeds.mean(axis=1), interval),
        "axis_distance_spread": mean_with_error(
            np.hypot(positions[..., 0], positions[..., 1]).std(axis=1), interval
        ),
        "shape_factor": mean_with_error(
            [shape_factor(positions[k], inside.radii) for k in chosen], frame_interval
        ),
        "openness": mean_with_error(
            [openness(positions[k], inside.radii, 0.5 * span) for k in chosen], frame_interval
        ),
        "curtain": mean_with_error(
            [curtain(positions[k][airborne[k]], inside.radii[airborne[k]], span) for k in range(len(inside))],
            interval,
        ),
    }


def _turned(points: Array) -> Array:
    """Return the angles about the axis by which positions turn from frame to frame, without their sign."""
    angles = np.arctan2(points[..., 1], points[..., 0])
    turned: Array = np.abs((np.diff(angles, axis=0) + math.pi) % (2.0 * math.pi) - math.pi)
    return turned


def shape_factor(points: ArrayLike, radii: ArrayLike) -> float:
    """Return 4 π A/P² of the outline of a load: 1 for a round one, π/4 for a square, small for one that is torn apart.

    The outline is that of all discs with the gaps between them closed that no disc of their mean size could enter.

    Parameters
    ----------
    points, radii
        Centers [m], shape (n, 2), and radii [m], shape (n,).
    """
    import shapely

    sizes = np.asarray(radii, dtype=np.float64)
    gap = float(sizes.mean())
    grown = shapely.union_all(
        shapely.buffer(shapely.points(np.asarray(points, dtype=np.float64)), sizes + gap, quad_segs=16)
    )
    outline = grown.buffer(-gap, quad_segs=16)
    return float(4.0 * math.pi * outline.area / outline.length**2)


def openness(points: ArrayLike, radii: ArrayLike, reach: float) -> float:
    """Return the fraction of the discs' perimeters that faces open space.

    A point of the perimeter does where a ray from it, along the radius, meets no other disc within the reach.
    Walls do not count.

    Parameters
    ----------
    points, radii
        Centers [m], shape (n, 2), and radii [m], shape (n,).
    reach
        Length of the ray [m], such as a quarter of the drum's diameter.

    Returns
    -------
    float
        1 for a lone disc, 0 for one among six that touch it.
    """
    from scipy.spatial import KDTree

    positions, sizes = np.asarray(points, dtype=np.float64), np.asarray(radii, dtype=np.float64)
    pairs = KDTree(positions).query_pairs(reach + 2.0 * float(sizes.max()), output_type="ndarray")
    disc, other = np.concatenate([pairs, pairs[:, ::-1]]).T
    x, y = (positions[other] - positions[disc]).T
    distance, size, length = np.hypot(x, y), sizes[other], sizes[disc] + reach
    # A disc hides an angle: that of its tangents where they are within the ray's length, else that at which the ray
    # just ends on it.
    to_tangent = np.arcsin(np.minimum(size / distance, 1.0))
    to_end = np.arccos(np.clip((distance**2 + length**2 - size**2) / (2.0 * distance * length), -1.0, 1.0))
    half = np.where(distance**2 - size**2 <= length**2, to_tangent, to_end)
    step, middle = 2.0 * math.pi / _DIRECTIONS, np.arctan2(y, x)
    first = np.ceil((middle - half) / step - _ROUND_OFF).astype(int)
    count = np.floor((middle + half) / step + _ROUND_OFF).astype(int) + 1 - first
    hides = (distance - size <= length) & (count > 0)
    disc, first, count = disc[hides], first[hides] % _DIRECTIONS, count[hides]
    # Up by one where what is hidden begins, down where it ends; an angle goes round at most once.
    changes = np.zeros((len(positions), 2 * _DIRECTIONS + 1), dtype=int)
    np.add.at(changes, (disc, first), 1)
    np.subtract.at(changes, (disc, first + count), 1)
    hidden = changes.cumsum(axis=1)[:, :-1].reshape(-1, 2, _DIRECTIONS).any(axis=1)
    return 1.0 - float(hidden.mean())


def curtain(points: ArrayLike, radii: ArrayLike, reach: float) -> float:
    """Return the fraction of vertical lines through the drum that meet a disc: of rising air that meets a curtain.

    Parameters
    ----------
    points, radii
        Centers [m] and radii [m] of the discs in flight.
    reach
        Radius of the drum [m].
    """
    across, sizes = np.asarray(points, dtype=np.float64)[:, 0], np.asarray(radii, dtype=np.float64)
    order = np.argsort(across - sizes, kind="stable")
    left = np.maximum((across - sizes)[order], -reach)
    right = np.minimum((across + sizes)[order], reach)
    # Each covers what those to the left of it have not reached.
    reached = np.concatenate([[-reach], np.maximum.accumulate(right)])[:-1] if len(right) else right
    return float(np.maximum(right - np.maximum(left, reached), 0.0).sum() / (2.0 * reach))


def knocking_and_rubbing(
    ledger_split: "pl.DataFrame | None", mass: float, duration: float
) -> dict[str, tuple[float, float]]:
    """Return the power of knocking and rubbing per mass, of discs among themselves and of discs with the drum.

    Knocking is what normal damping takes, rubbing what sliding and tangential damping take: stand-ins for what fabric
    suffers, to be fitted to loss of threads or fraying (IEC PAS 62473).

    Parameters
    ----------
    ledger_split
        ``result.ledger_split``.
    mass
        Mass of the load [kg/m].
    duration
        Time over which it was recorded [s].

    Returns
    -------
    dict
        ``"load"`` and ``"drum"``: knocking and rubbing [W/kg].

    Raises
    ------
    ConfigError
        Where it was not recorded.
    """
    import polars as pl

    table = required(ledger_split, "ledger_split", "knocking and rubbing")
    of_the_load = pl.col("other").is_in(table["body"].unique().to_list())
    taken = {"load": table.filter(of_the_load), "drum": table.filter(~of_the_load)}
    rubs = [name for name in ("dissipated_sliding", "dissipated_tangential") if name in table.columns]
    return {
        name: (
            float(rows["dissipated_normal"].sum()) / (mass * duration),
            sum(float(rows[column].sum()) for column in rubs) / (mass * duration),
        )
        for name, rows in taken.items()
    }


def received_spread(discs: "pl.DataFrame | None") -> float:
    """Return how unequally discs are loaded: standard deviation over mean of what discs received per mass.

    Parameters
    ----------
    discs
        ``result.discs``.

    Returns
    -------
    float
        0 where all received the same per mass, 1 where the standard deviation is as large as the mean; not a number
        where none received anything.

    Raises
    ------
    ConfigError
        Where it was not recorded.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.measures import received_spread
    >>> received_spread(pl.DataFrame({"mass": [1.0, 2.0], "received_normal": [1.0, 6.0]}))
    0.5
    """
    import polars as pl

    table = required(discs, "discs", "how unequally discs are loaded")
    energies = table.select(pl.sum_horizontal(pl.col("^received_.*$"))).to_series()
    received = (energies / table["mass"]).to_numpy()
    return float(received.std() / received.mean()) if received.any() else math.nan
