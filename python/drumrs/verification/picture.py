"""Measured points on the curves that they must lie on."""

from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.figures import INK, drumrs_style, line_colors, new_figure
from drumrs.verification.evidence import Panel, Trace

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIZE = (5.0, 3.1)  # inches
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
# More points than this are drawn small.
_MANY = 40


def agreement(panel: Panel) -> "Figure":
    """Draw a case of the verification: points as measured, curves as expected.

    Parameters
    ----------
    panel
        Points, curves, and labels of the axes.
    """
    with drumrs_style():
        figure = new_figure(*_SIZE)
        axes = figure.subplots()
        looks = zip(cycle(line_colors()), cycle(_MARKERS), strict=False)
        for trace in panel.traces:
            _draw(axes, trace, *(next(looks) if np.size(trace.x) else (INK, "")))
        axes.set(xlabel=panel.x, ylabel=panel.y)
        if panel.logarithmic:
            axes.set(xscale="log", yscale="log")
        if any(trace.label for trace in panel.traces):
            axes.legend(fontsize="small")
    return figure


def _draw(axes: "Axes", trace: Trace, color: str, marker: str) -> None:
    """Draw a trace; its curve lies under the points, in ink where it stands for several."""
    points = np.size(trace.x)
    if trace.curve is not None:
        label = trace.label if not points else None
        axes.plot(*trace.curve, color=color, linewidth=1.0, alpha=0.8, label=label, zorder=1)
    if points:
        size = 4.5 if points <= _MANY else 2.5
        look: dict[str, Any] = {"markersize": size, "markerfacecolor": "white", "markeredgewidth": 1.0}
        axes.plot(
            trace.x, trace.y, linestyle="none", marker=marker, color=color, label=trace.label or None, **look
        )
