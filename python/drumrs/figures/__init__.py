"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation.

A figure of one's own has their style where it is made with `new_figure` within `drumrs_style`, and written by `write`.
"""

import drumrs.figures.backend  # noqa: F401 - imports matplotlib, so it comes first
from drumrs.figures.curves import Labels, curves
from drumrs.figures.history import time_series
from drumrs.figures.shared import INK, drumrs_style, line_colors, new_figure, render, write
from drumrs.figures.snapshots import View, snapshot, snapshots

__all__ = [
    "INK",
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
