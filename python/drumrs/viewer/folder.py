"""What can be viewed in a folder: a run, runs in folders of it, cases of a sweep by id or by their values."""

import glob
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from drumrs.config import Config, parse_settings
from drumrs.config.layers import flat
from drumrs.errors import ConfigError
from drumrs.folders import PACKS

FRAMES = "frames.parquet"
_MOST_LINES = 40
# Digits of a case's id that are shown where they tell cases apart.
_DIGITS = 8


def find(path: Path, wanted: Sequence[str] = ()) -> Path:
    """Return the file of the frames that a path stands for, a folder with one run, or the beginning of a case's id.

    Parameters
    ----------
    path
        A file, a folder, or a sweep's folder with the beginning of a case's id: ``sweep/3f2a``.
    wanted
        Which case of a sweep's folder: ``KEY=VALUE`` of its configuration, or the beginning of its id; all must hold.

    Raises
    ------
    ConfigError
        Where there is nothing to view, or there are several: they are listed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from drumrs.viewer import find
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     Path(folder, "1a2b.frames.parquet").touch()
    ...     Path(folder, "3f2a.frames.parquet").touch()
    ...     find(Path(folder, "3f")).name
    '3f2a.frames.parquet'
    """
    if path.is_file():
        return path
    if path.is_dir():
        if (path / FRAMES).is_file():
            return path / FRAMES
        return _one_of(path, [file for file in _recordings(path) if _is_wanted(file, wanted)], wanted)
    if path.parent.is_dir() and path.name:
        started = sorted(path.parent.glob(f"{glob.escape(path.name)}*.{FRAMES}"))
        if started:
            return _one_of(path, started, wanted)
    limit = (
        "the frames.parquet of a run, its folder, or the folder of a sweep with the beginning of a case's id"
    )
    packed = (path.parent / PACKS).is_dir()
    hint = f"where it is packed: drumrs pack {path.parent} --unpack {path.name}" if packed else ""
    raise ConfigError(path, limit=limit, hint=hint, problem=f"is not there, but must be {limit}")


def config_of(frames: Path) -> Config | None:
    """Return the configuration beside frames: config.toml in a run's folder, <id>.toml in a sweep's."""
    file = frames.with_name(f"{case_of(frames) or 'config'}.toml")
    return Config.read(file) if file.is_file() else None


def case_of(frames: Path) -> str:
    """Return the id of the case that a file of frames belongs to, empty for a run's."""
    return frames.name.removesuffix(FRAMES).rstrip(".")


def _recordings(folder: Path) -> list[Path]:
    """Return the frames of runs and cases in a folder and the folders in it."""
    return [
        file
        for pattern in (f"*.{FRAMES}", f"*/{FRAMES}", f"*/*.{FRAMES}")
        for file in sorted(folder.glob(pattern))
    ]


def _is_wanted(file: Path, wanted: Sequence[str]) -> bool:
    starts = [word for word in wanted if "=" not in word]
    settings = parse_settings(word for word in wanted if "=" in word)
    values = _values(file) if settings else {}
    return all(case_of(file).startswith(start) for start in starts) and all(
        key in values and values[key] == value for key, value in settings.items()
    )


def _one_of(path: Path, found: Sequence[Path], wanted: Sequence[str]) -> Path:
    """Return the only one found; list them where there are several, or say why there is none."""
    if len(found) == 1:
        return found[0]
    which = f" with {' and '.join(wanted)}" if wanted else ""
    if not found:
        raise ConfigError(path, problem=f"has nothing to view{which}: {_why_nothing(path)}")
    lines = list(_lines(found))
    more = [f"  … and {len(lines) - _MOST_LINES} more"] if len(lines) > _MOST_LINES else []
    listed = "\n".join([*lines[:_MOST_LINES], *more])
    raise ConfigError(path, problem=f"has {len(found)} runs to view{which}", hint=f"choose one:\n{listed}")


def _why_nothing(path: Path) -> str:
    if (path / "records").is_dir():
        return f"its run has not come to an end; go on with: drumrs run --resume {path}"
    if (path / PACKS).is_dir():
        return f"its cases are packed; drumrs pack {path} --unpack ID brings one back"
    if any(path.glob("*.series.parquet")):
        return "its cases keep no frames, as run.frame_every is not smaller than run.duration"
    there = sorted(entry.name for entry in path.iterdir()) if path.is_dir() else []
    shown = ", ".join(there[:_DIGITS]) + (", …" if len(there) > _DIGITS else "")
    return f"there is no frames.parquet in it, nor in its folders; it holds {shown or 'nothing'}"


def _lines(found: Sequence[Path]) -> Iterator[str]:
    """Say of each recording what to type, and by which keys it differs from the others."""
    values = [_values(file) for file in found]
    keys = [
        key
        for key in dict.fromkeys(key for one in values for key in one)
        if len({json.dumps(one.get(key)) for one in values}) > 1
    ]
    ids = [case_of(file) for file in found]
    digits = _DIGITS if len({one[:_DIGITS] for one in ids}) == len(ids) else None
    for file, case, one in zip(found, ids, values, strict=True):
        differs = ", ".join(f"{key}={json.dumps(one[key])}" for key in keys if key in one)
        yield f"  drumrs view {file.parent / case[:digits] if case else file.parent}  {differs}".rstrip()


def _values(file: Path) -> dict[str, Any]:
    """Return the configuration beside frames as values by dotted key, empty where there is none to read."""
    try:
        config = config_of(file)
    except ConfigError:
        return {}
    return flat(config.model_dump(mode="json", exclude_none=True)) if config is not None else {}
