"""What pages of drumrs share: the style sheet, and templates that escape what they are given."""

from importlib.resources import files
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment


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
