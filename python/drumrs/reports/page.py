"""The page of a run: sections in, one HTML file out that needs nothing else."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.errors import ConfigError
from drumrs.pages import environment, picture_address, provenance, style, text_of, write_page
from drumrs.pictures import attempt
from drumrs.reports.catalog import PAGES
from drumrs.reports.content import Picture, Play, Table
from drumrs.reports.run_data import RunData
from drumrs.viewer import Player, script

if TYPE_CHECKING:
    from jinja2 import Template

    from drumrs.reports.content import Block, Section
    from drumrs.result import Result

REPORT = "report.html"


def report(result: "Result", page: str = "research", folder: str | Path = ".") -> Path:
    """Write one HTML page of a run for a trade: its numbers with errors, pictures, player and energy ledger.

    Parameters
    ----------
    result
        The run, such as `run` returns and `load` reads.
    page
        ``"washer"``, ``"dryer"``, ``"mill"``, ``"coater"``, or ``"research"``, which has everything.
    folder
        Where report.html is written; or the file itself, by a name that ends in ``.html``.

    Returns
    -------
    Path
        The file. It needs neither network nor other files.

    Raises
    ------
    ConfigError
        Where there is no such page, the run has no frame, or a file there is not drumrs's own.
    OSError
        Where it cannot be written.

    Warns
    -----
    PictureWarning
        Where a picture could not be made; everything else is there.

    Examples
    --------
    >>> import tempfile
    >>> import drumrs
    >>> result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.1}), progress=False)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     drumrs.report(result, page="washer", folder=folder).name
    'report.html'
    """
    require_page(page)
    path = Path(folder)
    return write_page(path if path.suffix == ".html" else path / REPORT, render(result, page))


def require_page(page: str, option: str = "page") -> None:
    """Refuse the name of a page that there is not.

    Raises
    ------
    ConfigError
        Where there is none.
    """
    if page not in PAGES:
        raise ConfigError(option, page, f"one of {', '.join(PAGES)}")


def render(result: "Result", page: str) -> str:
    """Return the page of a run as text."""
    data, chosen = RunData(result), PAGES[page]
    player = Player.of(result.config, result.frames, result.series, discs=result.discs)
    made = [_make(section, data) for section in chosen.sections]
    return _template().render(
        style=style(),
        page=chosen,
        name=page,
        run=player.title,
        facts=player.facts,
        window=data.window,
        span=data.span,
        duration=data.duration,
        sections=[one for one in made if one.blocks or one.missing],
        player=player.element(start=data.window[0]),
        player_script=script(),
        config=result.config.to_toml(),
        versions=provenance.versions(),
        machine=provenance.machine(),
        written=provenance.now(),
    )


@dataclass(frozen=True)
class _Made:
    """A section of a run: its blocks as the template takes them, by kind, and what it lacks."""

    section: "Section"
    blocks: tuple[tuple[str, Any], ...]
    missing: str


def _make(section: "Section", data: RunData) -> _Made:
    blocks, missing = section.blocks(data)
    return _Made(section, tuple((_KINDS[type(block)], _shown(block)) for block in blocks), missing)


_KINDS: Mapping[type, str] = {
    str: "text",
    Table: "table",
    Picture: "picture",
    Play: "player",
}


def _shown(block: "Block") -> Any:
    """Return a block as the template takes it: a picture with its address, or why there is none."""
    if not isinstance(block, Picture):
        return block
    with attempt(f"the picture {block.title!r}") as made:
        return {"of": block, "address": picture_address(block.draw()), "reason": ""}
    return {"of": block, "address": "", "reason": made.failure}


@cache
def _template() -> "Template":
    return environment().from_string(text_of("drumrs.reports", "report.html.j2"))
