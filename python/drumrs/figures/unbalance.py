"""How far a load is off balance: a histogram, over time or over runs."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.figures.shared import INK, drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# The quantiles that are marked.
_MARKS = {"median": 0.5, "95 %": 0.95}


def unbalance_histogram(unbalances: ArrayLike, *, limit: float | None = None, of: str = "frames") -> "Figure":
    """Draw how often the unbalance has which size, with its median, and what 95 % of the values stay below.

    Parameters
    ----------
    unbalances
        Lengths of `measures.unbalance_vectors`, frame by frame, or one value for each run [kg m per m of depth].
    limit
        What the machine puts up with, drawn where it is given.
    of
        What the values are of, for the axis: "frames" or "runs".

    Raises
    ------
    ValueError
        Where there is nothing to draw.

    Examples
    --------
    >>> from drumrs import figures
    >>> figure = figures.unbalance_histogram([0.1, 0.2, 0.2, 0.4], limit=0.3, of="runs")
    >>> [text.get_text() for text in figure.axes[0].texts]
    ['median 0.2', '95 % 0.37', 'limit 0.3']
    """
    values = np.asarray(unbalances, dtype=np.float64)
    if not values.size:
        raise ValueError("unbalances is empty, but must hold at least one value")
    with drumrs_style():
        figure = new_figure(5.6, 3.3)
        axes = figure.subplots()
        reach = 1.02 * max(float(values.max()), limit or 0.0) or 1.0
        share = np.full(values.size, 100.0 / values.size)
        axes.hist(values, bins=30, range=(0.0, reach), weights=share, color=line_colors()[0])
        marks = {name: float(np.quantile(values, share)) for name, share in _MARKS.items()}
        top = 1.18 * axes.get_ylim()[1]
        axes.set_ylim(top=top)
        for row, (name, at) in enumerate({**marks, **({} if limit is None else {"limit": limit})}.items()):
            axes.axvline(at, color=INK, linewidth=1.0, linestyle="-" if name == "limit" else "--")
            place = (at, top * (1.0 - 0.08 * row))
            axes.annotate(
                f"{name} {at:.3g}", place, (3.0, 0.0), textcoords="offset points", va="top", color=INK
            )
        axes.set(xlabel="unbalance |U| [kg m per m of depth]", ylabel=f"share of the {of} [%]")
    return figure
