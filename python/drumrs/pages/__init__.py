"""What pages of drumrs share: the style sheet, templates that escape what they are given, and how they are written."""

import base64
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.errors import ConfigError
from drumrs.files import write_whole

if TYPE_CHECKING:
    from jinja2 import Environment
    from matplotlib.figure import Figure

# Stands in the head of every page, and tells ours from others'.
_GENERATOR = b'<meta name="generator" content="drumrs">'
_HEAD = 1000
# Beyond so many bytes a picture is one of many marks, which PNG holds in fewer.
_LARGE = 200_000
_PICTURES = {"svg": "image/svg+xml", "png": "image/png"}


def text_of(package: str, name: str) -> str:
    """Return a text file of a package."""
    return files(package).joinpath(name).read_text(encoding="utf-8")


def style() -> str:
    """Return the style sheet."""
    return text_of(__name__, "page.css")


def environment() -> "Environment":
    """Return where templates are made from; names and messages come from files and errors, so it escapes them."""
    from jinja2 import Environment, StrictUndefined

    return Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)


def address(picture: bytes, kind: str) -> str:
    """Return a picture, ``"svg"`` or ``"png"``, as an address that holds the picture itself."""
    return f"data:{_PICTURES[kind]};base64,{base64.b64encode(picture).decode('ascii')}"


def picture_address(figure: "Figure") -> str:
    """Return a figure as an address that holds it: as SVG, or as PNG where that would be large."""
    from drumrs.figures import render

    drawn = render(figure, "svg")
    return address(drawn, "svg") if len(drawn) <= _LARGE else address(render(figure, "png"), "png")


def check_page(path: str | Path, what: str = "the page") -> None:
    """Refuse a name under which a page cannot be written: that of a folder, or of a file that drumrs did not write.

    Parameters
    ----------
    path
        File of the page.
    what
        What the user called it.

    Raises
    ------
    ConfigError
        Where there is such a thing.
    """
    path = Path(path)
    if path.is_dir():
        raise ConfigError(what, path, "a file: it is a folder")
    if path.exists():
        with path.open("rb") as file:
            if _GENERATOR not in file.read(_HEAD):
                limit = "a new file or a page of drumrs: this one is another's, and is not overwritten"
                raise ConfigError(what, path, limit)


def write_page(path: str | Path, text: str) -> Path:
    """Write a page, whole or not at all, and return its path.

    Raises
    ------
    ConfigError
        As `check_page`.
    OSError
        Where the file cannot be written.
    """
    check_page(path)
    write_whole(path, text.encode())
    return Path(path)
