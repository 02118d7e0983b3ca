"""A column of the wall profile on one lifter: drawn large with the shell beside it, and unrolled face by face."""

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import LineCollection

from drumrs.figures.shared import STEEL, Array, line_colors

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import SubFigure

    from drumrs.measures import FoldedLifter

# Where the large lifter is drawn, in the middle of the outline: left, bottom, width, height.
_LARGE = (0.2, 0.25, 0.6, 0.5)
# Shell that is drawn beside it, over its own length.
_BESIDE = 0.5
# The shell's axes are at least this wide, over the lifter's, and at most.
_NARROW, _WIDE = 0.6, 1.2
_SHELL = "shell"


def draw_lifter(axes: "Axes", folded: "FoldedLifter", norm: "Normalize") -> None:
    """Draw one lifter large into the middle of the outline, standing on the shell, colored by the mean over all."""
    large = axes.inset_axes(_LARGE)
    lifter, shell = _parts(folded)
    lines = _lines(lifter)
    middle = lines.reshape(-1, 2).mean(axis=0)
    to_bottom = -0.5 * math.pi - math.atan2(middle[1], middle[0])
    length = float(lifter["end"][-1])
    near = np.concatenate([lines, _beside(shell, lines, _BESIDE * length)])
    values = np.concatenate([lifter["mean"].to_numpy(), _values_beside(shell, _BESIDE * length)])
    shown = LineCollection(
        list(_turned(near, to_bottom)), array=values, cmap="viridis", norm=norm, linewidths=5.0
    )
    shown.set_capstyle("butt")
    large.add_collection(shown)
    large.autoscale_view()
    large.set_aspect("equal")
    large.axis("off")
    large.set_title(f"mean of {folded.count} {folded.kind}s", fontsize="small", color="0.35")
    large.annotate(
        "",
        (0.75, -0.12),
        (0.25, -0.12),
        xycoords="axes fraction",
        textcoords="axes fraction",
        arrowprops={"arrowstyle": "->", "color": STEEL},
        annotation_clip=False,
    )


def draw_unrolled(figure: "SubFigure", folded: "FoldedLifter", label: str) -> None:
    """Draw the column along a lifter, from its trailing foot on, and along the shell up to the next one."""
    lifter, shell = _parts(folded)
    if shell.is_empty():
        each = [(figure.subplots(), lifter, f"way over a {folded.kind} [m]")]
    else:
        ratio = min(max(float(shell["end"][-1]) / float(lifter["end"][-1]), _NARROW), _WIDE)
        own, other = figure.subplots(1, 2, sharey=True, width_ratios=(1.0, ratio))
        each = [
            (own, lifter, f"way over a {folded.kind} [m]"),
            (other, shell, "way along the shell [m]"),
        ]
    color = line_colors()[0]
    for axes, rows, along in each:
        edges = np.append(rows["start"].to_numpy(), rows["end"][-1])
        axes.stairs(rows["mean"].to_numpy(), edges, color=color, baseline=None, linewidth=1.3)
        least, greatest = rows["least"].to_numpy(), rows["greatest"].to_numpy()
        axes.stairs(greatest, edges, color=color, baseline=least, fill=True, alpha=0.2, linewidth=0.0)
        axes.set(xlabel=along, xlim=(0.0, edges[-1]))
        _name_faces(axes, rows)
    each[0][0].set(ylabel=label, ylim=(0.0, None))


def _name_faces(axes: "Axes", rows: "pl.DataFrame") -> None:
    """Write the faces above the axes, and draw a line where one ends."""
    faces = rows["face"].to_list()
    begins = [0, *(k for k in range(1, len(faces)) if faces[k] != faces[k - 1]), len(faces)]
    for first, end in pairwise(begins):
        start, stop = float(rows["start"][first]), float(rows["end"][end - 1])
        if first:
            axes.axvline(start, color=STEEL, linewidth=0.8, linestyle=":")
        name = faces[first] if faces[first] in ("top", _SHELL) else f"{faces[first]}\nface"
        axes.annotate(
            name,
            (0.5 * (start + stop), 1.01),
            xycoords=("data", "axes fraction"),
            ha="center",
            va="bottom",
            fontsize="small",
            color="0.35",
        )


def _parts(folded: "FoldedLifter") -> "tuple[pl.DataFrame, pl.DataFrame]":
    """Return the bins of the lifter and those of the shell."""
    is_shell = folded.profile["face"] == _SHELL
    return folded.profile.filter(~is_shell), folded.profile.filter(is_shell)


def _lines(rows: "pl.DataFrame") -> Array:
    """Return each bin as a straight line, shape (bins, 2, 2)."""
    middles, normals = rows.select("x", "y").to_numpy(), rows.select("normal_x", "normal_y").to_numpy()
    half = 0.5 * (rows["end"] - rows["start"]).to_numpy()[:, np.newaxis]
    along = half * np.column_stack([-normals[:, 1], normals[:, 0]])
    lines: Array = np.stack([middles - along, middles + along], axis=1)
    return lines


def _beside(shell: "pl.DataFrame", lifter: Array, reach: float) -> Array:
    """Return the shell's bins within reach ahead of a lifter, and those behind it, which end at its trailing foot."""
    if shell.is_empty():
        return np.empty((0, 2, 2))
    ahead = _lines(shell.filter(shell["end"] <= reach))
    behind = _lines(shell.filter(shell["start"] >= shell["end"][-1] - reach))
    if not len(behind):
        return ahead
    # The shell is that ahead of the lifter: turned back until its end is at the trailing foot.
    foot = max(lifter[0], key=lambda point: float(np.hypot(*point)))
    last = behind[-1].mean(axis=0)
    step = float(shell["end"][-1] - shell["start"][-1]) / float(np.hypot(*last))
    angle = math.atan2(foot[1], foot[0]) - math.atan2(last[1], last[0]) - 0.5 * step
    return np.concatenate([ahead, _turned(behind, angle)])


def _values_beside(shell: "pl.DataFrame", reach: float) -> Array:
    """Return the means of the bins of `_beside`."""
    if shell.is_empty():
        return np.empty(0)
    ahead, behind = shell["end"] <= reach, shell["start"] >= shell["end"][-1] - reach
    values: Array = np.concatenate([shell.filter(chosen)["mean"].to_numpy() for chosen in (ahead, behind)])
    return values


def _turned(points: Array, angle: float) -> Array:
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    turned: Array = points @ turn
    return turned
