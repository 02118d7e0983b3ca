"""What is made of a result: its folder with tables, pictures and a player."""

from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.files import remove_temporaries, write_whole
from drumrs.folders import RUN_FILES, claim, is_claimed, require_own, require_unused
from drumrs.frames import Frames
from drumrs.parts import Parts
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


def save(result: Result, folder: str | Path, *, pictures: bool = True, force: bool = False) -> list[Path]:
    """Write config.toml, series.parquet, frames.parquet, pictures, a player and, last, summary.json.

    Parameters
    ----------
    result
        The run; `load` reads it again.
    folder
        Created where it does not exist. It is this run's: one that holds another run, or files of these names that
        drumrs did not write, is refused.
    pictures
        Whether to draw snapshots.png and time_series.png, and to write player.html, which plays the run.
    force
        Whether to replace another run in the folder.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    ConfigError
        Where the folder is not accepted.
    OSError
        Where it cannot be written.
    """
    folder = Path(folder)
    require_folder(folder, result.config, force=force, way="force=True")
    claim_folder(folder, result.config)
    config, summary, series, frames = result.config, result.summary, result.series, result.frames
    written = write_tables(folder, config, series, result.units)
    frames.save(folder / "frames.parquet")
    drawn = draw(folder, config, summary, series, frames, frames) if pictures else []
    return [*written, folder / "frames.parquet", complete(folder, summary), *drawn]


def require_folder(
    folder: Path, config: Config, *, force: bool, way: str = "--force", option: str = "folder"
) -> None:
    """Refuse a folder for a run that holds another one, or files that drumrs did not write.

    Parameters
    ----------
    folder
        Where the run's results are to be written; it need not exist.
    config
        What the run is of; the same run may be written again.
    force
        Whether another run is to be replaced.
    way
        How to ask for that.
    option
        What the user called the folder.

    Raises
    ------
    ConfigError
        Where the folder is not accepted.
    """
    require_own(folder, "run", RUN_FILES, option)
    if not force:
        require_unused(folder, "run", digest=config.digest, force=way, option=option)


def claim_folder(folder: Path, config: Config) -> None:
    """Make a run's folder, and remove what another run left there.

    Raises
    ------
    OSError
        Where it cannot be written.
    """
    if not is_claimed(folder, "run", config.digest):
        clear_folder(folder)
    claim(folder, "run", config.title, config.digest)


def clear_folder(folder: Path) -> None:
    """Remove what a run has left in its folder: nothing of it must pass for a part of another run."""
    for name in RUN_FILES:
        if not (folder / name).is_dir():
            (folder / name).unlink(missing_ok=True)
    remove_temporaries(folder)
    Parts(folder).remove()


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
