"""How deep discs press into each other, from the energy in the normal springs."""

import math
from typing import TYPE_CHECKING

from drumrs.analysis.blocks import Mean, SeriesWindow, ratio_of_sums

if TYPE_CHECKING:
    import polars as pl


def mean_overlap_ratio(
    series: "pl.DataFrame", window: tuple[float, float], stiffness: float, radius: float
) -> Mean | None:
    """Return the overlap over the radius, root mean square over contacts and time.

    √(2 ΣE_normal / (k n)) / r: all contacts count as if they had the linear spring that is given, those with the drum
    as well.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Start and end [s].
    stiffness
        Normal stiffness k of two discs [N/m per m].
    radius
        Radius r of a disc [m].

    Returns
    -------
    Mean or None
        `None` where nothing touches.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two samples.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.measures import mean_overlap_ratio
    >>> series = pl.DataFrame({"time": [0.0, 1.0], "elastic_normal": [0.0, 4.0], "contact_count": [0, 2]})
    >>> round(mean_overlap_ratio(series, (0.0, 1.0), stiffness=1e4, radius=0.1).value, 12)
    0.2
    """
    rows = SeriesWindow.of(series, window)
    energy = ratio_of_sums(*(rows.column(name)[1:] for name in ("elastic_normal", "contact_count")))
    if energy is None:
        return None
    value = math.sqrt(2.0 * energy.value / stiffness) / radius
    # Half the relative error, for it is a root.
    error = None if energy.error is None or not value else 0.5 * energy.error / energy.value * value
    return Mean(value, error)
