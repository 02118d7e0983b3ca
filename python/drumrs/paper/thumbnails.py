"""A small picture for each claim: the curves that it speaks of, and the bands in which it wants them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures import labels
from drumrs.figures.shared import drumrs_style, line_colors, new_figure
from drumrs.paper.claims import CLAIMS
from drumrs.paper.curves import Curve, Results
from drumrs.paper.verdict import Band, MissingError, Verdict
from drumrs.registry import quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIZE = (3.4, 2.0)  # inches
_AXES = {
    "fill": labels.FILL,
    "size": "D/d",
    "friction": "μ",
    "restitution": "e",
}
_SHADE = 0.16


def thumbnail(verdict: Verdict, results: Results) -> "Figure":
    """Draw the curves of a claim with its bands; drifting points are open.

    Parameters
    ----------
    verdict
        The verdict, whose parts say where they want the curves.
    results
        The study.

    Raises
    ------
    MissingError
        Where no curve has a point.
    """
    axis, column = next(claim.shows for claim in CLAIMS if claim.number == verdict.claim)
    column = results.ratio if column == "N/T" else column
    curves = [curve for curve in results.shown(axis, column) if curve.points]
    if not curves:
        raise MissingError(f"every point of {column} against {axis}")
    bands = [
        band for part in verdict.parts for band in part.bands if (band.axis, band.column) == (axis, column)
    ]
    with drumrs_style():
        figure = new_figure(*_SIZE)
        axes = figure.subplots()
        _draw(axes, curves, bands, 100.0 if axis == "fill" else 1.0)
        axes.set_xlabel(_AXES[axis], fontsize="small")
        axes.set_ylabel(quantity(column).label, fontsize="small")
    return figure


def _draw(axes: "Axes", curves: Sequence[Curve], bands: Sequence[Band], scale: float) -> None:
    for curve, color in zip(curves, line_colors(), strict=False):
        x, intervals = scale * curve.x, [one.interval() for one in curve.estimates]
        known = [one.half_width if np.isfinite(one.half_width) else 0.0 for one in intervals]
        means = [one.mean for one in intervals]
        axes.errorbar(x, means, yerr=known, color=color, linewidth=0.9, elinewidth=0.7, label=curve.label)
        for drifting, face in ((False, color), (True, "white")):
            shown = [point.drifting == drifting for point in curve.points]
            at = (x[shown], np.array(means)[shown])
            axes.plot(*at, "o", color=color, markersize=2.6, markerfacecolor=face, markeredgewidth=0.7)
    low, high = axes.get_ylim()
    limits = [limit for band in bands for limit in band.high if np.isfinite(limit)]
    axes.set_ylim(min(0.0, low), max([high, *(1.05 * limit for limit in limits)]))
    colors = dict(zip((curve.label for curve in curves), line_colors(), strict=False))
    for band in bands:
        _shade(axes, band, scale, colors.get(band.label, "0.5"))
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(curves), fontsize="x-small")
    axes.tick_params(labelsize="x-small")


def _shade(axes: "Axes", band: Band, scale: float, color: str) -> None:
    """Fill a band as far as the axes reach; at a single point it is a bar."""
    x = scale * np.array(band.x)
    low, high = (np.clip(limit, *axes.get_ylim()) for limit in (band.low, band.high))
    if len(x) == 1:
        axes.vlines(x, low, high, color=color, alpha=2.0 * _SHADE, linewidth=7.0, zorder=0)
    else:
        axes.fill_between(x, low, high, color=color, alpha=_SHADE, linewidth=0.0, zorder=0)
