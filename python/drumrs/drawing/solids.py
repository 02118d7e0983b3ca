"""From lines to the outlines of solids: which there are, and what is refused, in words of who draws."""

import math
import re
from dataclasses import dataclass

import numpy as np
import shapely

from drumrs.drawing.joined import joined
from drumrs.drawing.line import Frame, Line, Points
from drumrs.errors import ConfigError

# A drawing that reaches farther than this, in radii of the rim, or less far, is in another unit.
_FARTHEST, _NEAREST = 20.0, 0.05
# Without a rim: more than this across, in what may be neglected, which is 1/100 of a bundle.
_LARGEST = 3e5
# How far behind the rim an outline is closed, in radii, and the angle between the points there.
_BEHIND, _STEP = 1.1, math.radians(10.0)


@dataclass(frozen=True)
class Drawn:
    """The closed outline of a solid, or of the drum itself where it runs round the axis; no point repeats."""

    name: str
    points: Points


def solids(lines: list[Line], frame: Frame, file: str) -> tuple[list[Drawn], int]:
    """Return the outlines that lines make up, and how often they stand round the drum.

    Raises
    ------
    ConfigError
        Where a line is no outline of a solid: open within the drum, crossing itself, in another unit, beside the drum.
    """
    _require_unit(lines, frame, file)
    lines, repeat = _all_round(lines, frame)
    return [_solid(line, frame, file) for line in lines], repeat


def _require_unit(lines: list[Line], frame: Frame, file: str) -> None:
    reach = max(float(np.hypot(*line.points.T).max()) for line in lines)
    if frame.radius is None:
        if reach <= _LARGEST * frame.accuracy:
            return
        problem = f"{file!r} reaches {reach:.4g} m from the axis, thousands of bundles"
    elif _NEAREST * frame.radius < reach <= _FARTHEST * frame.radius:
        return
    else:
        problem = (
            f"{file!r} reaches {reach:.4g} m from the axis, in a drum of radius {frame.radius:.4g} m: "
            f"{'too far' if reach > frame.radius else 'it cannot touch the rim'}"
        )
    hint = 'are its lengths in millimeters? write drum.liner.units = "mm"'
    if reach < _NEAREST * (frame.radius or 0.0):
        hint = f"its lengths were read as {frame.units or 'what the file says, or meters'}; write drum.liner.units"
    raise ConfigError("drum.liner.file", file, problem=problem, hint=hint)


def _all_round(lines: list[Line], frame: Frame) -> tuple[list[Line], int]:
    """Join the copies of open lines all round the drum, where they meet, to outlines of the whole drum."""
    loose = [line for line in lines if not _is_closed(line.points)]
    if frame.repeat == 1 or not loose:
        return lines, frame.repeat
    copies = [
        Line(line.layer, line.points @ _turn(math.tau * index / frame.repeat))
        for index in range(frame.repeat)
        for line in loose
    ]
    round_the_drum = joined(copies, frame.accuracy)
    if len(round_the_drum) == len(copies):
        return lines, frame.repeat
    closed = [
        Line(line.layer, line.points @ _turn(math.tau * index / frame.repeat))
        for index in range(frame.repeat)
        for line in lines
        if _is_closed(line.points)
    ]
    return [*closed, *round_the_drum], 1


def _turn(angle: float) -> Points:
    """Return the matrix that turns rows of points counter-clockwise."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, sin], [-sin, cos]])


def _solid(line: Line, frame: Frame, file: str) -> Drawn:
    name = re.sub(r"\W+", "_", line.layer.lower()).strip("_")
    name = name if re.match(r"[a-z]", name) else "lifter"
    said = f"{file!r}, layer {line.layer!r}" if line.layer else repr(file)
    points = line.points[:-1] if _is_closed(line.points) else _closed_behind_the_rim(line.points, frame, said)
    if len(points) < 3:  # noqa: PLR2004 - a triangle
        raise _refused(file, f"{said} has a line there and back again near {_place(points[0])}")
    _require_simple(points, file, said)
    if frame.radius is None:
        return Drawn(name, points)
    solid = shapely.Polygon(points)
    if solid.distance(shapely.Point(0.0, 0.0)) >= frame.radius:
        at = f"near {_place(points[0])}, outside of the rim of radius {frame.radius:.4g} m"
        raise _refused(file, f"{said} has an outline {at}", "an outline reaches into the drum")
    return Drawn(name, points)


def _is_closed(points: Points) -> bool:
    return bool((points[0] == points[-1]).all())


def _closed_behind_the_rim(points: Points, frame: Frame, said: str) -> Points:
    """Return an outline that runs from rim to rim, closed by points behind the rim."""
    ends = points[[0, -1]]
    if frame.radius is None:
        apart = float(np.hypot(*(ends[0] - ends[1])))
        where = f"its ends, near {_place(ends[0])} and {_place(ends[1])}, are {apart:.4g} m apart"
        hint = f"close it; gaps up to {frame.accuracy:.2g} m are closed for you"
        raise _refused(said, f"{said} has an open outline: {where}", hint)
    depths = frame.radius - np.hypot(*ends.T)
    if depths.max() > frame.accuracy:
        end = ends[depths.argmax()]
        where = f"it ends near {_place(end)}, {depths.max():.4g} m inside of the rim"
        hint = "close it, or let both ends reach the rim; a thin plate goes into drum.walls"
        raise _refused(said, f"{said} has an open outline: {where}", hint)
    first, last = np.arctan2(ends[:, 1], ends[:, 0])
    # The way back along the rim that is shorter.
    way = (first - last + math.pi) % math.tau - math.pi
    angles = last + way * np.linspace(0.0, 1.0, max(2, math.ceil(abs(way) / _STEP) + 1))
    behind = _BEHIND * max(frame.radius, np.hypot(*ends.T).max())
    return np.vstack([points, behind * np.column_stack([np.cos(angles), np.sin(angles)])])


def _require_simple(points: Points, file: str, said: str) -> None:
    ring = shapely.LinearRing(points)
    if ring.is_simple:
        return
    known = {tuple(point) for point in points.tolist()}
    crossings = [
        point for point in shapely.get_coordinates(shapely.node(ring)).tolist() if tuple(point) not in known
    ]
    where = f" near {_place(crossings[0])}" if crossings else ""
    raise _refused(
        file, f"{said} has an outline that crosses or touches itself{where}", "draw two, or one around both"
    )


def _place(point: Points | list[float]) -> str:
    return f"[{point[0]:.4g}, {point[1]:.4g}] m"


def _refused(file: str, problem: str, hint: str = "") -> ConfigError:
    return ConfigError("drum.liner.file", file, problem=problem, hint=hint)
