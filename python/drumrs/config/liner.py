"""Where the drawing of a liner is read: its outlines take the place of the file's name in the configuration."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config.messages import conflict
from drumrs.config.to_core import chord_error
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.config.tables import Tables

_KEY = ("drum", "liner", "file")
# What tells how a file is read, and means nothing once it is.
_READING = {"file", "scale", "mirror", "units"}


def with_drawing(config: "Tables") -> dict[str, Any]:
    """Return the values of a configuration, with the outlines of the liner's file in place of its name."""
    from drumrs.drawing import Frame, read

    drum, liner = config.drum, config.drum.liner
    frame = Frame(
        radius=drum.diameter / 2.0 if drum.rim else None,
        repeat=liner.repeat,
        scale=liner.scale,
        mirror=liner.mirror,
        units=liner.units,
        accuracy=chord_error(config.load),
    )
    try:
        outlines, repeat = read(Path(liner.file or ""), frame)
    except ConfigError as error:
        fields = {"limit": error.limit, "hint": error.hint, "problem": error.problem}
        raise conflict(error.key, error.value, **fields) from None
    values = config.model_dump(exclude_none=True)
    kept = {key: value for key, value in values["drum"]["liner"].items() if key not in _READING}
    values["drum"]["liner"] = {
        **kept,
        "repeat": repeat,
        "outlines": [{"name": outline.name, "points": outline.points.tolist()} for outline in outlines],
    }
    return values


def anchored(layer: Mapping[str, Any], folder: Path, at: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return a layer in which the path of a liner's file, or each of a list, starts from a folder.

    Examples
    --------
    >>> anchored({"drum": {"liner.file": "liner.dxf"}}, Path("cases"))["drum"]["liner.file"]
    'cases/liner.dxf'
    """
    found: dict[str, Any] = {}
    for key, value in layer.items():
        path = (*at, *key.split("."))
        if path == _KEY and isinstance(value, str):
            found[key] = str(folder / value)
        elif path == _KEY and isinstance(value, list):
            found[key] = [str(folder / one) if isinstance(one, str) else one for one in value]
        elif isinstance(value, Mapping):
            found[key] = anchored(value, folder, path)
        else:
            found[key] = value
    return found
