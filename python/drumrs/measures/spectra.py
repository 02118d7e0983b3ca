"""Spectra of collision energies, from the table of contacts: what each contact has taken, from first touch to opening.

Everything is per kilogram of load and second, so that drums of any size and runs of any length can be compared.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.errors import ConfigError
from drumrs.measures.recorded import required

if TYPE_CHECKING:
    from collections.abc import Mapping

    import polars as pl

# What a contact may take, by the names of the ledger's columns that are its sums.
KINDS = {
    "normal": ("dissipated_normal",),
    "tangential": ("dissipated_tangential",),
    "rolling": ("dissipated_rolling",),
    "total": ("dissipated_normal", "dissipated_tangential", "dissipated_rolling"),
}
# The columns of the ledger that a column of the table splits: there, sliding and its dashpot are two.
_LEDGER = {
    "dissipated_normal": ("dissipated_normal",),
    "dissipated_tangential": ("dissipated_sliding", "dissipated_tangential"),
    "dissipated_rolling": ("dissipated_rolling",),
}
# A contact that lasts longer than so many times a collision endures.
_ENDURES = 3.0


def impacts(contacts: "pl.DataFrame | None", collision_time: float) -> "pl.DataFrame":
    """Return the contacts that are over within three collision times; see `enduring` for the others.

    Those below ``run.contact_floor`` are in neither.

    Parameters
    ----------
    contacts
        ``result.contacts``.
    collision_time
        Duration of a collision [s], such as ``config.derived.bundle.collision_time``.

    Raises
    ------
    ConfigError
        Where contacts were not recorded.
    """
    import polars as pl

    table = required(contacts, "contacts", "a spectrum of impacts")
    return table.filter((pl.col("duration") <= _ENDURES * collision_time) & ~pl.col("is_open"))


def enduring(contacts: "pl.DataFrame | None", collision_time: float) -> "pl.DataFrame":
    """Return the contacts that last longer, and those still open: discs that lie do not pose as impacts.

    Parameters and errors are those of `impacts`.
    """
    import polars as pl

    table = required(contacts, "contacts", "a spectrum of enduring contacts")
    return table.filter((pl.col("duration") > _ENDURES * collision_time) | pl.col("is_open"))


def collision_spectrum(
    contacts: "pl.DataFrame | None",
    mass: float,
    duration: float,
    kind: str = "total",
    *,
    per_decade: int = 10,
    masses: ArrayLike | None = None,
) -> "pl.DataFrame":
    """Return how many contacts take how much energy, in bins of equal ratio.

    Parameters
    ----------
    contacts
        ``result.contacts``, or those of them that shall count, such as `impacts` or one pair of species.
    mass
        Mass of the load [kg/m].
    duration
        Time over which contacts were recorded [s].
    kind
        ``"normal"``: what normal damping takes; ``"tangential"``: sliding and tangential damping; ``"rolling"``; or
        ``"total"``.
    per_decade
        Bins in a decade.
    masses
        Masses of the discs [kg/m]: then energies are over the mass of the lighter partner [J/kg], as models of breakage
        have them.

    Returns
    -------
    polars.DataFrame
        One row a bin, rising: ``energy_low``, ``energy_high`` [J/m, or J/kg], powers of 10^(1/per_decade) for every run
        alike; ``events``, how many; ``rate`` [1/(kg s)] with ``rate_error``, that of a count of independent events;
        ``rate_above``, of all from ``energy_low`` on; ``power`` [W/kg], what they take; ``share_above``, of the power
        of all contacts, those below ``run.contact_floor`` included. Contacts that have taken nothing are in no bin.

    Raises
    ------
    ConfigError
        Where contacts were not recorded, or there is no such kind.

    Notes
    -----
    Discs coarser by a factor k than what they stand for meet 1/k² as often with k² the energy: no spectrum of enlarged
    balls is that of the balls.

    Examples
    --------
    >>> import polars as pl
    >>> from drumrs.measures import collision_spectrum
    >>> contacts = pl.DataFrame({"particle": [0, 1, 2], "dissipated_normal": [0.02, 0.5, 0.5]})
    >>> spectrum = collision_spectrum(contacts, mass=2.0, duration=1.0, kind="normal", per_decade=1)
    >>> spectrum["energy_low"].round(3).to_list(), spectrum["rate"].to_list()
    ([0.01, 0.1], [0.5, 1.0])
    """
    import polars as pl

    everything = required(contacts, "contacts", "a spectrum of collision energies")
    if kind not in KINDS:
        raise ConfigError("kind", kind, f"one of {', '.join(KINDS)}")
    everything = everything.with_columns(energy=pl.sum_horizontal(KINDS[kind]))
    # Those below the floor are one row, without particles: their energy counts, in no bin.
    table = everything.filter(pl.col("particle").is_not_null())
    energies = table["energy"].to_numpy()
    taken = energies > 0.0
    energies = energies[taken]
    marks = energies if masses is None else energies / _lighter(table.filter(taken), masses)
    bins = np.floor(per_decade * np.log10(marks)).astype(np.int64)
    first, last = (int(bins.min()), int(bins.max())) if len(bins) else (0, -1)
    count = last - first + 1
    events = np.bincount(bins - first, minlength=count)
    power = np.bincount(bins - first, energies, minlength=count) / (mass * duration)
    edges = 10.0 ** (np.arange(first, last + 2) / per_decade)
    above = np.cumsum(power[::-1])[::-1]
    whole = float(everything["energy"].sum()) / (mass * duration)
    return pl.DataFrame(
        {
            "energy_low": edges[:-1],
            "energy_high": edges[1:],
            "events": events,
            "rate": events / (mass * duration),
            "rate_error": np.sqrt(events) / (mass * duration),
            "rate_above": np.cumsum(events[::-1])[::-1] / (mass * duration),
            "power": power,
            "share_above": above / whole if count else above,
        }
    )


def _lighter(table: "pl.DataFrame", masses: ArrayLike) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """Return the mass of the lighter partner of each contact; the drum is the heavier one."""
    known = np.asarray(masses, dtype=np.float64)
    own = known[table["particle"].to_numpy()]
    other = table["other"]
    there = other.is_not_null().to_numpy()
    lighter: np.ndarray[tuple[int], np.dtype[np.float64]] = own.copy()
    lighter[there] = np.minimum(own[there], known[other.drop_nulls().to_numpy()])
    return lighter


def sum_rule(contacts: "pl.DataFrame | None", dissipated: "Mapping[str, float] | None") -> dict[str, float]:
    """Return by how much the sums over all contacts miss what was taken in all, over the sum of their magnitudes.

    Parameters
    ----------
    contacts
        ``result.contacts``, complete; ``result.wall_profile`` has the same columns, but contacts with the drum only.
    dissipated
        ``result.dissipated``.

    Returns
    -------
    dict
        ``dissipated_normal``, ``dissipated_tangential`` and ``dissipated_rolling``: round-off, some 10⁻¹³.

    Raises
    ------
    ConfigError
        Where contacts were not recorded.
    """
    table = required(contacts, "contacts", "the sum over contacts")
    found = {}
    for name, columns in _LEDGER.items():
        parts = table[name].to_numpy()
        taken = math.fsum((dissipated or {})[column] for column in columns)
        scale = max(math.fsum(np.abs(parts)), abs(taken))
        found[name] = (math.fsum(parts) - taken) / scale if scale else 0.0
    return found
