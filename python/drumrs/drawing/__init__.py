"""Drawings of liners as outlines: read from a file, joined, checked, in meters.

`dxf`, `svg` and `table` read lines from files, curves broken into chords; `joined` makes outlines of loose lines;
`solids` closes what runs from rim to rim and refuses what is no outline, in words of who draws. Knows nothing of drumrs
but its errors.
"""

from pathlib import Path

from drumrs.drawing.joined import joined
from drumrs.drawing.line import Frame, Line, in_meters
from drumrs.drawing.solids import Drawn, solids
from drumrs.errors import ConfigError

__all__ = ["Drawn", "Frame", "Line", "read"]


def read(path: Path, frame: Frame) -> tuple[list[Drawn], int]:
    """Read the outlines of a drawing.

    Parameters
    ----------
    path
        A file with the name's end .dxf, .svg or .csv.
    frame
        The drum it is drawn for, and how its numbers become meters.

    Returns
    -------
    tuple
        The closed outlines with their names, their points in meters; and how often they stand round the drum: 1 where
        the copies of a pitch are one outline together.

    Raises
    ------
    ConfigError
        Where the file cannot be read, or holds something that is no outline.
    """
    lines, unit = _lines(path, frame)
    if not lines:
        hint = "lines, polylines, arcs, circles, ellipses and splines count"
        raise ConfigError("drum.liner.file", str(path), problem=f"{str(path)!r} holds no lines", hint=hint)
    return solids(joined(in_meters(lines, unit, frame), frame.accuracy), frame, path.name)


def _lines(path: Path, frame: Frame) -> tuple[list[Line], float | None]:
    """Return what is drawn, in the file's unit, and that unit [m] where the file says it."""
    from drumrs.drawing import dxf, svg, table

    readers = {".dxf": dxf.lines, ".svg": svg.lines, ".csv": table.lines}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise ConfigError("drum.liner.file", str(path), "the path of a drawing: .dxf, .svg or .csv")
    try:
        if not path.is_file():
            raise ConfigError("drum.liner.file", str(path), problem=f"{str(path)!r} is not there")
        return reader(path, frame)
    except ModuleNotFoundError as error:
        problem = f"{str(path)!r} needs the package {error.name} to be read"
        hint = "install it with: pip install 'drumrs[cad]'"
        raise ConfigError("drum.liner.file", str(path), problem=problem, hint=hint) from None
    except OSError as error:
        problem = f"{str(path)!r} cannot be read: {error.strerror or error}"
        raise ConfigError("drum.liner.file", str(path), problem=problem) from None
