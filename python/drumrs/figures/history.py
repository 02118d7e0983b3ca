"""A run's history: powers, energies, residual of the ledger, center of mass; a table in, a figure out."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection

from drumrs.energies import energies_to_show, powers_to_show
from drumrs.figures import labels
from drumrs.figures.shared import Array, drumrs_style, label_lines, log_scale, new_figure
from drumrs.registry import quantity

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Energies below this share of the greatest are not shown.
_REST = 1e-9
# Beyond so many lines across a panel there is nothing else to be seen.
_MOST_LINES = 60
# Where titles are, over the height of the axes: to look for room above them takes as long as to draw all else.
_TITLE = 1.0


def time_series(
    series: "pl.DataFrame", window: tuple[float, float] | None = None, *, starts: "Sequence[float]" = ()
) -> "Figure":
    """Draw a run's history: power, energies, residual of the energy ledger, center of mass.

    Parameters
    ----------
    series
        Table of a run, one row a sample: `Result.series` or `Simulation.series`.
    window
        Interval of the averages [s], shaded.
    starts
        Times at which phases of a program begin [s], marked by lines; not where they are too many to be told apart.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs import figures
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    >>> simulation.run(duration=0.1)
    >>> figure = figures.time_series(simulation.series)
    >>> [axes.get_title(loc="left") for axes in figure.axes][1:3]
    ['Energy stored [J/m]', 'Energy ledger: relative residual']
    """
    panels: tuple[Callable[[Axes, dict[str, Array]], None], ...] = (
        draw_power,
        _energies,
        _ledger,
        _center_of_mass,
    )
    columns = {name: series[name].to_numpy() for name in series.columns}
    begin, end = float(columns["time"][0]), float(columns["time"][-1])
    with drumrs_style():
        figure = new_figure(11.0, 5.6)
        grid = figure.subplots(2, 2, sharex=True)
        for axes, draw in zip(grid.flat, panels, strict=True):
            draw(axes, columns)
            if window is not None:
                axes.axvspan(*window, color="0.94", zorder=0, linewidth=0)
            if len(starts) <= _MOST_LINES:
                _mark(axes, starts)
            # The last sample may fall just short of the window's end, which deserves its tick.
            axes.set_xlim(begin, max(end, window[1] if window is not None else end) or 1.0)
        if window is not None:
            grid[0, 0].text(sum(window) / 2.0, 0.985, "averages", **_over_the_window(grid[0, 0]))
        for axes in grid[1]:
            axes.set_xlabel(labels.TIME)
        for axes in grid.flat:
            label_lines(axes)
    return figure


def _mark(axes: "Axes", times: "Sequence[float]") -> None:
    """Draw lines across the axes, which neither have a label nor stretch them."""
    lines = [[(time, 0.0), (time, 1.0)] for time in times]
    transform = axes.get_xaxis_transform()
    axes.add_collection(
        LineCollection(lines, transform=transform, color="0.8", linewidth=0.8, zorder=0), autolim=False
    )


def _over_the_window(axes: "Axes") -> dict[str, Any]:
    """Return how to write just inside the top of the axes, at a time."""
    transform = axes.get_xaxis_transform()
    return {"transform": transform, "ha": "center", "va": "top", "color": "0.45", "fontsize": "small"}


def draw_power(axes: "Axes", columns: dict[str, Array]) -> None:
    """Draw the powers of the drum and of the losses, means over an interval that the title names."""
    time = columns["time"]
    long = _averaging_time(time)
    axes.set_title(labels.POWERS.format(long), y=_TITLE)
    steady = [0.0]
    for name, label in powers_to_show(columns).items():
        middle, power = _thinned(*mean_rate(time, columns[name], long))
        axes.plot(middle, power, label=label)
        steady.extend(power[len(power) // 10 :][np.isfinite(power[len(power) // 10 :])])
    # From zero, so that heights compare; the first moments, when the load drops, may leave the picture.
    lowest, highest = min(steady), max(steady)
    room = 0.08 * (highest - lowest) or 1.0
    axes.set_ylim(lowest - room if lowest < 0.0 else 0.0, highest + room)


def _energies(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title(labels.ENERGY_STORED, y=_TITLE)
    log_scale(axes, "y")
    most = 0.0
    for label, values in energies_to_show(columns).items():
        time, smooth = _thinned(columns["time"], values)
        axes.plot(time, np.where(smooth > 0.0, smooth, np.nan), label=label)
        most = max(most, float(np.max(smooth, initial=0.0)))
    # A load at rest trembles for ever less; it leaves the picture.
    lowest, highest = axes.get_ylim()
    axes.set_ylim(max(lowest, _REST * most) if most else lowest, highest)


def _ledger(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title(labels.ENERGY_RESIDUAL, y=_TITLE)
    log_scale(axes, "y")
    name = "energy_residual"
    residual = np.abs(columns[name])
    # A residual of exactly 0 has no place on a logarithmic axis; it is drawn at the last bit of 1.
    axes.plot(columns["time"], np.maximum(residual, np.finfo(float).eps / 2), label=quantity(name).title)
    axes.set_ylim(1e-17, max(1e-8, 10.0 * float(residual.max(initial=0.0))))


def _center_of_mass(axes: "Axes", columns: dict[str, Array]) -> None:
    axes.set_title(labels.CENTER_OF_MASS, y=_TITLE)
    for name, label in (("center_of_mass_x", "x"), ("center_of_mass_y", "y")):
        time, smooth = _thinned(columns["time"], columns[name])
        axes.plot(time, 1e3 * smooth, label=label)


def _averaging_time(time: Array) -> float:
    """Choose an interval [s] for running means: a second, or a thirtieth of a short run."""
    return min(1.0, float(time[-1] - time[0]) / 30.0) if len(time) > 1 else 1.0


def mean_rate(time: Array, total: Array, interval: float) -> tuple[Array, Array]:
    """Return running means of a rate from its running integral: exact, whatever the sampling."""
    if not len(time) > 1:
        return time, np.full_like(time, np.nan)
    step = float(time[1] - time[0])
    rows = max(1, min(round(interval / step), len(time) - 1))
    spans = time[rows:] - time[:-rows]
    return (time[rows:] + time[:-rows]) / 2.0, (total[rows:] - total[:-rows]) / spans


def _thinned(time: Array, values: Array, most: int = 600) -> tuple[Array, Array]:
    """Average blocks of rows, so that a line has no more points than a picture can show."""
    rows = max(1, len(time) // most)
    blocks = len(time) // rows
    shape = (blocks, rows)
    return (
        time[: blocks * rows].reshape(shape).mean(axis=1),
        values[: blocks * rows].reshape(shape).mean(axis=1),
    )
