"""The study's figures: drawn once, kept as PNG and SVG, put into the page as whichever is smaller."""

import base64
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from drumrs.report.findings import Findings
from drumrs.study import FIGURES, MissingError, StudyFigure

_KINDS = {".svg": "image/svg+xml", ".png": "image/png"}


@dataclass(frozen=True)
class Picture:
    """A figure of the study as the page shows it.

    Attributes
    ----------
    figure
        Its number, title and caption.
    address
        The picture itself as an address, empty where it could not be drawn.
    missing
        What it lacks to be drawn.
    """

    figure: StudyFigure
    address: str = ""
    missing: str = ""


def draw(findings: Findings, folder: Path) -> list[Picture]:
    """Draw every figure of the study into a folder, as PNG and SVG.

    Raises
    ------
    OSError
        Where the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    return [_draw(figure, findings, folder) for figure in FIGURES.values()]


def _draw(figure: StudyFigure, findings: Findings, folder: Path) -> Picture:
    from drumrs import figures

    try:
        drawn = figure.draw(findings.material)
    except MissingError as missing:
        return Picture(figure, missing=str(missing))
    paths = [folder / f"{figure.number}{ending}" for ending in _KINDS]
    for path in paths:
        figures.write(drawn, path)
    return Picture(figure, embedded(paths))


def embedded(paths: Iterable[Path]) -> str:
    """Return the smallest of some picture files as an address that holds the picture itself."""
    smallest = min(paths, key=lambda path: path.stat().st_size)
    data = base64.b64encode(smallest.read_bytes()).decode("ascii")
    return f"data:{_KINDS[smallest.suffix]};base64,{data}"
