"""The figure of the inference: what the sentences leave, pair by pair of lengths, and the baffles themselves."""

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures import INK, drumrs_style, line_colors, new_figure
from drumrs.paper.shape import BASES, HEIGHTS, MARKED, RADIUS, Shape

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.paper.baffle.findings import Inference

_NAMES = ("height [cm]", "base [cm]", "tip [cm]")
_RANGES = (HEIGHTS, BASES, (0.0, BASES[1]))
_BINS = 25
_MARKERS = ("^", "s", "D")
_CM = 100.0


def draw(inference: "Inference") -> "Figure":
    """Draw the posterior of height, base and tip with the shapes that were run, and the cross-sections of the best."""
    with drumrs_style():
        figure = new_figure(9.0, 8.0)
        panels = figure.subplots(2, 2).ravel()
        for axes, (x, y) in zip(panels, combinations(range(3), 2), strict=False):
            _pair(axes, inference, x, y)
        panels[0].legend(loc="upper right", fontsize="small")
        _outlines(panels[-1], inference)
    return figure


def _pair(axes: "Axes", inference: "Inference", x: int, y: int) -> None:
    posterior = inference.posteriors[1.0]
    limits = [tuple(_CM * end for end in _RANGES[k]) for k in (x, y)]
    places = _CM * posterior.shapes
    axes.hist2d(places[:, x], places[:, y], bins=_BINS, range=limits, weights=posterior.weights, cmap="Greys")
    run, confirmed = (
        _CM * np.array([shape.lengths for shape in shapes])
        for shapes in (inference.scanned, inference.confirmed)
    )
    colors = line_colors()
    axes.plot(run[:, x], run[:, y], ".", color=colors[0], markersize=4, label="run with softer springs")
    axes.plot(
        *confirmed[:, [x, y]].T,
        "o",
        color=colors[1],
        markersize=7,
        fillstyle="none",
        label="run at full stiffness",
    )
    for marker, (name, shape) in zip(_MARKERS, MARKED.items(), strict=True):
        lengths = shape.lengths
        axes.plot(
            _CM * lengths[x], _CM * lengths[y], marker, color=INK, markersize=7, label=name, linestyle="none"
        )
    best = inference.best.lengths
    axes.plot(
        _CM * best[x], _CM * best[y], "*", color=colors[1], markersize=15, label="inferred", linestyle="none"
    )
    axes.set(xlabel=_NAMES[x], ylabel=_NAMES[y], xlim=limits[0], ylim=limits[1])


def _outlines(axes: "Axes", inference: "Inference") -> None:
    """Draw cross-sections upright on the rim: the inferred, the others that were confirmed, the assumed triangle."""
    colors = line_colors()
    half = np.arcsin(0.6 * BASES[1] / RADIUS)
    angles = np.linspace(-half, half, 100)
    axes.plot(_CM * RADIUS * np.sin(angles), _CM * RADIUS * (1.0 - np.cos(angles)), color=INK, label="rim")
    others = [shape for shape in inference.confirmed if shape not in {inference.best, *MARKED.values()}]
    for shape in others:
        axes.plot(
            *_outline(shape), color="0.75", linewidth=0.8, label="confirmed" if shape == others[0] else None
        )
    axes.plot(*_outline(MARKED["assumed triangle"]), "--", color=INK, label="assumed triangle")
    axes.plot(*_outline(inference.best), color=colors[1], linewidth=2.5, label=f"inferred: {inference.best}")
    axes.set(aspect="equal", xlabel="along the rim [cm]", ylabel="towards the axis [cm]")
    axes.legend(loc="upper right", fontsize="small")


def _outline(shape: Shape) -> tuple[np.ndarray, np.ndarray]:
    foot = RADIUS - np.sqrt(RADIUS**2 - 0.25 * shape.base**2)
    across = 0.5 * np.array([-shape.base, -shape.tip, shape.tip, shape.base])
    inwards = np.array([foot, shape.height, shape.height, foot])
    return _CM * across, _CM * inwards
