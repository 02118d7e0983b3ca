"""Summaries phase by phase: what the drum did in each phase of a program, by the definitions of the summary."""

from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis.blocks import summary_of
from drumrs.analysis.statistics import means_with_errors
from drumrs.registry import recorded

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config
    from drumrs.result import Result

# What a summary tells of the window that it was asked for, and of the whole run.
_NOT_SHOWN = ("window_start", "window_end", "energy_residual")
# Samples below which there is no mean.
_FEWEST = 2
# How the name of a column of one part of the drum ends that every part has.
_OF_PART = "_force_x"


def phases(result: "Result") -> "pl.DataFrame":
    """Return a row for each phase that the drum went through, in the order of time.

    Parameters
    ----------
    result
        A run whose configuration has ``rotation.phase``.

    Returns
    -------
    polars.DataFrame
        ``phase`` is the name; ``number`` counts how often it has come, from 1 on; ``start`` and ``end`` [s].
        ``phase_work`` [J/m] and ``phase_specific_work`` [J/kg] are the work of the drum in that time; a kWh is 3.6 MJ.
        The rest are means as the summary and the table of a sweep have them, errors with those that have one; null
        where a phase holds fewer than two samples. A phase begins and ends at the samples nearest to its ends, so the
        work of all phases is that of the run. There is no row without phases.

    Examples
    --------
    >>> import drumrs
    >>> program = [{"name": "tumble", "duration": 0.2, "rpm": 54.0}, {"name": "stop", "duration": 0.1, "rpm": 0.0}]
    >>> config = drumrs.baseline(fill=0.1).replace({"rotation.phase": program, "run.duration": 0.3})
    >>> table = drumrs.phases(drumrs.run(config, progress=False))
    >>> table["phase"].to_list(), table["end"].round(1).to_list()
    (['tumble', 'stop'], [0.2, 0.3])
    >>> table.columns[4:7]
    ['phase_work', 'phase_specific_work', 'drum_torque']
    """
    return phases_of(result.config, result.series)


def phases_of(config: "Config", series: "pl.DataFrame") -> "pl.DataFrame":
    """Return the table of `phases` from a configuration and its series."""
    import polars as pl

    rows: list[dict[str, Any]] = []
    come: dict[str, int] = {}
    times = series["time"].to_numpy()
    for interval in config.rotation.intervals:
        if not len(times) or interval.start >= times[-1]:
            break
        come[interval.name] = come.get(interval.name, 0) + 1
        end = min(interval.end, float(times[-1]))
        row = {"phase": interval.name, "number": come[interval.name], "start": interval.start, "end": end}
        nearest = [int(np.abs(times - time).argmin()) for time in (interval.start, end)]
        rows.append(row | _means(config, series[nearest[0] : nearest[1] + 1]))
    return pl.DataFrame(rows, infer_schema_length=None)


def _means(config: "Config", rows: "pl.DataFrame") -> dict[str, float | None]:
    if len(rows) < _FEWEST:
        return {}
    mass = mass_of(config, rows)
    window = (float(rows["time"][0]), float(rows["time"][-1]))
    summary = summary_of_rows(config, rows, mass)
    work = float(rows["drum_work"][-1] - rows["drum_work"][0])
    told = {name: value for name, value in summary.items() if name not in _NOT_SHOWN}
    energy = {"phase_work": work, "phase_specific_work": work / mass}
    means = means_with_errors(rows, window, mass)
    return energy | told | {name: value for name, value in means.items() if name not in told}


def summary_of_rows(config: "Config", rows: "pl.DataFrame", mass: float) -> dict[str, float | None]:
    """Return the numbers of a `Summary` that rows of a run's series tell, for a load of this mass [kg/m]."""
    parts = [name.removesuffix(_OF_PART) for name in rows.columns if name.endswith(_OF_PART)]
    columns = [column.name for column in recorded(parts, config.run.record)]
    return summary_of(rows.select(columns), parts, config.run.record, mass)


def mass_of(config: "Config", rows: "pl.DataFrame") -> float:
    """Return the mass of the load [kg/m]: power over specific power, for a load that was given may have another one."""
    place = rows["drum_power"].abs().arg_max() or 0
    specific = rows["drum_specific_power"][place]
    return float(rows["drum_power"][place] / specific) if specific else config.derived.load_mass
