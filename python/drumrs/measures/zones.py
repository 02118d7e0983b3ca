"""Visits of the discs to a zone, such as that of a spray: how long, how often, and how alike discs fare."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.errors import ConfigError
from drumrs.measures.frame_window import within

if TYPE_CHECKING:
    import polars as pl

    from drumrs.frames import Frames


@dataclass(frozen=True)
class Visits:
    """Visits to a zone.

    Attributes
    ----------
    count
        Visits that were followed by another of the same disc.
    residence
        Mean time of a visit [s].
    cycle
        Mean time from the beginning of a visit to the beginning of the next one [s].
    variance
        Variance of W − (w̄/c̄) C over visits [s²], with the time W of a visit and that of its cycle C.
    """

    count: int
    residence: float
    cycle: float
    variance: float

    def spread(self, time: float) -> float:
        """Return the standard deviation over discs of the time spent in the zone, over its mean, after some time [s].

        √(Var(W − (w̄/c̄) C) c̄/t) / w̄, the limit of a renewal process with rewards: it falls as 1/√t, unless all discs
        keep the same time. It is the part of the coating's spread that the motion is to blame for.
        """
        return math.sqrt(self.variance * self.cycle / time) / self.residence


def zone_visits(frames: "Frames", window: tuple[float, float], zone: ArrayLike) -> Visits:
    """Return how the centers of the discs visit a zone of the laboratory.

    Parameters
    ----------
    frames
        Frames of a run, several in a visit.
    window
        Start and end [s]; many cycles.
    zone
        Corners of the zone in the laboratory's frame [m], shape (k, 2).

    Returns
    -------
    Visits
        Of the visits that begin and end in the window and are followed by another.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or no disc comes twice.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import zone_visits
    >>> config = drumrs.baseline().replace({"run.duration": 3.0, "run.frame_every": 0.01}).softer(100.0)
    >>> frames = drumrs.run(config, progress=False).frames
    >>> right = [[0.0, -0.3], [0.3, -0.3], [0.3, 0.3], [0.0, 0.3]]
    >>> visits = zone_visits(frames, (0.5, 3.0), right)
    >>> 0.0 < visits.residence < visits.cycle
    True
    """
    import shapely

    seen = within(frames, window)
    area = shapely.Polygon(np.asarray(zone, dtype=np.float64))
    shapely.prepare(area)
    places = seen.positions.astype(np.float64)
    inside = shapely.contains_xy(area, places[..., 0], places[..., 1])
    interval = float(seen.times[-1] - seen.times[0]) / (len(seen) - 1)
    stays, cycles = _of_all(inside)
    if not len(stays):
        raise ConfigError("window", window, "one in which a disc comes to the zone twice, and a third time")
    residence, cycle = float(stays.mean()) * interval, float(cycles.mean()) * interval
    off = (stays - residence / cycle * cycles) * interval
    return Visits(len(stays), residence, cycle, float(off.var()))


def recorded_visits(table: "pl.DataFrame | None", zone: str) -> Visits:
    """Return how the centers of the discs visited a zone of ``run.zone``, as counted every 32 steps of the run.

    Parameters
    ----------
    table
        ``result.zone_visits``.
    zone
        Name of the zone.

    Returns
    -------
    Visits
        Of the visits in the averages' window that were followed by another.

    Raises
    ------
    ConfigError
        Where no visits were recorded, there is no such zone, or no disc has come there twice.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import recorded_visits
    >>> right = {"name": "right", "corners": [[0.0, -0.3], [0.3, -0.3], [0.3, 0.3], [0.0, 0.3]]}
    >>> changes = {"run.duration": 3.0, "run.window": [0.5, 3.0], "run.zone": [right]}
    >>> result = drumrs.run(drumrs.baseline().replace(changes).softer(100.0), progress=False)
    >>> visits = recorded_visits(result.zone_visits, "right")
    >>> 0.0 < visits.residence < visits.cycle
    True
    """
    import polars as pl

    names = [] if table is None else table["zone"].unique(maintain_order=True).to_list()
    if table is None or zone not in names:
        problem = f"has no zone named {zone!r}: there {'are ' + ', '.join(names) if names else 'is none'}"
        raise ConfigError("run.zone", problem=problem, hint="add a table [[run.zone]] and run again")
    sums = table.filter(pl.col("zone") == zone).sum().row(0, named=True)
    count = sums["cycles"]
    if not count:
        raise ConfigError(
            "run.duration", problem=f"is too short: no disc has come to the zone {zone!r} twice"
        )
    ratio = sums["stay"] / sums["cycle"]
    squares = sums["stay_squared"] - 2.0 * ratio * sums["stay_cycle"] + ratio**2 * sums["cycle_squared"]
    return Visits(count, sums["stay"] / count, sums["cycle"] / count, max(squares, 0.0) / count)


def _of_all(inside: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the lengths of visits and of their cycles, in frames, of those that are seen whole."""
    later, earlier = inside[1:].T, inside[:-1].T
    disc, begins = np.nonzero(later & ~earlier)
    whose, ends = np.nonzero(~later & earlier)
    stays, cycles = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    for k in np.unique(disc):
        own, over = begins[disc == k], ends[whose == k]
        # A visit that had begun before the window ends first.
        over = over[over > own[0]]
        stays.append(over[: len(own) - 1] - own[:-1])
        cycles.append(np.diff(own))
    return np.concatenate(stays), np.concatenate(cycles)
