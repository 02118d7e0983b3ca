"""The study's figures, kept as PNG and SVG, in the page as whichever is smaller; and players of two runs."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from drumrs.pages import address
from drumrs.paper.cases import BASELINE_FILL
from drumrs.paper.data import StudyData
from drumrs.paper.drums import BAFFLED, BARE
from drumrs.paper.figures import FIGURES, PaperFigure
from drumrs.paper.verdict import MissingError
from drumrs.pictures import attempt
from drumrs.viewer import Player

_ENDINGS = (".svg", ".png")


@dataclass(frozen=True)
class Picture:
    """A figure of the study as the page shows it.

    Attributes
    ----------
    figure
        Its number, title and caption.
    address
        The picture itself as an address, empty where it could not be drawn.
    reason
        Why it could not be drawn, in a sentence.
    """

    figure: PaperFigure
    address: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Pictures:
    """The pictures of a study: its figures, and one of each claim as an address, by the claim's number."""

    figures: tuple[Picture, ...] = ()
    thumbnails: Mapping[str, str] = field(default_factory=dict)


def draw(data: StudyData, folder: Path) -> Pictures:
    """Draw every figure of the study into a folder, as PNG and SVG, and the curves of every claim.

    Raises
    ------
    OSError
        Where the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    return Pictures(
        tuple(_draw(figure, data, folder) for figure in FIGURES.values()), dict(_thumbnails(data, folder))
    )


def _draw(figure: PaperFigure, data: StudyData, folder: Path) -> Picture:
    paths = [folder / f"{figure.number}{ending}" for ending in _ENDINGS]
    with attempt(f"figure {figure.number}") as made:
        from drumrs import figures

        try:
            drawn = figure.draw(data)
        except MissingError as missing:
            return Picture(figure, reason=f"Missing: {missing}.")
        for path in paths:
            figures.write(drawn, path)
            # One arrangement serves both files, and takes longer than drawing.
            drawn.set_layout_engine("none")
        return Picture(figure, embedded(paths))
    return Picture(figure, reason=f"{made.failure}.")


def _thumbnails(data: StudyData, folder: Path) -> Iterator[tuple[str, str]]:
    for verdict in data.verdicts:
        path = folder / f"{verdict.claim}.png"
        with attempt(f"the picture of claim {verdict.claim}"):
            from drumrs import figures
            from drumrs.paper.thumbnails import thumbnail

            try:
                figures.write(thumbnail(verdict, data.results), path)
            except MissingError:
                continue
            yield verdict.claim, embedded([path])


def embedded(paths: Iterable[Path]) -> str:
    """Return the smallest of some picture files as an address that holds the picture itself."""
    smallest = min(paths, key=lambda path: path.stat().st_size)
    return address(smallest.read_bytes(), smallest.suffix.removeprefix("."))


def players(data: StudyData) -> list[Player]:
    """Return a player of the first seed without and one with baffles at 25 % fill, as far as they are finished."""
    found = []
    for drum in (BARE, BAFFLED):
        try:
            case = data.cases(BASELINE_FILL, drum)[0]
        except MissingError:
            continue
        config = case.config
        with attempt(f"the player of {config.title}"):
            frames, series = data.sweep.frames(case, data.folder), data.sweep.series(case, data.folder)
            found.append(Player.of(config, frames, series))
    return found
