"""How a load mixes: an index over the turns of the drum."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures.shared import Array, drumrs_style, line_colors, new_figure, write_at_ends

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from drumrs.measures import MixingRate


def mixing_curve(
    curves: Mapping[str, tuple[Array, Array]], fits: "Mapping[str, MixingRate] | None" = None
) -> "Figure":
    """Draw Lacey's index over the turns of the drum: 0 apart, 1 as mixed as chance makes it.

    Parameters
    ----------
    curves
        What `measures.mixing_curve` returns, by the name of the coloring: turns, and the index with a row for each side
        of the cells. The line is the middle side's, the band reaches from the least to the greatest.
    fits
        What `measures.mixing_rate` returns, by the same names: drawn dashed.

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs import figures
    >>> turns = np.array([0.0, 1.0, 2.0])
    >>> figure = figures.mixing_curve({"side": (turns, np.array([[0.0, 0.5, 0.8]]))})
    >>> figure.axes[0].get_xlabel()
    'turns of the drum'
    """
    if not curves:
        raise ValueError("curves is empty, but must hold at least one")
    with drumrs_style():
        figure = new_figure(5.6, 3.5)
        axes = figure.subplots()
        axes.axhline(1.0, color="0.8", linewidth=0.8, zorder=0)
        ends = []
        for (name, (turns, index)), color in zip(curves.items(), line_colors() * len(curves), strict=False):
            middle = index[len(index) // 2]
            axes.fill_between(
                turns, index.min(axis=0), index.max(axis=0), color=color, alpha=0.15, linewidth=0
            )
            axes.plot(turns, middle, color=color, label=name)
            if fits and name in fits:
                axes.plot(turns, fits[name].at(turns - turns[0]), color=color, linestyle="--", linewidth=0.9)
            ends.append((float(np.mean(middle[-max(1, len(middle) // 20) :])), name, color))
        axes.set(xlabel="turns of the drum", ylabel="Lacey’s index of mixing")
        axes.set_title("0: apart; 1: as mixed as chance makes it", fontsize="small", color="0.35")
        write_at_ends(axes, ends)
    return figure
