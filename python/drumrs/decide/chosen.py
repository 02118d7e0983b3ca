"""Measures for which something is to be chosen: a coloring of the discs, a zone of the drum."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs import measures
from drumrs.analysis import Mean, mean_with_error
from drumrs.errors import ConfigError
from drumrs.measures.frame_window import turn_back, within
from drumrs.measures.recorded import required

if TYPE_CHECKING:
    import polars as pl
    from numpy.typing import NDArray

    from drumrs.config import Config
    from drumrs.frames import Frames


def lacey_index(frames: "Frames", window: tuple[float, float], by: str, turns: float) -> Mean | None:
    """Return Lacey's index of discs that are colored by species, or by where they were some turns before.

    Cells hold ten discs and turn with the drum, as those of `measures.mixing_curve`.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    by
        The coloring, as for `measures.coloring`; every frame of the window that is followed so long is a start.
    turns
        Turns of the drum after which the index is taken; those of species keep their colors, and it does not matter.

    Returns
    -------
    Mean or None
        `None` where the window is shorter than so many turns, or the drum rests.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or every disc or none would be colored.
    """
    seen = within(frames, window)
    last = len(seen) - 1
    turned = abs(float(seen.drum_angles[-1] - seen.drum_angles[0])) / math.tau
    is_kept = by not in measures.COLORINGS
    later = 0 if is_kept else round(turns * last / turned) if turned else last + 1
    if later > last:
        return None
    places = [
        positions.astype(np.float64) @ turn_back(angle - seen.drum_angles[0])
        for positions, angle in zip(seen.positions, seen.drum_angles, strict=True)
    ]
    side = measures.cell_side(places[0])
    index = [
        measures.lacey(places[start + later], measures.coloring(seen, by, start), side)
        for start in range(last + 1 - later)
    ]
    return mean_with_error(index, float(seen.times[-1] - seen.times[0]) / last)


def zone(visits: "pl.DataFrame | None", chosen: str, time: float, duration: float) -> dict[str, Mean]:
    """Return what the visits of discs to a zone are like, by name of the registry.

    Errors are from the scatter over discs, each of which is one of its own.

    Parameters
    ----------
    visits
        ``result.zone_visits``, whose sums begin with the window of the averages.
    chosen
        Name of the zone.
    time
        Time after which the spread is asked for [s].
    duration
        Length of that window [s].

    Raises
    ------
    ConfigError
        Where no disc has come there twice.
    """
    found = measures.recorded_visits(visits, chosen)
    rows = required(visits, "zone_visits", "a zone").filter(zone=chosen)
    inside = rows["time_inside"].to_numpy() / duration
    cycles = rows["cycles"].to_numpy().astype(np.float64)
    return {
        "zone_residence": _ratio(rows["stay"].to_numpy(), cycles),
        "zone_cycle": _ratio(rows["cycle"].to_numpy(), cycles),
        "zone_share": Mean(float(inside.mean()), float(inside.std(ddof=1)) / math.sqrt(len(inside))),
        "zone_spread": Mean(found.spread(time), None),
    }


def check_coloring(config: "Config", by: str, turns: float) -> None:  # noqa: ARG001 - any number will do
    """Refuse a coloring that the load does not have."""
    names = config.load.names
    if by not in measures.COLORINGS and (by not in names or len(names) == 1):
        species = f", or a species, {', '.join(names)}" if len(names) > 1 else "; the load has one species"
        raise ConfigError("lacey_index.by", by, f"one of {', '.join(measures.COLORINGS)}{species}")


def check_zone(config: "Config", zone: str, time: float | None = None) -> None:  # noqa: ARG001 - any will do
    """Refuse a zone whose visits the run does not count."""
    names = [each.name for each in config.run.zone or ()]
    if zone not in names:
        there = f"has {', '.join(names)}" if names else "has no zone"
        hint = f"add a table [[run.zone]] with name = {zone!r} and corners"
        raise ConfigError(
            "run.zone", problem=f"{there}, but the target asks for the zone {zone!r}", hint=hint
        )


def _ratio(above: "NDArray[np.float64]", below: "NDArray[np.float64]") -> Mean:
    """Return a ratio of sums over discs with its standard error, to first order."""
    value, count = float(above.sum() / below.sum()), len(above)
    off = above - value * below
    return Mean(value, math.sqrt(count / (count - 1.0) * float(off @ off)) / float(below.sum()))
