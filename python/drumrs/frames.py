"""`Frames`: where the bundles are, frame by frame, with the outline of the drum; and the table they are kept in."""

import io
import json
import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.datasets import Column, dataset
from drumrs.files import replacing
from drumrs.outline import Outline, circle
from drumrs.registry import metadata, quantity, require
from drumrs.tables import ROW_GROUP_SIZE, Compression, sink_table

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import polars as pl
    import xarray

# Columns of the table, one row for each frame and bundle.
COLUMNS = (
    *("frame", "time", "drum_angle", "bundle", "x", "y", "angle", "velocity_x", "velocity_y", "contacts"),
    *("radius", "species"),
)
# How near to the rim a point counts as one of it, and edges that an arc is drawn with.
_AT_RIM, _ARC = 1e-6, 8
# Arrays with an entry for each frame and bundle.
SHAPED = ("positions", "angles", "velocities", "contacts")


@dataclass(frozen=True, eq=False)
class Frames:
    """Positions, angles, velocities and contacts of all bundles at the frames' times, in the laboratory's frame.

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
    velocities
        Velocities of the bundles [m/s], shape (frames, n, 2).
    contacts
        Number of contacts of each bundle, those with the drum included, shape (frames, n); 0 for one in flight.
    radii
        Radii of the bundles [m], shape (n,).
    species
        Name of each bundle's species, n of them; empty where the load has none.
    drum_radius
        Radius of the rim [m], or `None` for a scene without one.
    shell
        The closed outline of a drum that is not round, in the drum's own frame [m], of shape (k, 2), or `None`.
    baffles, walls
        Closed baffles and open walls in the drum's own frame [m], each of shape (k, 2).
    """

    times: NDArray[np.float64]
    drum_angles: NDArray[np.float64]
    positions: NDArray[np.float32]
    angles: NDArray[np.float32]
    velocities: NDArray[np.float32]
    contacts: NDArray[np.uint16]
    radii: NDArray[np.float64]
    species: tuple[str, ...] = ()
    drum_radius: float | None = None
    shell: NDArray[np.float64] | None = None
    baffles: tuple[NDArray[np.float64], ...] = ()
    walls: tuple[NDArray[np.float64], ...] = ()

    @classmethod
    def none(cls) -> "Frames":
        """Return no frames of no bundles: what is left of a run that kept none."""
        flat, one = np.empty((0, 0), np.float32), np.empty(0)
        pairs, counts = np.empty((0, 0, 2), np.float32), np.empty((0, 0), np.uint16)
        return cls(one, one, pairs, flat, pairs, counts, one)

    def __len__(self) -> int:
        """Return the number of frames."""
        return len(self.times)

    @property
    def count(self) -> int:
        """Number of bundles n."""
        return len(self.radii)

    @property
    def speeds(self) -> NDArray[np.float32]:
        """Speeds of the bundles [m/s], shape (frames, n)."""
        speeds: NDArray[np.float32] = np.hypot(self.velocities[..., 0], self.velocities[..., 1])
        return speeds

    @property
    def reach(self) -> float | None:
        """Radius of the rim, or of the shell's farthest corner [m]; `None` for a scene without either."""
        return self.drum_radius if self.shell is None else float(np.hypot(*self.shell.T).max())

    @property
    def drawn_baffles(self) -> tuple[NDArray[np.float64], ...]:
        """The baffles as they are drawn: an edge with no room for a bundle between it and the rim is bent along it."""
        if self.drum_radius is None:
            return self.baffles
        room = 2.0 * float(self.radii.min(initial=np.inf))
        return tuple(_along_the_rim(line, self.drum_radius, room) for line in self.baffles)

    def nearest(self, time: float) -> int:
        """Return the index of the frame nearest to `time` [s]."""
        return int(np.abs(self.times - time).argmin())

    def turning(self, index: int) -> int:
        """Return +1 where the drum turns counter-clockwise about frame `index`, −1 clockwise, 0 if it rests."""
        near = self.drum_angles[max(index - 1, 0) : index + 2]
        return int(np.sign(near[-1] - near[0]))

    def picked(self, indices: NDArray[np.intp] | slice) -> "Frames":
        """Return the frames with these indices only; those of a slice share their memory."""
        return replace(
            self,
            times=self.times[indices],
            drum_angles=self.drum_angles[indices],
            positions=self.positions[indices],
            angles=self.angles[indices],
            velocities=self.velocities[indices],
            contacts=self.contacts[indices],
        )

    def table(self, first: int = 0) -> "pl.DataFrame":
        """Return a polars table with one row for each frame and bundle; `units` of the columns as in the docs.

        Parameters
        ----------
        first
            Number of the first frame.
        """
        import polars as pl

        frames, count = self.angles.shape
        columns = {
            "frame": np.repeat(np.arange(first, first + frames, dtype=np.uint32), count),
            "time": np.repeat(self.times, count),
            "drum_angle": np.repeat(self.drum_angles, count),
            "bundle": np.tile(np.arange(count, dtype=np.uint32), frames),
            "x": self.positions[:, :, 0].ravel(),
            "y": self.positions[:, :, 1].ravel(),
            "angle": self.angles.ravel(),
            "velocity_x": self.velocities[:, :, 0].ravel(),
            "velocity_y": self.velocities[:, :, 1].ravel(),
            "contacts": self.contacts.ravel(),
            "radius": np.tile(self.radii, frames),
        }
        table = pl.DataFrame(columns)
        if not self.species:
            return table
        kinds = pl.Series(self.species, dtype=pl.Enum(sorted(set(self.species))))
        return table.with_columns(species=kinds.gather(table["bundle"]))

    def to_xarray(self, attributes: "Mapping[str, str] | None" = None) -> "xarray.Dataset":
        """Return the frames as labelled arrays over frame and bundle, with units; needs xarray, of the extra `export`.

        The outline of the drum comes along, in the drum's own frame: `drum_angle` turns it.

        Parameters
        ----------
        attributes
            Words on the whole.

        Raises
        ------
        ConfigError
            Where xarray is not installed.

        Examples
        --------
        >>> import drumrs
        >>> config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
        >>> frames = drumrs.run(config, progress=False).frames
        >>> frames.to_xarray().x.dims
        ('frame', 'bundle')
        """
        both, point, outline = ("frame", "bundle"), ("outline_point",), self.outline()
        corners = np.concatenate([np.empty((0, 2)), *(line.points for line in outline)])
        columns: dict[str, Column] = {
            "x": (both, self.positions[..., 0]),
            "y": (both, self.positions[..., 1]),
            "angle": (both, self.angles),
            "velocity_x": (both, self.velocities[..., 0]),
            "velocity_y": (both, self.velocities[..., 1]),
            "contacts": (both, self.contacts),
            "outline_x": (point, corners[:, 0], {"units": "m"}),
            "outline_y": (point, corners[:, 1], {"units": "m"}),
        }
        parts = [line.part for line in outline for _ in line.points]
        coordinates: dict[str, Column] = {
            "frame": (("frame",), np.arange(len(self))),
            "time": (("frame",), self.times),
            "drum_angle": (("frame",), self.drum_angles),
            "bundle": (("bundle",), np.arange(self.count)),
            "radius": (("bundle",), self.radii),
            "outline_part": (point, np.array(parts, str)),
        }
        if self.species:
            coordinates["species"] = (("bundle",), np.array(self.species))
        return dataset(columns, coordinates, attributes)

    def outline(self) -> list[Outline]:
        """Return the lines of the drum in its own frame: rim or shell, baffles, walls."""
        closed = [] if self.drum_radius is None else [("rim", circle(self.drum_radius))]
        closed += [] if self.shell is None else [("shell", self.shell)]
        closed += [(f"baffle {place}", line) for place, line in enumerate(self.baffles, 1)]
        opened = [Outline(f"wall {place}", line) for place, line in enumerate(self.walls, 1)]
        return [*(Outline(part, np.concatenate([line, line[:1]])) for part, line in closed), *opened]

    def metadata(self) -> dict[str, str]:
        """Return what a file of the table has to carry beside it: units and the drum's outline, as JSON."""
        columns = [name for name in COLUMNS if name != "species" or self.species]
        return {**metadata(map(quantity, columns)), "scene": json.dumps(self.scene())}

    def scene(self) -> dict[str, Any]:
        """Return the drum's outline in plain numbers."""
        return {
            "drum_radius": self.drum_radius,
            "shell": None if self.shell is None else self.shell.tolist(),
            "baffles": [line.tolist() for line in self.baffles],
            "walls": [line.tolist() for line in self.walls],
        }

    def lazy_table(self, first: int = 0) -> "pl.LazyFrame":
        """Return the table, made batch by batch while it is written: whole, it takes three times the frames' memory."""
        from polars.io.plugins import register_io_source

        def tables(*_: object) -> "Iterator[pl.DataFrame]":
            group = frames_per_row_group(self.count)
            for start in range(0, len(self), group):
                yield self.picked(slice(start, start + group)).table(first + start)

        return register_io_source(tables, schema=self.picked(slice(0)).table().schema)

    def save(self, path: str | Path, first: int = 0) -> None:
        """Write the table as parquet, with `metadata` on the file.

        Parameters
        ----------
        path
            File to write, whole or not at all.
        first
            Number of the first frame.
        """
        with replacing(path) as temporary:
            sink_frames(temporary, self.lazy_table(first), self.count, self.metadata())

    @classmethod
    def load(cls, source: str | Path | io.BytesIO, most: int | None = None) -> "Frames":
        """Read what `save` wrote, from the file or from its bytes.

        Parameters
        ----------
        source
            The file, or its bytes.
        most
            Bundles times frames at which to leave out frames, evenly; the last one stays. All are read unless given.
        """
        file = FramesFile.of(source)
        return file.read(None if most is None else thinned(len(file), file.count, most))


