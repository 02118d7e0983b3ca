"""Where falling discs land: a rose of the energy of landings, by angle."""

import math
from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.ticker import MaxNLocator

from drumrs.figures.shared import drumrs_style, line_colors, new_figure

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure
    from matplotlib.projections.polar import PolarAxes

    from drumrs.figures.shared import Array

# Sectors of the rose: ten degrees each.
_SECTORS = 36
# On what discs land, with the marks that tell them apart without color.
_ONTO = {"drum": "", "load": "////"}


def landing_rose(flights: "pl.DataFrame", masses: "Array") -> "Figure":
    """Draw the energy of falls by the angle at which they land, on the drum and on the load.

    Parameters
    ----------
    flights
        What `measures.flights` returns; those that are falls count.
    masses
        Masses of the discs [kg/m], shape (n,).

    Returns
    -------
    Figure
        Angles are counter-clockwise from the horizontal, of a drum that turns counter-clockwise. The radius is the
        share of the energy of all falls, in sectors of ten degrees.

    Raises
    ------
    ValueError
        Where there is no fall.

    Examples
    --------
    >>> import numpy as np
        >>> import polars as pl
        >>> from drumrs import figures
        >>> falls = {"particle": [0, 1], "end_x": [-1.0, 0.0], "end_y": [0.0, -1.0], "speed": [2.0, 1.0]}
        >>> flights = pl.DataFrame({**falls, "onto": ["drum", "load"], "is_fall": [True, True]})
        >>> figure = figures.landing_rose(flights, masses=np.ones(2))
        >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        ['on the drum, 80 %', 'on the load, 20 %']
    """
    falls = flights.filter(flights["is_fall"])
    if falls.is_empty():
        raise ValueError("flights hold no fall, but must hold one at least")
    angles = np.arctan2(falls["end_y"].to_numpy(), falls["end_x"].to_numpy()) % (2.0 * math.pi)
    energies = 0.5 * masses[falls["particle"].to_numpy()] * falls["speed"].to_numpy() ** 2
    shares = 100.0 * energies / energies.sum()
    edges = np.linspace(0.0, 2.0 * math.pi, _SECTORS + 1)
    with drumrs_style():
        figure = new_figure(4.6, 4.2)
        axes = cast("PolarAxes", figure.add_subplot(projection="polar"))
        below = np.zeros(_SECTORS)
        for (onto, hatch), color in zip(_ONTO.items(), line_colors(), strict=False):
            chosen = (falls["onto"] == onto).to_numpy()
            values = np.histogram(angles[chosen], edges, weights=shares[chosen])[0]
            axes.bar(
                *(edges[:-1], values, np.diff(edges)),
                bottom=below,
                align="edge",
                color=color,
                edgecolor="white",
                linewidth=0.4,
                hatch=hatch,
                label=f"on the {onto}, {shares[chosen].sum():.0f} %",
            )
            below += values
        axes.set_rlabel_position(100.0)
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
        axes.yaxis.set_major_formatter("{x:g} %")
        axes.tick_params(axis="y", labelsize="small")
        axes.grid(color="0.88", linewidth=0.6)
        axes.set_title("energy of falls by where they land", fontsize="small", color="0.35")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=2)
    return figure
