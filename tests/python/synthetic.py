"""Frames and series that nobody simulated, for figures and players."""

import numpy as np
import polars as pl

from drumrs.frames import Frames


def made_up(count: int = 12, frames: int = 3, **scene) -> Frames:
    random = np.random.default_rng(1)
    times = 0.1 * np.arange(frames)
    return Frames(
        times=times,
        drum_angles=2.0 * times,
        positions=random.uniform(-0.6, 0.6, (frames, count, 2)),
        angles=random.uniform(0.0, 6.0, (frames, count)),
        velocities=random.uniform(-2.0, 2.0, (frames, count, 2)),
        contacts=random.integers(0, 5, (frames, count), dtype=np.uint16),
        radii=np.full(count, 0.05),
        **scene,
    )


def series_of(power: float, rows: int = 301) -> pl.DataFrame:
    time = 0.01 * np.arange(rows)
    energies = ("kinetic_translation", "kinetic_rotation", "elastic_normal", "elastic_tangential")
    flows = {"drum_work": power, "dissipated_normal": 0.6 * power, "dissipated_sliding": 0.4 * power}
    return pl.DataFrame(
        {
            "time": time,
            **{name: rate * time for name, rate in flows.items()},
            **{name: np.full(rows, 2.0) for name in energies},
            "energy_residual": np.zeros(rows),
            "center_of_mass_x": np.full(rows, 0.05),
            "center_of_mass_y": np.full(rows, -0.1),
        }
    )
