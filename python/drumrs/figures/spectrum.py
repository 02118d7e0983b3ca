"""Spectra of collision energies: how often, and which share of the power."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.figures.shared import drumrs_style, line_colors, log_scale, new_figure

if TYPE_CHECKING:
    from collections.abc import Mapping

    import polars as pl
    from matplotlib.figure import Figure


def collision_spectrum(spectra: "Mapping[str, pl.DataFrame]", unit: str = "J/m") -> "Figure":
    """Draw spectra of collision energies: the rate by energy, and the share of the power above an energy.

    Parameters
    ----------
    spectra
        What `measures.collision_spectrum` returns, by the name that stands in the picture.
    unit
        Unit of the energies: J/kg where masses were given.

    Raises
    ------
    ValueError
        Where no spectrum has a collision.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs import figures, measures
    >>> contacts = pl.DataFrame({"particle": [0, 1, 2], "dissipated_normal": [0.02, 0.3, 0.5]})
    >>> spectrum = measures.collision_spectrum(contacts, mass=2.0, duration=1.0, kind="normal")
    >>> figure = figures.collision_spectrum({"normal": spectrum})
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['collisions in a bin [1/(kg s)]', 'share of the power above [%]']
    """
    shown = {name: rows for name, rows in spectra.items() if not rows.is_empty()}
    if not shown:
        raise ValueError("spectra hold no collision, but must hold one at least")
    with drumrs_style():
        figure = new_figure(9.0, 3.4)
        rates, shares = figure.subplots(1, 2)
        for (name, rows), color in zip(shown.items(), line_colors() * len(shown), strict=False):
            edges = np.append(rows["energy_low"].to_numpy(), rows["energy_high"][-1])
            rate, error = rows["rate"].to_numpy(), rows["rate_error"].to_numpy()
            # A bin without a collision has no place on a logarithmic axis.
            rates.stairs(np.where(rate > 0.0, rate, np.nan), edges, color=color, label=name, linewidth=1.3)
            rates.errorbar(
                np.sqrt(edges[:-1] * edges[1:]), rate, error, fmt="none", ecolor=color, elinewidth=0.7
            )
            shares.plot(edges[:-1], 100.0 * rows["share_above"].to_numpy(), color=color, label=name)
        rates.set(ylabel="collisions in a bin [1/(kg s)]")
        log_scale(rates, "x", "y")
        log_scale(shares, "x")
        shares.set(ylabel="share of the power above [%]", ylim=(0.0, 103.0))
        for axes in (rates, shares):
            axes.set_xlabel(f"energy of a collision [{unit}]")
        shares.legend(loc="lower left")
    return figure
