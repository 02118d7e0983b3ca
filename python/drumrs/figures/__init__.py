"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation."""

from drumrs.figures.agreement import agreement
from drumrs.figures.curves import Labels, curves
from drumrs.figures.history import time_series
from drumrs.figures.shared import svg, write
from drumrs.figures.snapshots import View, snapshot, snapshots
from drumrs.figures.study import (
    drift_over_time,
    power_against_fill,
    ratio_against_fill,
    ratio_against_friction,
    snapshots_of_fills,
    specific_power_against_fill,
    specific_power_against_friction,
    specific_power_against_restitution,
    specific_power_against_size,
    specific_power_against_speed,
)

__all__ = [
    "Labels",
    "View",
    "agreement",
    "curves",
    "drift_over_time",
    "power_against_fill",
    "ratio_against_fill",
    "ratio_against_friction",
    "snapshot",
    "snapshots",
    "snapshots_of_fills",
    "specific_power_against_fill",
    "specific_power_against_friction",
    "specific_power_against_restitution",
    "specific_power_against_size",
    "specific_power_against_speed",
    "svg",
    "time_series",
    "write",
]
