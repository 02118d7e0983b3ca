"""Numbers from tables and frames: means with errors, tests of steadiness, measures of motion.

`blocks` averages inside a run, `seeds` over runs, `estimate` calculates with the results; `drift` asks whether a
window was steady; `motion`, `depth` and `bed` look at the bundles, frame by frame; `statistics` puts what a series
tells into columns, `phases` phase by phase. Nothing here sees a simulation.
"""

from drumrs.analysis.bed import bulk_fill
from drumrs.analysis.blocks import (
    BlockError,
    Mean,
    block_error,
    mean_with_error,
    rate_with_error,
    ratio_with_error,
)
from drumrs.analysis.depth import depth_profile
from drumrs.analysis.drift import Drift, StateSwitching, drift, ratio_drift, state_switching
from drumrs.analysis.estimate import Estimate, Interval, combine, mean_of
from drumrs.analysis.motion import along_the_rim, carried_round, mixed_in_a_turn, mixing
from drumrs.analysis.phases import phases
from drumrs.analysis.seeds import disagreement, estimate, student
from drumrs.analysis.statistics import STATISTICS, statistics

__all__ = [
    "STATISTICS",
    "BlockError",
    "Drift",
    "Estimate",
    "Interval",
    "Mean",
    "StateSwitching",
    "along_the_rim",
    "block_error",
    "bulk_fill",
    "carried_round",
    "combine",
    "depth_profile",
    "disagreement",
    "drift",
    "estimate",
    "mean_of",
    "mean_with_error",
    "mixed_in_a_turn",
    "mixing",
    "phases",
    "rate_with_error",
    "ratio_drift",
    "ratio_with_error",
    "state_switching",
    "statistics",
    "student",
]
