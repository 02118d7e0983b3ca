"""Everything that a series tells of one run beyond its summary, as columns of a table."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Mean, Stretch, block_error, rate_with_error, ratio_with_error
from drumrs.analysis.drift import FALSE_ALARMS, drift, ratio_drift, wandering

if TYPE_CHECKING:
    import polars as pl

_LOSSES = ("dissipated_normal", "dissipated_sliding")


def statistics(
    series: "pl.DataFrame", window: tuple[float, float], mass: float
) -> dict[str, float | bool | None]:
    """Return specific powers, ratios and drift over a window, with standard errors.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Start and end [s].
    mass
        Mass of the load per meter of depth [kg/m].

    Returns
    -------
    dict
        ``drum_specific_power``, ``normal_specific_power``, ``tangential_specific_power``: what the drum puts in, and
        what normal damping and sliding take [W/kg].
        ``dissipation_ratio``: the latter two over each other.
        ``work_ratio``: work of the contacts' normal forces over that of their tangential forces.
        ``angular_momentum_per_mass`` [m²/s], 0 for a load that stays where it is, however it rocks.
        All with ``…_error``; `None` where not defined.
        ``drift`` [W/kg/s], ``drift_change``, ``drift_significance`` of the drum's specific power, and ``ratio_drift_…``
        of the dissipation ratio: see `Drift`.
        ``wandering_significance``: see `wandering`.
        ``drifting``: whether any of the three is below one in a thousand.
    """
    means: dict[str, Mean | None] = {
        f"{name}_specific_power": _scaled(rate_with_error(series, column, window), mass)
        for name, column in (
            ("drum", "work_drum"),
            ("normal", "dissipated_normal"),
            ("tangential", "dissipated_sliding"),
        )
    }
    means["dissipation_ratio"] = ratio_with_error(series, *_LOSSES, window)
    means["work_ratio"] = ratio_with_error(series, "work_normal", "work_tangential", window)
    means["angular_momentum_per_mass"] = _scaled(_sampled(series, "angular_momentum", window), mass)
    columns: dict[str, float | bool | None] = {}
    for name, mean in means.items():
        columns[name] = mean.value if mean is not None else None
        columns[f"{name}_error"] = mean.error if mean is not None else None
    return {**columns, **_steadiness(series, window, mass)}


def _steadiness(
    series: "pl.DataFrame", window: tuple[float, float], mass: float
) -> dict[str, float | bool | None]:
    power = drift(series, window)
    ratio = ratio_drift(series, *_LOSSES, window)
    columns: dict[str, float | bool | None] = {
        "drift": power.slope / mass if power is not None else None,
        "drift_change": power.change if power is not None else None,
        "drift_significance": power.significance if power is not None else None,
        "ratio_drift_change": ratio.change if ratio is not None else None,
        "ratio_drift_significance": ratio.significance if ratio is not None else None,
        "wandering_significance": wandering(series, *_LOSSES, window),
    }
    tests = [value for name, value in columns.items() if name.endswith("_significance")]
    return {**columns, "drifting": any(value is not None and value < FALSE_ALARMS for value in tests)}


def _scaled(mean: Mean, mass: float) -> Mean:
    return Mean(mean.value / mass, mean.error / mass if mean.error is not None else None)


def _sampled(series: "pl.DataFrame", column: str, window: tuple[float, float]) -> Mean:
    """Return the mean of a quantity that is sampled, not integrated."""
    steps = Stretch.of(series, window)
    values = steps.values(column)
    spread = block_error(values, steps.interval)
    return Mean(float(np.mean(values)), spread.error if spread is not None else None)
