"""`Frames`: where the bundles are, frame by frame, with the outline of the drum; and the table they are kept in."""

import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.files import write_whole

if TYPE_CHECKING:
    import polars as pl

_UNITS = {
    "frame": "1",
    "time": "s",
    "drum_angle": "rad",
    "bundle": "1",
    "x": "m",
    "y": "m",
    "angle": "rad",
    "speed": "m/s",
    "radius": "m",
}


@dataclass(frozen=True, eq=False)
class Frames:
    """Positions, angles and speeds of all bundles at the frames' times, in the laboratory's frame.

    Single precision is plenty for them: 15 nm in a drum of half a meter.

    Attributes
    ----------
    times
        Time of each frame [s], shape (frames,).
    drum_angles
        Angle by which the drum has turned [rad], counter-clockwise, shape (frames,).
    positions
        Centers of the bundles [m], shape (frames, n, 2).
    angles
        Angles of the bundles [rad], within ±π, shape (frames, n).
    speeds
        Speeds of the bundles [m/s], shape (frames, n).
    radii
        Radii of the bundles [m], shape (n,).
    drum_radius
        Radius of the rim [m], or `None` for a scene without one.
    baffles, walls
        Closed baffles and open walls in the drum's own frame [m], each of shape (k, 2).
    """

    times: NDArray[np.float64]
    drum_angles: NDArray[np.float64]
    positions: NDArray[np.float32]
    angles: NDArray[np.float32]
    speeds: NDArray[np.float32]
    radii: NDArray[np.float64]
    drum_radius: float | None = None
    baffles: tuple[NDArray[np.float64], ...] = ()
    walls: tuple[NDArray[np.float64], ...] = ()

    def __len__(self) -> int:
        """Return the number of frames."""
        return len(self.times)

    @property
    def count(self) -> int:
        """Number of bundles n."""
        return len(self.radii)

    def nearest(self, time: float) -> int:
        """Return the index of the frame nearest to `time` [s]."""
        return int(np.abs(self.times - time).argmin())

    def turning(self, index: int) -> int:
        """Return +1 where the drum turns counter-clockwise about frame `index`, −1 clockwise, 0 if it rests."""
        near = self.drum_angles[max(index - 1, 0) : index + 2]
        return int(np.sign(near[-1] - near[0]))

    def table(self) -> "pl.DataFrame":
        """Return a polars table with one row for each frame and bundle; `units` of the columns as in the docs."""
        import polars as pl

        frames, count = self.speeds.shape
        columns = {
            "frame": np.repeat(np.arange(frames, dtype=np.uint32), count),
            "time": np.repeat(self.times, count),
            "drum_angle": np.repeat(self.drum_angles, count),
            "bundle": np.tile(np.arange(count, dtype=np.uint32), frames),
            "x": self.positions[:, :, 0].ravel(),
            "y": self.positions[:, :, 1].ravel(),
            "angle": self.angles.ravel(),
            "speed": self.speeds.ravel(),
            "radius": np.tile(self.radii, frames),
        }
        return pl.DataFrame(columns)

    def metadata(self) -> dict[str, str]:
        """Return what a file of the table has to carry beside it: units and the drum's outline, as JSON."""
        scene = {
            "drum_radius": self.drum_radius,
            "baffles": [line.tolist() for line in self.baffles],
            "walls": [line.tolist() for line in self.walls],
        }
        return {"units": json.dumps(_UNITS), "scene": json.dumps(scene)}

    def save(self, path: str | Path) -> None:
        """Write the table as parquet, with `metadata` on the file."""
        write_table(path, self.table(), self.metadata())

    @classmethod
    def load(cls, source: str | Path | io.BytesIO) -> "Frames":
        """Read what `save` wrote, from the file or from its bytes."""
        import polars as pl

        table = pl.read_parquet(source)
        scene = json.loads(pl.read_parquet_metadata(source)["scene"])
        count = table["bundle"].n_unique()
        columns: dict[str, Any] = {name: table[name].to_numpy().reshape(-1, count) for name in table.columns}
        return cls(
            times=columns["time"][:, 0].copy(),
            drum_angles=columns["drum_angle"][:, 0].copy(),
            positions=np.stack([columns["x"], columns["y"]], axis=-1),
            angles=columns["angle"],
            speeds=columns["speed"],
            radii=columns["radius"][0].copy(),
            drum_radius=scene["drum_radius"],
            baffles=tuple(np.array(line) for line in scene["baffles"]),
            walls=tuple(np.array(line) for line in scene["walls"]),
        )


def write_table(path: str | Path, table: "pl.DataFrame", metadata: Mapping[str, str]) -> None:
    """Write a table as parquet, whole or not at all, with `metadata` on the file."""
    buffer = io.BytesIO()
    table.write_parquet(buffer, metadata=dict(metadata))
    write_whole(path, buffer.getvalue())
