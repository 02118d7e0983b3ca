"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation."""

from drumrs.figures.history import time_series
from drumrs.figures.shared import write
from drumrs.figures.snapshots import View, snapshot, snapshots

__all__ = ["View", "snapshot", "snapshots", "time_series", "write"]
