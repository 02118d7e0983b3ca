"""The figure of a calibration: each parameter's probability, pair by pair, and what was measured beside the model."""

import textwrap
from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures import INK, drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.decide.measurement import Experiment
    from drumrs.decide.posterior import Posterior

_PANEL, _BINS = 2.6, 30
_LONGEST_NAME = 24
# Parts of the probability within the lines about the likeliest pairs.
_LEVELS = (0.9, 0.5)


def draw(experiment: "Experiment", posterior: "Posterior") -> "Figure":
    """Draw a calibration: a corner plot, and below it how far the model is from each measurement."""
    keys = posterior.space.keys
    count = len(keys)
    samples = posterior.in_units(posterior.samples)
    ends = [(one.low, one.high) for one in posterior.space.parameters]
    with drumrs_style():
        below = 0.4 * len(experiment.measured) + 0.8
        figure = new_figure(max(5.0, _PANEL * count), _PANEL * count + below)
        corner, fits = figure.subfigures(2, 1, squeeze=False, height_ratios=[_PANEL * count, below])[:, 0]
        panels = corner.subplots(count, count, squeeze=False)
        for row in range(count):
            for column in range(count):
                axes = panels[row, column]
                if column > row:
                    axes.set_axis_off()
                    continue
                if row == column:
                    axes.hist(samples[:, row], _BINS, range=ends[row], color=line_colors()[0], density=True)
                    axes.set_yticks([])
                else:
                    _pair(axes, samples[:, column], samples[:, row], (ends[column], ends[row]))
                axes.set_xlim(ends[column])
                if row == count - 1:
                    axes.set_xlabel(_two_lines(keys[column]))
                if column == 0 and row > 0:
                    axes.set_ylabel(_two_lines(keys[row]))
        _fits(fits.subplots(), experiment, posterior)
    return figure


def _two_lines(key: str) -> str:
    table, _, name = key.rpartition(".")
    return f"{table}.\n{name}"


def _pair(
    axes: "Axes", x: np.ndarray, y: np.ndarray, ends: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    share, x_edges, y_edges = np.histogram2d(x, y, _BINS, range=ends)
    axes.pcolormesh(x_edges, y_edges, share.T, cmap="Blues")
    ordered = np.sort(share.ravel())[::-1]
    within = np.cumsum(ordered) / share.sum()
    levels = sorted({float(ordered[np.searchsorted(within, level)]) for level in _LEVELS})
    centers = (0.5 * (edges[1:] + edges[:-1]) for edges in (x_edges, y_edges))
    axes.contour(*centers, share.T, levels, colors=INK, linewidths=0.8)
    axes.set_ylim(ends[1])


def _fits(axes: "Axes", experiment: "Experiment", posterior: "Posterior") -> None:
    """Draw, for each measurement, the model's mean and scatter over the error of the measurement."""
    names, off = [], []
    for k, one in enumerate(experiment.measured):
        mean, scatter, own = posterior.predict(k)
        error = posterior.errors[k]
        off.append(((mean - posterior.values[k]) / error, np.hypot(scatter, own) / error))
        names.append(textwrap.fill(str(one), _LONGEST_NAME))
    places = np.arange(len(names))
    axes.axvspan(-1.0, 1.0, color="0.9")
    axes.axvline(0.0, color=INK, linewidth=0.8)
    axes.errorbar(
        [x for x, _ in off], places, xerr=[error for _, error in off], fmt="o", color=line_colors()[1]
    )
    axes.set(yticks=places, yticklabels=names, xlabel="model less measurement, over its error")
    axes.set_ylim(len(names) - 0.5, -0.5)
