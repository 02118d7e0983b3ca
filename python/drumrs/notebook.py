"""How things are shown in a notebook: a caption, rows of names and values, a longer text to unfold."""

from collections.abc import Mapping
from html import escape


def table(caption: str, rows: Mapping[str, object], more: tuple[str, str] | None = None) -> str:
    """Return a table as HTML.

    Parameters
    ----------
    caption
        What is shown.
    rows
        Values by name.
    more
        Title and text of what is there to unfold.

    Examples
    --------
    >>> table("case", {"fill": "10 % & more"})
    '<table><caption>case</caption><tr><th>fill</th><td>10 % &amp; more</td></tr></table>'
    """
    lines = "".join(
        f"<tr><th>{escape(name)}</th><td>{escape(str(value))}</td></tr>" for name, value in rows.items()
    )
    shown = f"<table><caption>{escape(caption)}</caption>{lines}</table>"
    if more is None:
        return shown
    title, text = map(escape, more)
    return f"{shown}<details><summary>{title}</summary><pre>{text}</pre></details>"
