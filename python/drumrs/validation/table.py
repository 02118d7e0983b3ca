"""The table of a validation: one row a case, with what its series and frames tell."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.measures import mean_overlap_ratio
from drumrs.measures.frame_window import FrameWindow
from drumrs.validation.drum import PublishedDrum

if TYPE_CHECKING:
    import polars as pl

    from drumrs.sweep import Sweep

# What is kept of a run's summary.
_SUMMARY = (
    "bundle_count",
    "fill",
    "time_step",
    "steps",
    "drum_power",
    "drum_specific_power",
    "drum_specific_power_error",
    "coordination",
    "max_overlap_ratio",
    "energy_residual",
)


def measure(sweep: "Sweep", folder: Path, drums: Mapping[str, PublishedDrum]) -> "pl.DataFrame":
    """Return the table of a study: by what its cases differ, and what their series and frames tell.

    Parameters
    ----------
    sweep
        Cases, their series and frames.
    folder
        Where the results are.
    drums
        The drum of each case, by the case's id.
    """
    import polars as pl

    columns = dict.fromkeys(("case", *sweep.varied(), "seed", *_SUMMARY))
    table = sweep.table(folder).select(*columns).collect()
    finished = set(table["case"])
    rows = []
    for case in sweep.cases:
        if case.id not in finished:
            continue
        drum, window = drums[case.id], case.config.run.averaging_window
        series = sweep.series(case, folder)
        row: dict[str, Any] = {"case": case.id, "drum": drum.name}
        stiffness, radius = case.config.contact.bundle.normal_stiffness, 0.5 * case.config.load.diameter
        overlap = mean_overlap_ratio(series, window, stiffness, radius)
        row |= {"mean_overlap_ratio": overlap.value if overlap else 0.0}
        if case.wants_frames:
            seen = FrameWindow.of(sweep.frames(case, folder), window)
            for name, mean in drum.measures(case.config, seen).items():
                row |= {name: mean.value, f"{name}_error": mean.error}
        rows.append(row)
    if not rows:
        return table
    # A number that is none is null, as everywhere in tables.
    measures = pl.DataFrame(rows, infer_schema_length=None).with_columns(pl.selectors.float().fill_nan(None))
    return measures.join(table, on="case", how="left", maintain_order="left")
