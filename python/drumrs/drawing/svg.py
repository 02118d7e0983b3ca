"""Lines of an SVG file: all its shapes with their transforms, y upwards, groups for layers."""

import re
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError

import numpy as np

from drumrs.drawing.line import UNITS, Frame, Line
from drumrs.errors import ConfigError

_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
_GROUP = "{http://www.w3.org/2000/svg}g"
_LENGTH = re.compile(r"\s*([0-9.eE+-]+)\s*(mm|cm|in|m)\s*")
# Pieces of a curve at first, so that a curve that begins and ends on its chord is seen.
_PIECES = 4


def lines(path: Path, frame: Frame) -> tuple[list[Line], float | None]:
    """Return the lines of a file in its user unit, and that unit [m] where width and viewBox say it."""
    from svgpathtools import Document

    try:
        document: Any = Document(str(path))
    except ParseError as error:
        problem = f"{str(path)!r} is no SVG file that can be read: {error}"
        raise ConfigError("drum.liner.file", str(path), problem=problem) from None
    root = document.tree.getroot()
    unit = _unit(root)
    accuracy = frame.accuracy / frame.meters(unit)
    layers = _layers(root)
    found = []
    for drawn in document.paths():
        layer = layers.get(drawn.element, "")
        found += [Line(layer, _points(part, accuracy)) for part in drawn.continuous_subpaths()]
    return found, unit


def _unit(root: Any) -> float | None:
    """Return the user unit [m], where the width has a unit and a view box says how many of them it is."""
    width = _LENGTH.fullmatch(root.get("width", ""))
    box = root.get("viewBox", "").replace(",", " ").split()
    if width is None or len(box) != 4:  # noqa: PLR2004 - x, y, width, height
        return None
    return float(width[1]) * UNITS[width[2]] / float(box[2])


def _layers(root: Any) -> dict[Any, str]:
    """Return the name of the innermost named group round each element."""
    named: dict[Any, str] = {}

    def visit(element: Any, name: str) -> None:
        named[element] = name
        for child in element:
            own = child.get(_LABEL) or child.get("id") if child.tag == _GROUP else None
            visit(child, own or name)

    visit(root, "")
    return named


def _points(path: Any, error: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    from svgpathtools import Line as Straight

    points = [path[0].start]
    for part in path:
        if not isinstance(part, Straight):
            ends = np.linspace(0.0, 1.0, _PIECES + 1)
            for start, end in pairwise(ends):
                _flatten(part, (start, end), error, points)
        points.append(part.end)
    # An SVG's y axis points down.
    return np.array([(point.real, -point.imag) for point in points])


def _flatten(curve: Any, span: tuple[float, float], error: float, points: list[complex]) -> None:
    """Append the points of a piece of a curve but its first, halving until its middle is close to its chord."""
    start, end = span
    middle = 0.5 * (start + end)
    first, last, between = (curve.point(t) for t in (start, end, middle))
    if abs(between - 0.5 * (first + last)) > error:
        _flatten(curve, (start, middle), error, points)
        _flatten(curve, (middle, end), error, points)
    elif end < 1.0:
        points.append(last)
