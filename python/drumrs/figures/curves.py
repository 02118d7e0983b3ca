"""Curves with error bars: one frame of points in, axes drawn."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from drumrs.figures.shared import drumrs_style, line_colors, new_figure, write_at_ends

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = ("o", "s", "^", "D")
_SIZE = (5.6, 3.5)  # inches


@dataclass(frozen=True)
class Labels:
    """What stands at the axes, and how the values are shown.

    Attributes
    ----------
    x, y
        Labels of the axes, with units.
    x_scale
        What values of x are multiplied with: 100 for per cent.
    from_zero
        Whether the vertical axis starts at 0, so that heights compare.
    """

    x: str
    y: str
    x_scale: float = 1.0
    from_zero: bool = True


def curves(points: "pl.DataFrame", labels: Labels) -> "Figure":
    """Draw means with their 95 % intervals, one line a label.

    Open markers are of loads that drift, that is, whose averages have not settled. Where seeds disagree, each is a
    faint dot.

    Parameters
    ----------
    points
        One row a point: ``label``, ``x``, ``mean``, ``half_width`` (not finite where unknown), ``drifting``,
        ``disagree``, and ``values``, the list of the seeds' own means.
    labels
        Labels of the axes.

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> import polars
    >>> from drumrs import figures
    >>> rows = {"label": ["bare drum"] * 2, "x": [0.1, 0.2], "mean": [0.8, 1.1], "half_width": [0.1, 0.1]}
    >>> rows |= {"drifting": [False] * 2, "disagree": [False] * 2, "values": [[0.8], [1.1]]}
    >>> labels = figures.Labels("fill [%]", "specific power [W/kg]", x_scale=100.0)
    >>> figure = figures.curves(polars.DataFrame(rows), labels)
    """
    if points.is_empty():
        raise ValueError("points is empty, but must hold at least one point")
    with drumrs_style():
        figure = new_figure(*_SIZE)
        axes = figure.subplots()
        draw_curves(axes, points, labels)
    return figure


def draw_curves(axes: "Axes", points: "pl.DataFrame", labels: Labels) -> None:
    """Draw the curves of `curves` into axes."""
    import polars as pl

    colors = line_colors()
    ends: list[tuple[float, str, str]] = []
    # Where the first curve ends all can still be compared: labels in that order are not mistaken for each other's.
    last = min(float(x) for x in points.group_by("label").agg(pl.col("x").max())["x"])
    for k, label in enumerate(points["label"].unique(maintain_order=True)):
        rows = points.filter(points["label"] == label).sort("x")
        color = colors[k % len(colors)]
        _draw_line(axes, rows, labels.x_scale, {"color": color, "marker": _MARKERS[k % len(_MARKERS)]})
        height = np.interp(last, rows["x"].to_numpy(), rows["mean"].to_numpy())
        ends.append((float(height), str(label), color))
    axes.set(xlabel=labels.x, ylabel=labels.y)
    axes.xaxis.set_major_locator(MaxNLocator(steps=[1, 2, 5, 10]))
    if labels.from_zero:
        axes.set_ylim(bottom=min(0.0, float(points["mean"].min() or 0.0)))  # type: ignore[arg-type]
    if points["drifting"].any():
        say_above(axes, "open: the load drifts")
    write_at_ends(axes, ends)


def say_above(axes: "Axes", text: str) -> None:
    """Write a note above axes, after what stands there."""
    notes = [note for note in (axes.get_title(loc="left"), text) if note]
    axes.set_title("; ".join(notes), loc="left", fontsize="small", color="0.35")


def _draw_line(axes: "Axes", rows: "pl.DataFrame", scale: float, look: Mapping[str, Any]) -> None:
    x, mean = scale * rows["x"].to_numpy(), rows["mean"].to_numpy()
    known = np.isfinite(rows["half_width"].to_numpy())
    bars = np.where(known, rows["half_width"].to_numpy(), 0.0)
    axes.errorbar(x, mean, yerr=bars, fmt="none", ecolor=look["color"], elinewidth=1.0, capsize=2.0)
    axes.plot(x, mean, color=look["color"], linewidth=1.0, zorder=2)
    for drifting, face in ((False, look["color"]), (True, "white")):
        chosen = rows["drifting"].to_numpy() == drifting
        axes.plot(
            x[chosen], mean[chosen], linestyle="none", markersize=4.5, markerfacecolor=face, zorder=3, **look
        )
    for at, values, apart in zip(x, rows["values"].to_list(), rows["disagree"].to_list(), strict=True):
        if apart:
            dots = axes.plot([at] * len(values), values, ".", color=look["color"], markersize=4.0)
            dots[0].set(alpha=0.45, zorder=1, markeredgewidth=0.0)
