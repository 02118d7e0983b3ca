"""VTKHDF, for ParaView from 5.12 and VTK from 9.3: a file for the bundles, one for the drum, each with all times.

The layout is that of the file format VTKHDF 2.0 (docs.vtk.org, "VTK File Formats"): the points of all times lie one
after the other, and `Steps` says where those of each time begin. What does not change is there once. A single file with
both as blocks would be nicer, but readers up to VTK 9.7 show the first time only of such a file.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.exports.recorded import Recorded
from drumrs.outline import turned

if TYPE_CHECKING:
    import h5py

_KINDS = ("Vertices", "Lines", "Polygons", "Strips")
Cells = list[NDArray[np.int64]]


def write(run: Recorded, path: Path) -> None:
    """Write bundles as points with radius, angle, velocity, speed, contacts, number and species."""
    frames, count = run.frames, run.frames.count
    values = {
        "angle": frames.angles,
        "velocity": _in_space(frames.velocities),
        "speed": frames.speeds,
        "contacts": frames.contacts,
        "radius": frames.radii[np.newaxis],
        "bundle": np.arange(count)[np.newaxis],
    }
    names = sorted(set(frames.species))
    if names:
        values["species"] = np.array([[names.index(name) for name in frames.species]])
    vertices = list(np.arange(count)[:, np.newaxis])
    _write(run, path, _in_space(frames.positions), [vertices, [], [], []], values)


def write_drum(run: Recorded, path: Path) -> None:
    """Write the drum as it turns: its baffles as areas, the rest as lines."""
    lines, start = run.frames.outline(), 0
    cells: list[Cells] = [[], [], [], []]
    for line in lines:
        solid = line.part.startswith("baffle")
        cells[2 if solid else 1].append(np.arange(start, start + len(line.points) - solid))
        start += len(line.points)
    still = np.concatenate([np.empty((0, 2)), *(line.points for line in lines)])
    points = np.array([turned(still, angle) for angle in run.frames.drum_angles])
    _write(run, path, _in_space(points), cells, {})


def _write(
    run: Recorded, path: Path, points: NDArray[Any], cells: list[Cells], values: dict[str, NDArray[Any]]
) -> None:
    """Write poly data whose points, of shape (times, n, 3), move and whose cells stay, with values of the points.

    Values are of shape (times, n, …), or (1, n) where they stay, too.
    """
    import h5py

    times, length = run.frames.times, points.shape[1]
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = (2, 0)
        # Readers want the word in ASCII and of fixed length.
        root.attrs.create("Type", b"PolyData", dtype="S8")
        root.attrs.update(run.provenance())
        if run.frames.species:
            root.attrs["species"] = sorted(set(run.frames.species))
        root["NumberOfPoints"] = [length]
        _add(root, "Points", points)
        for kind, listed in zip(_KINDS, cells, strict=True):
            group = root.create_group(kind)
            sizes = [len(cell) for cell in listed]
            group["NumberOfCells"] = [len(sizes)]
            group["NumberOfConnectivityIds"] = [sum(sizes)]
            group["Connectivity"] = np.concatenate([np.empty(0, np.int64), *listed])
            group["Offsets"] = np.cumsum([0, *sizes])
        steps = root.create_group("Steps")
        steps.attrs["NSteps"] = len(times)
        steps["Values"] = times
        steps["NumberOfParts"] = np.ones(len(times), np.int64)
        steps["PartOffsets"] = np.zeros(len(times), np.int64)
        steps["PointOffsets"] = length * np.arange(len(times))
        steps["CellOffsets"] = np.zeros((len(times), len(_KINDS)), np.int64)
        steps["ConnectivityIdOffsets"] = np.zeros((len(times), len(_KINDS)), np.int64)
        data, offsets = root.create_group("PointData"), steps.create_group("PointDataOffsets")
        for name, value in values.items():
            _add(data, name, value)
            offsets[name] = (len(value) > 1) * length * np.arange(len(times))


def _add(group: "h5py.Group", name: str, values: NDArray[Any]) -> None:
    """Add values of all times, of shape (times, n, …), one after the other."""
    flat = values.reshape(-1, *values.shape[2:])
    packed: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}
    group.create_dataset(name, data=flat, **(packed if flat.size else {}))


def _in_space(vectors: NDArray[Any]) -> NDArray[Any]:
    """Return vectors of the plane, of shape (…, 2), as vectors of space."""
    return np.concatenate([vectors, np.zeros_like(vectors[..., :1])], axis=-1)
