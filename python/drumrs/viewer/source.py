"""Where a run's frames lie: a folder of a run, its frames.parquet, or a case of a sweep."""

from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config
from drumrs.errors import ConfigError
from drumrs.frames import Frames
from drumrs.viewer.page import Player
from drumrs.viewer.recording import MOST_PLACES

if TYPE_CHECKING:
    import polars as pl

_FRAMES = "frames.parquet"
_SERIES = "series.parquet"


def read(path: str | Path) -> Player:
    """Read a run for the player, with the series and configuration that lie beside its frames.

    Parameters
    ----------
    path
        Folder of a run, a ``frames.parquet``, or a case ``<id>.frames.parquet`` of a sweep.

    Raises
    ------
    ConfigError
        Where there are no frames, or a file is not what its name says.
    """
    path = _frames_file(Path(path))
    frames = _read_frames(path)
    series = _read_series(path.with_name(path.name.removesuffix(_FRAMES) + _SERIES))
    config = _read_config(path)
    if config is None:
        return Player(frames, series, title=_name(path))
    return Player(frames, series, title=config.title, window=config.run.averaging_window)


def default_page(path: str | Path) -> Path:
    """Return where the page of `read` goes unless told otherwise: beside the frames.

    Examples
    --------
    >>> from drumrs.viewer import default_page
    >>> default_page("sweep/3f2a.frames.parquet").name
    '3f2a.player.html'
    """
    path = _frames_file(Path(path))
    case, frames, _ = path.name.rpartition(_FRAMES)
    return path.with_name(f"{case}player.html" if frames else f"{path.stem}.player.html")


def _frames_file(path: Path) -> Path:
    return path / _FRAMES if path.is_dir() else path


def _read_frames(path: Path) -> Frames:
    from polars.exceptions import PanicException, PolarsError

    if not path.is_file():
        problem = "is not there, but must be the frames.parquet of a run, or its folder"
        raise ConfigError(Path(path), problem=problem)
    try:
        return Frames.load(path, MOST_PLACES)
    except (PolarsError, PanicException, KeyError, ValueError, TypeError, OSError):
        raise ConfigError(
            Path(path), problem="holds no frames, but must be a file that drumrs wrote"
        ) from None


def _read_series(path: Path) -> "pl.DataFrame | None":
    import polars as pl
    from polars.exceptions import PanicException, PolarsError

    if not path.is_file():
        return None
    try:
        return pl.read_parquet(path)
    except (PolarsError, PanicException, OSError):
        raise ConfigError(
            Path(path), problem="is damaged, but must be the series that drumrs wrote"
        ) from None


def _read_config(path: Path) -> Config | None:
    """Return the configuration beside the frames: config.toml in a run's folder, <id>.toml in a sweep's."""
    stem = path.name.removesuffix(_FRAMES).rstrip(".")
    file = path.with_name(f"{stem or 'config'}.toml")
    return Config.read(file) if file.is_file() else None


def _name(path: Path) -> str:
    name = path.name.removesuffix(_FRAMES).rstrip(".")
    return name or path.absolute().parent.name
