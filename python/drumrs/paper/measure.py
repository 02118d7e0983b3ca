"""The table that figures and claims read: cases, summaries, and what series and frames tell beyond them."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs import analysis, measures
from drumrs.jobs import effective_jobs

if TYPE_CHECKING:
    import polars as pl

    from drumrs.analysis import Mean
    from drumrs.config import Config
    from drumrs.frames import Frames
    from drumrs.sweep import Case, Sweep

_DEPTHS = ("surface_speed", "middle_speed", "deep_speed")
_MOTIONS = ("along_the_rim", "carried_round", "mixed_in_a_turn", *_DEPTHS)


def measure(sweep: "Sweep", folder: str | Path | None = None) -> "pl.DataFrame":
    """Return the table of a sweep with the measures of every finished case.

    Parameters
    ----------
    sweep
        Cases, their series and frames.
    folder
        Where the results are; that of the sweep's last run unless given.

    Returns
    -------
    polars.DataFrame
        One row a finished case, in the order of ``sweep.table()``, with its columns, measured anew, and further ones:
        ``size_ratio``, D/d; ``drum_power_error`` [W/m]; and, where frames were kept,
        ``along_the_rim``, ``carried_round``, ``mixed_in_a_turn`` and the speeds relative to the turning drum by depth,
        ``surface_speed``, ``middle_speed`` and ``deep_speed`` (over the rim's), each with ``…_error``.
    """
    import polars as pl

    # What is measured here takes the place of what a finished case wrote, perhaps by an earlier method.
    table = sweep.table(folder).drop(set(_schema()) - {"case"}, strict=False).collect()
    finished = set(table["case"])

    def row(case: "Case") -> dict[str, Any]:
        frames = sweep.frames(case, folder) if case.wants_frames else None
        return {"case": case.id, **_measures(case.config, sweep.series(case, folder), frames)}

    # Most of the time is taken by reading and by searching neighbors, in compiled code that other threads need not
    # wait for.
    with ThreadPoolExecutor(effective_jobs()) as threads:
        rows = list(threads.map(row, (case for case in sweep.cases if case.id in finished)))
    measures = pl.DataFrame(rows, schema=_schema(), orient="row")
    return table.join(measures, on="case", how="left", maintain_order="left")


def _measures(config: "Config", series: "pl.DataFrame", frames: "Frames | None") -> dict[str, Any]:
    window = config.run.averaging_window
    mass = config.derived.load_mass
    columns: dict[str, Any] = {"size_ratio": config.drum.diameter / config.load.diameter}
    columns |= analysis.statistics(series, window, mass)
    error = columns["drum_specific_power_error"]
    columns["drum_power_error"] = error * mass if error is not None else None
    found: dict[str, Mean | None] = dict.fromkeys(_MOTIONS)
    if frames is not None:
        found["along_the_rim"] = measures.along_the_rim(frames, window)
        found["carried_round"] = measures.carried_round(frames, window)
        found["mixed_in_a_turn"] = measures.mixed_in_a_turn(frames, window)
        found |= dict(zip(_DEPTHS, measures.depth_profile(frames, window), strict=True))
    for name, mean in found.items():
        columns[name] = mean.value if mean is not None else None
        columns[f"{name}_error"] = mean.error if mean is not None else None
    return columns


def _schema() -> "dict[str, Any]":
    import polars as pl

    numbers = ["size_ratio", *analysis.STATISTICS, "drum_power_error"]
    numbers += [f"{name}{ending}" for name in _MOTIONS for ending in ("", "_error")]
    return {"case": pl.String, **{name: pl.Boolean if name == "drifting" else pl.Float64 for name in numbers}}
