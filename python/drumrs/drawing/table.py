"""Lines of a CSV file: x, y, and a third column that names the part; a blank line or another part begins a new one."""

import re
from pathlib import Path

import numpy as np

from drumrs.drawing.line import Frame, Line
from drumrs.errors import ConfigError

_SEPARATOR = re.compile(r"\s*[,;\t]\s*|\s+")


def lines(path: Path, _: Frame) -> tuple[list[Line], float | None]:
    """Return the polylines of a table in its unit, which such a file does not say."""
    try:
        rows = path.read_text("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise ConfigError(
            "drum.liner.file", str(path), problem=f"{str(path)!r} is not text in UTF-8"
        ) from None
    found: list[tuple[str, list[tuple[float, float]]]] = []
    is_new = True
    for number, row in enumerate(rows, 1):
        fields = [] if row.lstrip().startswith("#") else _SEPARATOR.split(row.strip())
        if fields == [""]:
            is_new = True
            continue
        if not fields or (number == 1 and not _is_number(fields[0])):
            continue
        part = " ".join(fields[2:])
        if is_new or part != found[-1][0]:
            found.append((part, []))
        found[-1][1].append(_point(path, number, row, fields))
        is_new = False
    return [Line(part, np.array(points)) for part, points in found if len(points) > 1], None


def _point(path: Path, number: int, row: str, fields: list[str]) -> tuple[float, float]:
    if len(fields) > 1 and _is_number(fields[0]) and _is_number(fields[1]):
        return float(fields[0]), float(fields[1])
    problem = f"{str(path)!r} has {row.strip()!r} in line {number}, but must have x, y or x, y, part there"
    hint = "numbers have a decimal point, and a comma, a semicolon, a tab or a space stands between them"
    raise ConfigError("drum.liner.file", str(path), problem=problem, hint=hint)


def _is_number(text: str) -> bool:
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False
