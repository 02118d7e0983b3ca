"""What the load does along the outline of the drum: in color on the outline, and along each kind of part."""

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from drumrs.errors import ConfigError
from drumrs.figures.lifters import draw_lifter, draw_unrolled
from drumrs.figures.shared import Array, drumrs_style, line_colors, new_figure
from drumrs.measures import folded_lifter

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Values above this share of all bins have the last color, so that one bin does not use up the scale.
_TYPICAL = 0.98
_RIM = "rim"


def wall_profile(profile: "pl.DataFrame", column: str, label: str, *, clockwise: bool = False) -> "Figure":
    """Draw a column of the wall profile: on the drum's outline in color, and along its parts.

    Parameters
    ----------
    profile
        ``result.wall_profile``, or what `measures.wear` makes of it.
    column
        What is drawn.
    label
        Its name, with the unit.
    clockwise
        Whether the drum turned clockwise, which tells the leading faces of lifters from the trailing ones.

    Returns
    -------
    Figure
        On the left the outline in the drum's own frame, at its angle 0. On the right, in a drum whose lifters are
        alike, the column unrolled over one of them, face by face, and over the shell up to the next one: the mean over
        all lifters, within a band from the least to the greatest; one lifter is drawn large in the middle of the
        outline. In other drums it is drawn along the outline of each kind of part; the rim is drawn there where it is
        the only part.

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs import figures
    >>> places = {"x": [1.0, 0.0, -1.0, 0.0], "y": [0.0, 1.0, 0.0, -1.0]}
    >>> normals = {"normal_x": [-1.0, 0.0, 1.0, 0.0], "normal_y": [0.0, -1.0, 0.0, 1.0]}
    >>> bins = {"part": ["rim"] * 4, "arc_start": [0.0, 1.6, 3.1, 4.7], "arc_end": [1.6, 3.1, 4.7, 6.3]}
    >>> profile = pl.DataFrame({**bins, **places, **normals, "normal_impulse": [1.0, 2.0, 3.0, 2.0]})
    >>> figure = figures.wall_profile(profile, "normal_impulse", "normal impulse [N s/m]")
    >>> figure.axes[1].get_xlabel()
    'way along the rim [m]'
    """
    if profile.is_empty():
        raise ValueError("profile is empty, but must hold at least one bin")
    try:
        folded = folded_lifter(profile, column, clockwise=clockwise)
    except ConfigError:
        folded = None
    with drumrs_style():
        figure = new_figure(9.0, 3.9)
        grid = figure.add_gridspec(1, 2, width_ratios=(1.0, 1.1))
        left, right = (figure.add_subfigure(grid[0, k]) for k in (0, 1))
        values = profile[column].to_numpy()
        norm = Normalize(0.0, float(np.quantile(values, _TYPICAL)) or float(values.max()) or 1.0)
        outline = left.subplots()
        width = 5.0 if folded is None else 2.5
        lines = LineCollection(
            list(_bins(profile)), array=values, cmap="viridis", norm=norm, linewidths=width
        )
        lines.set_capstyle("butt")
        outline.add_collection(lines)
        outline.set(aspect="equal", xlabel="x in the drum’s frame [m]", ylabel="y in the drum’s frame [m]")
        outline.autoscale_view()
        if folded is not None:
            draw_lifter(outline, folded, norm)
            draw_unrolled(right, folded, label)
        else:
            along = right.subplots()
            _draw_parts(along, profile, column)
            along.set(ylabel=label, ylim=(0.0, None))
        left.colorbar(lines, ax=outline, location="left", shrink=0.8, pad=0.03, extend="max")
    return figure


def _bins(profile: "pl.DataFrame") -> Array:
    """Return each bin as a straight line along the outline, shape (bins, 2, 2)."""
    middles = profile.select("x", "y").to_numpy()
    normals = profile.select("normal_x", "normal_y").to_numpy()
    half = 0.5 * (profile["arc_end"] - profile["arc_start"]).to_numpy()[:, np.newaxis]
    tangents = half * np.column_stack([-normals[:, 1], normals[:, 0]])
    lines: Array = np.stack([middles - tangents, middles + tangents], axis=1)
    return lines


def _draw_parts(axes: "Axes", profile: "pl.DataFrame", column: str) -> None:
    kinds = dict(_kinds(profile, column))
    shown = {kind: found for kind, found in kinds.items() if kind != _RIM} or kinds
    for (kind, (edges, values)), color in zip(shown.items(), line_colors() * len(shown), strict=False):
        count = len(values)
        name = kind if count == 1 else f"{kind}s, {count}"
        axes.stairs(values.mean(axis=0), edges, color=color, label=name, baseline=None, linewidth=1.3)
        if count > 1:
            band = {"baseline": values.min(axis=0), "fill": True, "alpha": 0.2, "linewidth": 0.0}
            axes.stairs(values.max(axis=0), edges, color=color, **band)
    many = len(shown) > 1
    name, (_, values) = next(iter(shown.items()))
    axes.set_xlabel("way along the outline [m]" if many else f"way along the {name} [m]")
    if many:
        axes.legend()
    elif len(values) > 1:
        axes.set_title(f"mean of {len(values)}; band: least and greatest", fontsize="small", color="0.35")


def _kinds(profile: "pl.DataFrame", column: str) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Give each kind of part, with the edges of its bins along the outline and a row of values for each part."""
    kinds: dict[tuple[str, int], list[pl.DataFrame]] = {}
    for rows in profile.partition_by("part", maintain_order=True):
        kind = re.sub(r" \d+$", "", str(rows["part"][0]))
        # Parts of a kind that differ in length, as those of a drawing may, are not averaged.
        kinds.setdefault((kind, rows.height), []).append(rows)
    several = [kind for kind, _ in kinds]
    for (kind, bins), members in kinds.items():
        name = kind if several.count(kind) == 1 else f"{kind} of {bins} bins"
        edges = np.append(members[0]["arc_start"].to_numpy(), members[0]["arc_end"][-1])
        yield name, (edges, np.array([rows[column].to_numpy() for rows in members]))
