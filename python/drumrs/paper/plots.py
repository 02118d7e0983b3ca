"""The figures of the paper's study, one function each: points, frames or series in, a figure out.

Points are tables as `curves` takes them.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures import labels
from drumrs.figures.curves import Labels, curves, say_above
from drumrs.figures.history import mean_rate
from drumrs.figures.shared import Array, drumrs_style, new_figure
from drumrs.figures.snapshots import View, snapshots
from drumrs.frames import Frames

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.paper.states import TwoStates

# Marks of N/T by other readings than the line's.
_MARKS = {"x": "by dissipation", "+": "by net work"}
# Running means over that long [s]: some two turns of the drum.
_LONG = 2.0


def snapshots_of_fills(frames: Mapping[str, Frames], index: int = -1) -> "Figure":
    """Draw F2 or F3: the last frame of each fill in a row, lettered as in the paper.

    Parameters
    ----------
    frames
        Frames by fill, in words.
    index
        Which frame of each.
    """
    letters = "abcdefghij"
    return snapshots(
        [View(one, index, f"({letters[k]}) {fill}") for k, (fill, one) in enumerate(frames.items())]
    )


def power_against_fill(points: "pl.DataFrame") -> "Figure":
    """Draw F4: drum power against fill, without and with baffles; shaded is where the paper has the peak."""
    figure = curves(points, Labels(labels.FILL, labels.DRUM_POWER, x_scale=100.0))
    figure.axes[0].axvspan(40.0, 50.0, color="0.93", zorder=0, linewidth=0)
    _say_below(figure.axes[0], 45.0, "the paper’s\npeak")
    return figure


def specific_power_against_fill(points: "pl.DataFrame") -> "Figure":
    """Draw F5: specific power against fill, without and with baffles."""
    return curves(points, Labels(labels.FILL, labels.DRUM_SPECIFIC_POWER, x_scale=100.0))


def ratio_against_fill(points: "pl.DataFrame", *others: "pl.DataFrame") -> "Figure":
    """Draw F6: N/T against fill, without and with baffles.

    Parameters
    ----------
    points
        N/T by gross work.
    *others
        N/T by dissipation and by net work: marks.
    """
    return _readings(points, others, Labels(labels.FILL, labels.GROSS_WORK_RATIO, x_scale=100.0))


def specific_power_against_size(points: "pl.DataFrame") -> "Figure":
    """Draw F7: specific power against D/d at 40 % fill, without and with baffles."""
    return curves(points, Labels(labels.SIZE_RATIO, labels.DRUM_SPECIFIC_POWER))


def specific_power_against_friction(points: "pl.DataFrame") -> "Figure":
    """Draw F8: specific power against friction without baffles, at three fills."""
    return curves(points, Labels(labels.FRICTION, labels.DRUM_SPECIFIC_POWER))


def ratio_against_friction(points: "pl.DataFrame", *others: "pl.DataFrame") -> "Figure":
    """Draw F9: N/T against friction without baffles, at three fills; `others` as in `ratio_against_fill`."""
    return _readings(points, others, Labels(labels.FRICTION, labels.GROSS_WORK_RATIO))


def specific_power_against_speed(points: "pl.DataFrame", centrifuging: float) -> "Figure":
    """Draw specific power against the drum's speed, without and with baffles.

    Parameters
    ----------
    points
        The points.
    centrifuging
        Speed at which the rim's acceleration equals gravity [rpm], marked by a line.
    """
    figure = curves(points, Labels(labels.DRUM_SPEED, labels.DRUM_SPECIFIC_POWER))
    axes = figure.axes[0]
    axes.axvline(centrifuging, color="0.7", linewidth=0.8, zorder=0)
    _say_below(axes, centrifuging, "Ω²R = g", beside=4.0)
    return figure


def specific_power_against_restitution(points: "pl.DataFrame") -> "Figure":
    """Draw specific power against restitution, without and with baffles."""
    return curves(points, Labels(labels.RESTITUTION, labels.DRUM_SPECIFIC_POWER))


# Those that are drawn of points alone, by the figure's number.
CURVES: Mapping[str, "Callable[..., Figure]"] = {
    "F4": power_against_fill,
    "F5": specific_power_against_fill,
    "F6": ratio_against_fill,
    "F7": specific_power_against_size,
    "F8": specific_power_against_friction,
    "F9": ratio_against_friction,
    "restitution": specific_power_against_restitution,
}


def _say_below(axes: "Axes", x: float, text: str, beside: float = 0.0) -> None:
    """Write at the foot of axes, centered at x or so many points to the right of it."""
    axes.annotate(
        text,
        (x, 0.02),
        (beside, 0.0),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        ha="left" if beside else "center",
        va="bottom",
        color="0.45",
        fontsize="small",
    )


def _readings(points: "pl.DataFrame", others: "Sequence[pl.DataFrame]", axis_labels: Labels) -> "Figure":
    figure = curves(points, axis_labels)
    axes = figure.axes[0]
    for other, (mark, name) in zip(others, _MARKS.items(), strict=True):
        x, y = axis_labels.x_scale * other["x"].to_numpy(), other["mean"].to_numpy()
        axes.plot(x, y, mark, color="black", markersize=6.5, markeredgewidth=0.6, zorder=4)
        say_above(axes, f"{mark.replace('x', '×')}: {name}")
    return figure


def drift_over_time(
    runs: Mapping[str, Sequence["pl.DataFrame"]], mass: Mapping[str, float], window: tuple[float, float]
) -> "Figure":
    """Draw how loads drift: running means of specific power and of N/T over each run, seed by seed.

    Parameters
    ----------
    runs
        Series of the seeds by drum, in words.
    mass
        Mass of the load by drum [kg/m].
    window
        Interval of the averages [s], shaded.
    """
    with drumrs_style():
        figure = new_figure(8.4, 4.6)
        grid = figure.subplots(2, len(runs), sharex=True, sharey="row", squeeze=False)
        for column, (drum, series) in enumerate(runs.items()):
            power, ratio = grid[0, column], grid[1, column]
            power.set_title(drum)
            for one in series:
                power.plot(*_running(one, "drum_work", scale=mass[drum]), linewidth=1.0)
                ratio.plot(*_running(one, "dissipated_normal", "dissipated_sliding"), linewidth=1.0)
            ratio.set_xlabel(labels.TIME)
        for axes in grid.flat:
            axes.axvspan(*window, color="0.94", zorder=0, linewidth=0)
        grid[0, 0].set_ylabel(labels.DRUM_SPECIFIC_POWER)
        grid[1, 0].set_ylabel(labels.DISSIPATION_RATIO)
        _say_below(grid[0, 0], sum(window) / 2.0, "averages")
    return figure


def states_over_time(states: Sequence["TwoStates"]) -> "Figure":
    """Draw how loads about half full pass between two states, above; and what each state is like, below.

    Parameters
    ----------
    states
        The states at some fills, of increasing fill.
    """
    with drumrs_style():
        figure = new_figure(9.6, 5.6)
        grid = figure.subplots(2, max(len(states), 3), sharey="row", squeeze=False)
        for axes, one in zip(grid[0], states, strict=False):
            for run, flags in list(zip(one.runs, one.rings, strict=True))[:_SHOWN]:
                for value, color in enumerate(_STATES.values()):
                    inside = np.where(flags == value, run.momentum, np.nan)
                    axes.plot(run.times, inside, color=color, linewidth=0.8)
            axes.set(title=f"{100.0 * one.fill:.3g} % fill", xlabel=labels.TIME)
        grid[0, 0].set_ylabel(labels.TURNING)
        for axes in grid[1]:
            axes.remove()
        _draw_branches(states, [figure.add_subplot(2, 3, 4 + place) for place in range(3)])
    return figure


# Runs of a fill that are drawn over time.
_SHOWN = 5
_STATES = {"circulating": "C0", "ring": "C1"}


def _draw_branches(states: Sequence["TwoStates"], panels: Sequence["Axes"]) -> None:
    share, power, ratio = panels
    fills = [100.0 * one.fill for one in states]
    share.plot(fills, [100.0 * one.share for one in states], "o-", color=_STATES["ring"])
    share.set(ylabel="time as a ring [%]", ylim=(-4.0, 104.0))
    for name, color in _STATES.items():
        found = [
            (fill, state) for fill, one in zip(fills, states, strict=True) if (state := getattr(one, name))
        ]
        for axes, quantity in ((power, "power"), (ratio, "ratio")):
            estimates = [getattr(state, quantity) for _, state in found]
            halves = [one.interval().half_width if np.isfinite(one.error) else 0.0 for one in estimates]
            heights = [one.mean for one in estimates]
            axes.errorbar(
                [x for x, _ in found], heights, halves, fmt="o-", color=color, capsize=3.0, label=name
            )
    power.set_ylabel(labels.DRUM_SPECIFIC_POWER)
    ratio.set_ylabel(labels.GROSS_WORK_RATIO)
    power.legend()
    for axes in panels:
        axes.set(xlabel=labels.FILL, xticks=fills)


def _running(
    series: "pl.DataFrame", above: str, below: str | None = None, scale: float = 1.0
) -> tuple[Array, Array]:
    """Return times and running means of a rate over `scale`, or of the ratio of two."""
    time = series["time"].to_numpy()
    long = min(_LONG, float(time[-1] - time[0]) / 3.0)
    middle, rate = mean_rate(time, series[above].to_numpy(), long)
    if below is None:
        return middle, rate / scale
    _, under = mean_rate(time, series[below].to_numpy(), long)
    with np.errstate(divide="ignore", invalid="ignore"):
        return middle, np.where(under > 0.0, rate / under, np.nan)
