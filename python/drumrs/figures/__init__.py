"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation."""

from drumrs.figures.curves import Labels, curves
from drumrs.figures.history import time_series
from drumrs.figures.shared import drumrs_style, svg, write
from drumrs.figures.snapshots import View, snapshot, snapshots

__all__ = ["Labels", "View", "curves", "drumrs_style", "snapshot", "snapshots", "svg", "time_series", "write"]
