"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation."""

import drumrs.figures.backend  # noqa: F401 - imports matplotlib, so it comes first
from drumrs.figures.curves import Labels, curves
from drumrs.figures.history import time_series
from drumrs.figures.shared import drumrs_style, line_colors, new_figure, render, write
from drumrs.figures.snapshots import View, snapshot, snapshots

__all__ = [
    "Labels",
    "View",
    "curves",
    "drumrs_style",
    "line_colors",
    "new_figure",
    "render",
    "snapshot",
    "snapshots",
    "time_series",
    "write",
]