def _along_the_rim(line: NDArray[np.float64], radius: float, room: float) -> NDArray[np.float64]:
    """Return a closed outline with arcs for the edges that join two points of the rim and leave less room behind."""
    at_rim = np.hypot(*line.T) >= (1.0 - _AT_RIM) * radius
    pieces = []
    for here, after, both in zip(line, np.roll(line, -1, axis=0), at_rim & np.roll(at_rim, -1), strict=True):
        pieces.append(here[np.newaxis])
        turned = math.atan2(here[0] * after[1] - here[1] * after[0], here @ after)
        if both and radius * (1.0 - math.cos(0.5 * turned)) < room:
            angles = math.atan2(here[1], here[0]) + turned * np.arange(1, _ARC) / _ARC
            pieces.append(radius * np.column_stack([np.cos(angles), np.sin(angles)]))
    return np.concatenate(pieces)


class FramesFile:
    """A table of frames, read batch by batch.

    Parameters
    ----------
    table
        The table, wherever it is.
    scene
        Radius of the rim, baffles and walls, as `Frames.metadata` tells them.

    Attributes
    ----------
    count
        Number of bundles n.
    """

    def __init__(self, table: "pl.LazyFrame", scene: dict[str, Any]) -> None:
        import polars as pl

        self._table, self._scene = table, scene
        greatest, rows = (
            self._table.select(pl.col("bundle").max(), pl.len()).collect(engine="streaming").row(0)
        )
        self.count = 0 if greatest is None else int(greatest) + 1
        self._length: int = rows // max(self.count, 1)

    @classmethod
    def of(cls, source: str | Path | io.BytesIO) -> "FramesFile":
        """Open what `Frames.save` wrote, the file or its bytes.

        Raises
        ------
        ConfigError
            Where another version of drumrs wrote it, which had other columns.
        """
        import polars as pl

        scene = json.loads(pl.read_parquet_metadata(source)["scene"])
        table = pl.scan_parquet(source)
        path = Path("frames.parquet") if isinstance(source, io.BytesIO) else Path(source)
        require(path, table.collect_schema().names(), (name for name in COLUMNS if name != "species"))
        return cls(table, scene)

    def __len__(self) -> int:
        """Return the number of frames."""
        return self._length

    def times(self) -> NDArray[np.float64]:
        """Return the time of each frame [s]."""
        times = [batch["time"].to_numpy()[:: self.count] for _, batch in self._batches(["time"])]
        return np.concatenate([np.empty(0), *times])

    def read(self, indices: NDArray[np.intp] | None = None) -> Frames:
        """Read the frames with these indices, in their order; all unless given."""
        kept = np.arange(len(self)) if indices is None else np.unique(indices)
        frames = self._empty(len(kept))
        for start, batch in self._batches(None, kept):
            length = len(batch) // self.count
            columns: dict[str, Any] = {
                name: batch[name].to_numpy().reshape(-1, self.count)
                for name in batch.columns
                if name != "species"
            }
            here = slice(*np.searchsorted(kept, [start, start + length]))
            rows = kept[here] - start
            frames.times[here] = columns["time"][rows, 0]
            frames.drum_angles[here] = columns["drum_angle"][rows, 0]
            frames.positions[here, :, 0] = columns["x"][rows]
            frames.positions[here, :, 1] = columns["y"][rows]
            frames.angles[here] = columns["angle"][rows]
            frames.velocities[here, :, 0] = columns["velocity_x"][rows]
            frames.velocities[here, :, 1] = columns["velocity_y"][rows]
            frames.contacts[here] = columns["contacts"][rows]
            frames.radii[:] = columns["radius"][0]
        return replace(frames, species=self._species())

    def _species(self) -> tuple[str, ...]:
        if "species" not in self._table.collect_schema():
            return ()
        return tuple(self._table.select("species").head(self.count).collect()["species"].cast(str))

    def _empty(self, frames: int) -> Frames:
        shape, scene = (frames, self.count), self._scene
        # As they were written: in single precision where a simulation recorded them.
        row = self._table.select("x", "angle", "velocity_x").head(1).collect()
        place, angle, velocity = (row[name].to_numpy().dtype for name in row.columns)
        return Frames(
            times=np.empty(frames),
            drum_angles=np.empty(frames),
            positions=np.empty((*shape, 2), place),
            angles=np.empty(shape, angle),
            velocities=np.empty((*shape, 2), velocity),
            contacts=np.empty(shape, np.uint16),
            radii=np.empty(self.count),
            drum_radius=scene["drum_radius"],
            shell=None if scene.get("shell") is None else np.array(scene["shell"]),
            baffles=tuple(np.array(line) for line in scene["baffles"]),
            walls=tuple(np.array(line) for line in scene["walls"]),
        )

    def _batches(
        self, columns: list[str] | None = None, wanted: NDArray[np.intp] | None = None
    ) -> "Iterator[tuple[int, pl.DataFrame]]":
        """Read groups of frames with the number of their first; those that hold none of the wanted are passed over."""
        group = frames_per_row_group(self.count)
        table = self._table if columns is None else self._table.select(columns)
        for start in range(0, len(self), group):
            inside = True if wanted is None else np.diff(np.searchsorted(wanted, [start, start + group]))[0]
            if inside:
                yield start, table.slice(start * self.count, group * self.count).collect()


def sink_frames(
    path: Path,
    table: "pl.LazyFrame",
    count: int,
    metadata: dict[str, str],
    compression: Compression = "zstd",
) -> None:
    """Write a table of frames of `count` bundles: the same bytes for the same frames, however they come."""
    rows = frames_per_row_group(count) * max(count, 1)
    sink_table(path, table, metadata, row_group_size=rows, compression=compression)


def frames_per_row_group(count: int) -> int:
    """Return how many frames of `count` bundles are written and read together."""
    return max(1, ROW_GROUP_SIZE // max(count, 1))


def thinned(frames: int, count: int, most: int) -> NDArray[np.intp]:
    """Return the indices of the frames, evenly and with the last, that make up some `most` bundles times frames."""
    if frames <= math.ceil(most / max(count, 1)) + 1:
        return np.arange(frames)
    every = math.ceil(frames * count / most)
    return np.unique([*range(0, frames, every), frames - 1])
