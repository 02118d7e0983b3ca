"""The curves beside the player: power and energies over time, no more points than a screen shows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.energies import energies_to_show, powers_to_show
from drumrs.frames import Frames
from drumrs.registry import quantity

if TYPE_CHECKING:
    import polars as pl

Array = NDArray[np.float64]

_POINTS = 500
# Fewer points than this are no curve.
_FEWEST = 3
# The first one in so many points, when the load falls and settles, does not stretch the axes.
_START = 10


@dataclass(frozen=True)
class Line:
    """A named curve; `values` go with the times of its panel."""

    name: str
    values: Array


@dataclass(frozen=True)
class Panel:
    """Curves that share their axes.

    Attributes
    ----------
    title, unit
        What is drawn, and in which unit.
    times
        Times of the points [s].
    lines
        The curves.
    limits
        Lowest and highest value of the axis; what lies beyond is cut off.
    logarithmic
        Whether the axis is logarithmic.
    """

    title: str
    unit: str
    times: Array
    lines: Sequence[Line]
    limits: tuple[float, float]
    logarithmic: bool = False


def panels_of_series(series: "pl.DataFrame") -> list[Panel]:
    """Return the power of the drum with its losses, and the energies stored, from a run's series."""
    columns = {name: series[name].to_numpy().astype(float, copy=False) for name in series.columns}
    if len(columns["time"]) < _FEWEST:
        return []
    return [_power(columns), _energies(columns)]


def panels_of_frames(frames: Frames) -> list[Panel]:
    """Return what frames alone can tell: the bundles' mean speed, and their mean position."""
    if len(frames) < _FEWEST:
        return []
    centers = 1e3 * frames.positions.mean(axis=1, dtype=float)
    speed = [Line("mean", frames.speeds.mean(axis=1, dtype=float)), Line("fastest", _fastest(frames))]
    places = [Line("x", centers[:, 0]), Line("y", centers[:, 1])]
    return [
        Panel("Speed of the bundles", "m/s", frames.times, speed, _limits(speed)),
        Panel("Mean position of the bundles", "mm", frames.times, places, _limits(places)),
    ]


def _fastest(frames: Frames) -> Array:
    fastest: Array = frames.speeds.max(axis=1).astype(float)
    return fastest


def _power(columns: dict[str, Array]) -> Panel:
    middle, interval = _moments(columns["time"], 0.5)
    lines = [
        Line(name, _mean_rate(columns["time"], columns[key], middle, interval))
        for key, name in powers_to_show(columns).items()
    ]
    return Panel(
        f"Power, means over {interval:.2g} s", quantity("drum_power").unit, middle, lines, _limits(lines)
    )


def _energies(columns: dict[str, Array]) -> Panel:
    times = columns["time"]
    middle, interval = _moments(times, 0.1)
    lines = [
        Line(name, _mean_rate(times, _integral(times, values), middle, interval))
        for name, values in energies_to_show(columns).items()
    ]
    highest = max(float(line.values.max(initial=0.0)) for line in lines) or 1.0
    settled = [value for line in lines for value in line.values[len(middle) // _START :] if value > 0.0]
    # Energies of contacts may die away for good; five decades are what a small panel can show.
    lowest = max(min(settled, default=highest), highest * 1e-5)
    title = f"Energy stored, means over {interval:.2g} s"
    return Panel(
        title, quantity("kinetic_energy").unit, middle, lines, (lowest / 1.5, highest * 1.5), logarithmic=True
    )


def _moments(times: Array, longest: float) -> tuple[Array, float]:
    """Return the times of running means, and over how long each of them is [s]."""
    span = float(times[-1] - times[0])
    interval = min(longest, span / 10.0)
    ends = (times[0] + interval / 2.0, times[-1] - interval / 2.0)
    return np.linspace(*ends, min(_POINTS, len(times))), interval


def _mean_rate(times: Array, total: Array, middle: Array, interval: float) -> Array:
    """Return means of a rate from its running integral: they are exact, whatever the sampling."""
    ends, begins = (np.interp(middle + sign * interval / 2.0, times, total) for sign in (1.0, -1.0))
    rate: Array = (ends - begins) / interval
    return rate


def _integral(times: Array, values: Array) -> Array:
    """Return the running integral of samples, by trapezoids."""
    pieces = np.diff(times) * (values[1:] + values[:-1]) / 2.0
    return np.concatenate([[0.0], np.cumsum(pieces)])


def _limits(lines: Sequence[Line]) -> tuple[float, float]:
    """Return limits that hold what comes after the start, with zero, so that heights compare."""
    settled = np.concatenate([line.values[len(line.values) // _START :] for line in lines])
    settled = settled[np.isfinite(settled)]
    lowest, highest = min(0.0, float(settled.min(initial=0.0))), max(0.0, float(settled.max(initial=0.0)))
    room = 0.08 * (highest - lowest) or 1.0
    return (lowest - room if lowest < 0.0 else 0.0), highest + room
