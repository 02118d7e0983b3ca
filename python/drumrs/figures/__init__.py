"""Pictures: frames and tables in, matplotlib figures out; one function a figure, none sees a simulation.

Those of the load and its history: `snapshot`, `snapshots`, `time_series`, `curves`. Those of what `drumrs.measures`
returns: `flow`, `stress`, `wall_profile`, `collision_spectrum`, `mixing_curve`, `landing_rose`, `unbalance_histogram`,
`regime_map`. Those of decisions: `differences`, `effects`, `indices`.

A figure of one's own has their style where it is made with `new_figure` within `drumrs_style`, and written by `write`.
"""

import drumrs.figures.backend  # noqa: F401 - imports matplotlib, so it comes first
from drumrs.figures.curves import Labels, curves
from drumrs.figures.film import Film
from drumrs.figures.flow import flow, stress
from drumrs.figures.history import time_series
from drumrs.figures.landing import landing_rose
from drumrs.figures.mixing import mixing_curve
from drumrs.figures.regimes import regime_map
from drumrs.figures.sensitivity import effects, indices
from drumrs.figures.shared import INK, drumrs_style, line_colors, new_figure, render, write
from drumrs.figures.snapshots import View, snapshot, snapshots
from drumrs.figures.spectrum import collision_spectrum
from drumrs.figures.standings import differences
from drumrs.figures.unbalance import unbalance_histogram
from drumrs.figures.walls import wall_profile

__all__ = [
    "INK",
    "Film",
    "Labels",
    "View",
    "collision_spectrum",
    "curves",
    "differences",
    "drumrs_style",
    "effects",
    "flow",
    "indices",
    "landing_rose",
    "line_colors",
    "mixing_curve",
    "new_figure",
    "regime_map",
    "render",
    "snapshot",
    "snapshots",
    "stress",
    "time_series",
    "unbalance_histogram",
    "wall_profile",
    "write",
]
