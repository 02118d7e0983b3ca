"""Lines of a DXF file: whatever of its model space ezdxf can turn into a path, blocks resolved."""

from pathlib import Path
from typing import Any

import numpy as np

from drumrs.drawing.line import UNITS, Frame, Line
from drumrs.errors import ConfigError

# Codes of the header's $INSUNITS.
_CODES = {1: "in", 4: "mm", 5: "cm", 6: "m"}
_DRAWN = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"}


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
    drawn = [entity for entity in entities if entity.dxftype() in _DRAWN]
    return [line for entity in drawn for line in _of(entity, accuracy)], unit


def _of(entity: Any, error: float) -> list[Line]:
    """Return the polylines of an entity, its curves broken into chords with an error in the file's unit."""
    from ezdxf.path import make_path

    paths = [path for path in make_path(entity).sub_paths() if len(path)]
    points = [np.array([(point.x, point.y) for point in path.flattening(error)]) for path in paths]
    return [Line(entity.dxf.layer, line) for line in points]
