"""Everything that a series tells of one run beyond its summary, as columns of a table."""

from typing import TYPE_CHECKING

from drumrs.analysis.blocks import Mean, SeriesWindow, mean_with_error, rate_with_error, ratio_with_error
from drumrs.analysis.drift import FALSE_ALARMS, drift, ratio_drift, state_switching
from drumrs.energies import losses

if TYPE_CHECKING:
    import polars as pl

_MEANS = (
    "drum_specific_power",
    "dissipated_normal_specific_power",
    "dissipated_sliding_specific_power",
    "dissipation_ratio",
    "work_ratio",
    "gross_work_ratio",
    "specific_angular_momentum",
)
_TESTS = (
    "drift",
    "drift_significance",
    "share_drift",
    "share_drift_significance",
    "share_switching",
    "share_switching_significance",
    "drifting",
)
# Names of what `statistics` returns.
STATISTICS = (*(f"{name}{ending}" for name in _MEANS for ending in ("", "_error")), *_TESTS)

# Changes below this do not matter, however sure.
_MATTERS = 0.01
_LOSSES = ("dissipated_normal", "dissipated_sliding")
_GROSS_WORK = ("gross_work_normal", "gross_work_tangential")


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
        ``drum_specific_power``, ``dissipated_normal_specific_power``, ``dissipated_sliding_specific_power``: what the
        drum puts in, and what normal damping and sliding take [W/kg].
        ``dissipation_ratio``: the latter two over each other.
        ``work_ratio``: the same with what springs store counted as well.
        ``gross_work_ratio``: the same with loading and unloading both counted, where that was recorded.
        ``specific_angular_momentum`` [m²/s], 0 for a load that stays where it is, however it rocks.
        All with ``…_error``; `None` where not defined.
        ``drift``: change of the drum's specific power within the window over its mean, ``share_drift``: that of the
        normal damping's share in all dissipation, ``share_switching``: how much that share differs between parts of
        the run; each with the ``…_significance`` of `Drift` and `StateSwitching`.
        ``drifting``: whether one of the three is beyond chance (one in a thousand) and above a hundredth.
    """
    return {**means_with_errors(series, window, mass), **_steadiness(series, window)}


def means_with_errors(
    series: "pl.DataFrame", window: tuple[float, float], mass: float
) -> dict[str, float | None]:
    """Return those of `statistics` that are means, with their errors."""
    means: dict[str, Mean | None] = {
        f"{name}_specific_power": _scaled(rate_with_error(series, column, window), mass)
        for name, column in {"drum": "drum_work", **{loss: loss for loss in _LOSSES}}.items()
    }
    means["dissipation_ratio"] = ratio_with_error(series, *_LOSSES, window)
    means["work_ratio"] = ratio_with_error(series, "normal_work", "tangential_work", window)
    is_recorded = set(_GROSS_WORK) <= set(series.columns)
    means["gross_work_ratio"] = ratio_with_error(series, *_GROSS_WORK, window) if is_recorded else None
    means["specific_angular_momentum"] = _scaled(_sampled(series, "angular_momentum", window), mass)
    columns: dict[str, float | None] = {}
    for name, mean in means.items():
        columns[name] = mean.value if mean is not None else None
        columns[f"{name}_error"] = mean.error if mean is not None else None
    return columns


def _steadiness(series: "pl.DataFrame", window: tuple[float, float]) -> dict[str, float | bool | None]:
    # A share, not a ratio: it means as much near 0 as near 1.
    taken = series.select(losses(series.columns)).sum_horizontal().alias("dissipated")
    whole = series.with_columns(taken)
    share = (_LOSSES[0], "dissipated", window)
    mean, power = ratio_with_error(whole, *share), drift(series, window)
    share_drift, switching = ratio_drift(whole, *share), state_switching(whole, *share)
    changes = {
        "drift": (power.change, power.significance) if power else None,
        "share_drift": (share_drift.change * mean.value, share_drift.significance)
        if share_drift and mean
        else None,
        "share_switching": (switching.spread, switching.significance) if switching else None,
    }
    columns: dict[str, float | bool | None] = {}
    for name, found in changes.items():
        columns[name], columns[f"{name}_significance"] = found or (None, None)
    columns["drifting"] = any(
        found is not None and abs(found[0]) > _MATTERS and found[1] < FALSE_ALARMS
        for found in changes.values()
    )
    return columns


def _scaled(mean: Mean, mass: float) -> Mean:
    return Mean(mean.value / mass, mean.error / mass if mean.error is not None else None)


def _sampled(series: "pl.DataFrame", column: str, window: tuple[float, float]) -> Mean:
    """Return the mean of a state over the samples that close the intervals of a window."""
    rows = SeriesWindow.of(series, window)
    return mean_with_error(rows.column(column)[1:], rows.interval)
