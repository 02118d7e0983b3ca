"""Statistics of tables: means with errors, tests of steadiness.

`blocks` averages inside a run, `seeds` over runs, `estimate` calculates with the results; `drift` asks whether a
window was steady; `statistics` puts what a series tells into columns, `phases` phase by phase. Measures are in
`drumrs.measures`. Nothing here sees a simulation.
"""

from drumrs.analysis.blocks import (
    BlockError,
    Mean,
    block_error,
    mean_with_error,
    rate_with_error,
    ratio_with_error,
)
from drumrs.analysis.drift import Drift, StateSwitching, drift, ratio_drift, state_switching
from drumrs.analysis.estimate import Estimate, Interval, combine, mean_of
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
    "block_error",
    "combine",
    "disagreement",
    "drift",
    "estimate",
    "mean_of",
    "mean_with_error",
    "phases",
    "rate_with_error",
    "ratio_drift",
    "ratio_with_error",
    "state_switching",
    "statistics",
    "student",
]
