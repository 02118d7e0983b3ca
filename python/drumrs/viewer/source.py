"""Reads a run for the player: its frames, and what lies beside them: series, configuration, discs."""

from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.errors import ConfigError
from drumrs.files import read_object
from drumrs.frames import Frames
from drumrs.result import UNSTABLE, ended_unstable, read_series
from drumrs.viewer.folder import FRAMES, case_of, config_of, find
from drumrs.viewer.page import Player
from drumrs.viewer.recording import MOST_PLACES

if TYPE_CHECKING:
    import polars as pl

_SERIES, _DISCS = "series.parquet", "discs.parquet"


def read(path: str | Path) -> Player:
    """Read a run for the player, with what lies beside its frames: series, configuration, discs.

    Parameters
    ----------
    path
        Folder of a run, a ``frames.parquet``, or a case of a sweep: its ``<id>.frames.parquet``, or the sweep's folder
        with the beginning of the id, ``sweep/3f2a``.

    Raises
    ------
    ConfigError
        Where there are no frames, or those of several runs, or a file is not what its name says.
    """
    path = find(Path(path))
    frames, series = read_frames(path, MOST_PLACES), read_series_beside(path)
    config = config_of(path)
    if config is None:
        return Player(frames, series, title=case_of(path) or path.absolute().parent.name)
    return Player.of(config, frames, series, _how_it_ended(path), _read_table(path, _DISCS))


def default_page(frames: Path) -> Path:
    """Return where the page of a file of frames goes unless told otherwise: beside it.

    Examples
    --------
    >>> from pathlib import Path
    >>> from drumrs.viewer import default_page
    >>> default_page(Path("sweep/3f2a.frames.parquet")).name
    '3f2a.player.html'
    """
    case, found, _ = frames.name.rpartition(FRAMES)
    return frames.with_name(f"{case}player.html" if found else f"{frames.stem}.player.html")


def read_frames(path: Path, most: int | None = None) -> Frames:
    """Read frames as `Frames.load` does; refuse what is no file of drumrs's."""
    from polars.exceptions import PanicException, PolarsError

    try:
        return Frames.load(path, most)
    except ConfigError:
        raise
    except (PolarsError, PanicException, KeyError, ValueError, TypeError, OSError):
        raise ConfigError(
            Path(path), problem="holds no frames, but must be a file that drumrs wrote"
        ) from None


def read_series_beside(frames: Path) -> "pl.DataFrame | None":
    """Read the series that lies beside a file of frames; `None` where there is none."""
    return _read_table(frames, _SERIES)


def _read_table(frames: Path, name: str) -> "pl.DataFrame | None":
    """Read a table that lies beside a file of frames; `None` where there is none."""
    import polars as pl

    path = frames.with_name(frames.name.removesuffix(FRAMES) + name)
    if not path.is_file():
        return None
    try:
        return read_series(path) if name == _SERIES else pl.read_parquet(path)
    except (pl.exceptions.PanicException, pl.exceptions.PolarsError, OSError):
        raise ConfigError(
            path, problem=f"is damaged, but must be the {name.removesuffix('.parquet')} that drumrs wrote"
        ) from None


def _how_it_ended(path: Path) -> str:
    """Return what is to be said of the end of a run: nothing where it went well."""
    ended = read_object(path.with_name(UNSTABLE)) if path.name == FRAMES else None
    return ended_unstable(ended["time"]) if ended is not None and "time" in ended else ""
