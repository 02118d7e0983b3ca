"""What is made of a result: its folder with tables, pictures and a player."""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.analysis.phases import phases_of
from drumrs.config import Config
from drumrs.contact_records import write_contact_tables
from drumrs.files import remove_temporaries, write_whole
from drumrs.folders import RUN_FILES, claim, is_claimed, require_own, require_unused
from drumrs.frames import Frames
from drumrs.parts import Parts
from drumrs.pictures import attempt
from drumrs.registry import known, metadata
from drumrs.result import UNSTABLE, Result, Summary, ended_unstable, write_tables
from drumrs.tables import write_table
from drumrs.unstable import UnstableRun

if TYPE_CHECKING:
    import polars as pl

    from drumrs.viewer import Player


def player(run: Result | UnstableRun) -> "Player":
    """Return a run as a player: shown by a notebook, or written as one HTML file with its `save`.

    Parameters
    ----------
    run
        A finished run, or one that ended unstable, whose end is the last frame.

    Examples
    --------
    >>> import drumrs
    >>> config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.1})
    >>> drumrs.player(drumrs.run(config, progress=False))
    <Player of 40 bundles, 3 frames>
    """
    from drumrs.viewer import Player

    if isinstance(run, UnstableRun):
        return Player.of(run.config, run.frames, run.series, ended_unstable(run.time))
    return Player.of(run.config, run.frames, run.series, discs=run.discs)


def save(result: Result, folder: str | Path, *, pictures: bool = True, force: bool = False) -> list[Path]:
    """Write config.toml, series.parquet, frames.parquet and summary.json, then pictures and a player.

    Where the drum turns by phases, phases.parquet holds what `phases` returns. What `run.record` and
    `run.zone` ask for goes to contacts.parquet, wall_profile.parquet and the like, by the names of the tables.

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

    Warns
    -----
    PictureWarning
        Where a picture or the player could not be made; everything else is there.

    Examples
    --------
    >>> import tempfile
    >>> import drumrs
    >>> result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.1}), progress=False)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in drumrs.save(result, folder, pictures=False)]
    ['config.toml', 'series.parquet', 'frames.parquet', 'summary.json']
    """
    folder = Path(folder)
    require_folder(folder, result.config, force=force, way="force=True")
    claim_folder(folder, result.config)
    config, summary, series, frames = result.config, result.summary, result.series, result.frames
    written = [*write_tables(folder, config, series), *write_phases(folder, config, series)]
    frames.save(folder / "frames.parquet")
    written.append(folder / "frames.parquet")
    written += write_contact_tables(folder, result.contact_tables())
    written.append(complete(folder, summary))
    return [*written, *(draw(folder, config, summary, series, frames) if pictures else [])]


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
    # Exports and films lie beside the frames, under their name.
    for path in (*map(folder.joinpath, RUN_FILES), *folder.glob("frames[.-]*")):
        if not path.is_dir():
            path.unlink(missing_ok=True)
    remove_temporaries(folder)
    Parts(folder).remove()


def write_phases(folder: Path, config: Config, series: "pl.DataFrame") -> list[Path]:
    """Write phases.parquet where the drum turns by phases; return its path, or none."""
    path = folder / "phases.parquet"
    path.unlink(missing_ok=True)
    if not config.rotation.phase:
        return []
    table = phases_of(config, series)
    write_table(path, table, metadata(known(table.columns)))
    return [path]


def complete(folder: Path, summary: Summary) -> Path:
    """Write summary.json, the last of the numbers: a folder that has one holds a finished run."""
    write_whole(folder / "summary.json", f"{summary.to_json()}\n".encode())
    (folder / UNSTABLE).unlink(missing_ok=True)
    return folder / "summary.json"


def save_unstable(run: UnstableRun, folder: Path) -> list[Path]:
    """Write unstable.json and player.html, beside the tables; return the paths of what was written."""
    summary = asdict(run.summary) if run.summary is not None else None
    told = {"error": run.error, "step": run.step, "time": run.time, "summary": summary}
    write_whole(folder / UNSTABLE, f"{json.dumps(told, indent=2)}\n".encode())
    return [folder / UNSTABLE, *_make(folder, {"player.html": lambda path: player(run).save(path)})]


def draw(
    folder: Path, config: Config, summary: Summary, series: "pl.DataFrame", pictured: Frames
) -> list[Path]:
    """Write snapshots.png, time_series.png and player.html.

    Parameters
    ----------
    folder
        Where to write them, beside what was recorded.
    config, summary, series
        The run.
    pictured
        Frames of the snapshots: at the start and at both ends of the window, with those beside them.

    Returns
    -------
    list of Path
        The files written.

    Warns
    -----
    PictureWarning
        Where one of them could not be made; the others are there.
    """
    start, end = window = config.run.averaging_window
    fill = f"fill {100.0 * summary.fill:.3g} %"

    def draw_time_series(path: Path) -> None:
        from drumrs import figures

        starts = [each.start for each in config.rotation.intervals]
        figures.write(figures.time_series(series, window=window, starts=starts), path)

    def draw_snapshots(path: Path) -> None:
        from drumrs import figures

        indices = sorted({pictured.nearest(time) for time in (0.0, start, end)})
        figures.write(figures.snapshots([figures.View(pictured, index, fill) for index in indices]), path)

    def write_player(path: Path) -> None:
        from drumrs import viewer

        viewer.read(folder).save(path)

    drawings: dict[str, Callable[[Path], object]] = {"time_series.png": draw_time_series}
    if len(pictured):
        drawings["snapshots.png"] = draw_snapshots
        drawings["player.html"] = write_player
    return _make(folder, drawings)


def _make(folder: Path, drawings: Mapping[str, Callable[[Path], object]]) -> list[Path]:
    """Make pictures by name of their file, each for itself; return the files written."""
    written = []
    for name, make in drawings.items():
        # A picture of an earlier run must not pass for one of this.
        (folder / name).unlink(missing_ok=True)
        with attempt(folder / name):
            make(folder / name)
            written.append(folder / name)
    return written
