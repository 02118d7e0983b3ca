"""How often impacts happen in a window and what they take, in all and at each part of the drum, with errors."""

from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array, Mean, mean_with_error
from drumrs.measures.recorded import part_names
from drumrs.measures.spectra import KINDS, impacts

if TYPE_CHECKING:
    import polars as pl

# A window is cut into so many intervals, whose blocks give the errors.
_INTERVALS = 256
# Fewer pieces for an energy, each of which must hold impacts.
_PIECES = 16


def impact_rates(
    contacts: "pl.DataFrame | None", window: tuple[float, float], mass: float, collision_time: float
) -> dict[str, Mean]:
    """Return how often impacts happen in a window, and what they take.

    An impact is a contact that is over within three collision times, see `impacts`; it counts when it begins. What it
    takes is what damping, sliding and rolling dissipate in it.

    Parameters
    ----------
    contacts
        ``result.contacts``.
    window
        Start and end [s].
    mass
        Mass of the load [kg/m].
    collision_time
        Duration of a collision [s], such as ``config.derived.bundle.collision_time``.

    Returns
    -------
    dict
        By name of the registry, with standard errors: ``impact_rate`` [1/(kg s)], ``impact_specific_power`` [W/kg];
        ``median_impact_energy`` [J/m], above which impacts take half of that power; ``drum_impact_rate`` and
        ``drum_impact_specific_power``, of those that meet the drum, and likewise of each part of it, such as
        ``rim_impact_rate``. Impacts below ``run.contact_floor`` are in none of them.

    Raises
    ------
    ConfigError
        Where contacts were not recorded.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import impact_rates
    >>> config = drumrs.baseline(fill=0.1).softer(100.0).replace({"run.record": ["contacts"], "run.duration": 0.5})
    >>> result, bundle = drumrs.run(config, progress=False), config.derived.bundle
    >>> found = impact_rates(result.contacts, (0.0, 0.5), config.derived.load_mass, bundle.collision_time)
    >>> 0.0 < found["rim_impact_rate"].value == found["drum_impact_rate"].value < found["impact_rate"].value
    True
    """
    import polars as pl

    table = impacts(contacts, collision_time)
    table = table.filter((pl.col("opened") >= window[0]) & (pl.col("opened") < window[1]))
    table = table.with_columns(energy=pl.sum_horizontal(KINDS["total"]))
    at_part = table["part"].to_physical().to_numpy()
    kinds = {"": np.ones(len(table), dtype=bool), "drum_": table["part"].is_not_null().to_numpy()}
    kinds |= {f"{name}_": at_part == place for place, name in enumerate(part_names(table["part"]))}
    times, energies = table["opened"].to_numpy(), table["energy"].to_numpy()
    found = {}
    for kind, chosen in kinds.items():
        of_kind = times[chosen]
        found[f"{kind}impact_rate"] = _rate(of_kind, np.ones(len(of_kind)), window, mass)
        found[f"{kind}impact_specific_power"] = _rate(of_kind, energies[chosen], window, mass)
    return {**found, "median_impact_energy": _median_energy(times, energies, window)}


def _rate(times: Array, amounts: Array, window: tuple[float, float], mass: float) -> Mean:
    """Return what comes at these times, per kilogram and second."""
    sums, _ = np.histogram(times, _INTERVALS, window, weights=amounts)
    interval = (window[1] - window[0]) / _INTERVALS
    return mean_with_error(sums / (mass * interval), interval)


def _median_energy(times: Array, energies: Array, window: tuple[float, float]) -> Mean:
    piece = np.minimum(((times - window[0]) / (window[1] - window[0]) * _PIECES).astype(int), _PIECES - 1)
    values = [_half(energies[piece == k]) for k in range(_PIECES)]
    known = np.isfinite(values).all()
    error = mean_with_error(values, (window[1] - window[0]) / _PIECES).error if known else None
    return Mean(_half(energies), error)


def _half(energies: Array) -> float:
    """Return the energy of the impact with which the sum, from the greatest down, comes to a half of all."""
    falling = np.sort(energies)[::-1]
    sums = np.cumsum(falling)
    return float(falling[np.searchsorted(sums, 0.5 * sums[-1])]) if len(sums) and sums[-1] > 0.0 else np.nan
