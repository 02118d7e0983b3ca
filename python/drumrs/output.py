"""What is made of a result: its folder with tables, pictures and a player."""

from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.files import write_whole
from drumrs.frames import Frames
from drumrs.result import UNSTABLE, Result, Summary, write_tables

if TYPE_CHECKING:
    import polars as pl

    from drumrs.viewer import Player


def player(result: Result) -> "Player":
    """Return a run as a player: shown by a notebook, or written as one HTML file with its `save`.

    Examples
    --------
    >>> import drumrs
    >>> config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
    >>> drumrs.player(drumrs.run(config, progress=False))
    <Player of 40 bundles, 3 frames>
    """
    return _player(result.config, result.series, result.frames)


def _player(config: Config, series: "pl.DataFrame", frames: Frames) -> "Player":
    from drumrs.viewer import Player

    return Player(frames, series, title=config.title, window=config.run.averaging_window)


def save(result: Result, folder: str | Path, *, pictures: bool = True) -> list[Path]:
    """Write config.toml, series.parquet, frames.parquet, pictures, a player and, last, summary.json.

    Parameters
    ----------
    result
        The run; `load` reads it again.
    folder
        Created where it does not exist.
    pictures
        Whether to draw snapshots.png and time_series.png, and to write player.html, which plays the run.

    Returns
    -------
    list of Path
        The files written.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    config, summary, series, frames = result.config, result.summary, result.series, result.frames
    written = write_tables(folder, config, series)
    frames.save(folder / "frames.parquet")
    drawn = draw(folder, config, summary, series, frames, frames) if pictures else []
    return [*written, folder / "frames.parquet", complete(folder, summary), *drawn]


def complete(folder: Path, summary: Summary) -> Path:
    """Write summary.json, which comes last: a folder that has one is complete."""
    write_whole(folder / "summary.json", f"{summary.to_json()}\n".encode())
    (folder / UNSTABLE).unlink(missing_ok=True)
    return folder / "summary.json"


def draw(
    folder: Path, config: Config, summary: Summary, series: "pl.DataFrame", shown: Frames, pictured: Frames
) -> list[Path]:
    """Write snapshots.png, time_series.png and player.html.

    Parameters
    ----------
    folder
        Where to write them.
    config, summary, series
        The run.
    shown
        Frames of the player.
    pictured
        Frames of the snapshots: at the start and at both ends of the window, with those beside them.

    Returns
    -------
    list of Path
        The files written.
    """
    from drumrs import figures

    start, end = window = config.run.averaging_window
    drawings = {"time_series.png": figures.time_series(series, window=window)}
    if len(pictured):
        indices = sorted({pictured.nearest(time) for time in (0.0, start, end)})
        fill = f"fill {100.0 * summary.fill:.0f} %"
        drawings["snapshots.png"] = figures.snapshots(
            [figures.View(pictured, index, fill) for index in indices]
        )
    for name, figure in drawings.items():
        figures.write(figure, folder / name)
    written = [folder / name for name in drawings]
    if len(shown):
        written.append(_player(config, series, shown).save(folder / "player.html"))
    return written
