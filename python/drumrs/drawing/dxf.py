"""Lines of a DXF file: what is drawn in its model space, blocks resolved, points of curves exactly on them."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from drumrs.drawing.line import UNITS, Frame, Line
from drumrs.errors import ConfigError

# Codes of the header's $INSUNITS.
_CODES = {1: "in", 4: "mm", 5: "cm", 6: "m"}


def lines(path: Path, frame: Frame) -> tuple[list[Line], float | None]:
    """Return the lines of a file in its unit, and that unit [m] where the header says it."""
    import ezdxf
    from ezdxf.disassemble import recursive_decompose

    try:
        document: Any = ezdxf.readfile(str(path))  # type: ignore[attr-defined]
    except ezdxf.DXFError as error:  # type: ignore[attr-defined]
        problem = f"{str(path)!r} is no DXF file that can be read: {error}"
        raise ConfigError("drum.liner.file", str(path), problem=problem) from None
    unit = UNITS.get(_CODES.get(int(document.header.get("$INSUNITS", 0)), ""))
    accuracy = frame.accuracy / frame.meters(unit)
    entities = recursive_decompose(document.modelspace())
    return [line for entity in entities for line in _of(entity, accuracy)], unit


def _of(entity: Any, error: float) -> Iterator[Line]:
    """List the polylines of an entity, its curves broken into chords with an error in the file's unit."""
    kind = entity.dxftype()
    if kind == "LINE":
        yield _line(entity, [entity.dxf.start, entity.dxf.end])
    elif kind in {"ARC", "CIRCLE"}:
        yield _line(entity, entity.flattening(min(error, 0.1 * entity.dxf.radius)))
    elif kind in {"ELLIPSE", "SPLINE"}:
        yield _line(entity, entity.flattening(error))
    elif kind in {"LWPOLYLINE", "POLYLINE"} and entity.has_arc:
        for part in entity.virtual_entities():
            yield from _of(part, error)
    elif kind in {"LWPOLYLINE", "POLYLINE"}:
        corners = list(entity.vertices_in_wcs() if kind == "LWPOLYLINE" else entity.points_in_wcs())
        yield _line(entity, [*corners, *corners[:1]] if entity.is_closed else corners)


def _line(entity: Any, points: Iterable[Any]) -> Line:
    return Line(entity.dxf.layer, np.array([(point[0], point[1]) for point in points]))
