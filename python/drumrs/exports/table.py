"""CSV, for spreadsheets and all else: one row for each frame and bundle, units in the names of the columns."""

from pathlib import Path

import polars as pl

from drumrs.exports.recorded import Recorded
from drumrs.outline import turned
from drumrs.registry import quantity


def write(run: Recorded, path: Path) -> None:
    """Write the table of frames."""
    table = run.frames.table()
    table.rename({name: quantity(name).label for name in table.columns}).write_csv(path)


def write_drum(run: Recorded, path: Path) -> None:
    """Write the lines of the drum: one row for each frame and point of them."""
    frames, lines = run.frames, run.frames.outline()
    moments = zip(range(len(frames)), frames.times.tolist(), frames.drum_angles.tolist(), strict=True)
    rows = [
        (index, time, line.part, x, y)
        for index, time, angle in moments
        for line in lines
        for x, y in turned(line.points, angle).tolist()
    ]
    columns = ["frame", "time [s]", "part", "x [m]", "y [m]"]
    pl.DataFrame(rows, schema=columns, orient="row").write_csv(path)
