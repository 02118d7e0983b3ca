"""The file that `drumrs sweep` is given: a base, axes, seeds."""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config import Config, anchored, read_layer
from drumrs.config.layers import flat
from drumrs.config.messages import dotted_keys
from drumrs.errors import ConfigError
from drumrs.sweep.sweep import Sweep

if TYPE_CHECKING:
    from drumrs.sweep.design import Seeds

_KEYS = ("base", "axes", "seeds")


def read_sweep(path: str | Path, seeds: "Seeds" = None) -> Sweep:
    r"""Read a sweep file.

    ``[base]`` holds keys laid over the baseline, or over the case file that its key ``file`` names, relative to
    this one; ``base = "machine.toml"`` is short for that key alone. ``[axes]`` holds a list of values for each key to
    vary, ``seeds`` a list of seeds or their number. Keys are dotted or stand in tables, as in a case file.

    Parameters
    ----------
    path
        TOML file.
    seeds
        Seeds instead of the file's.

    Raises
    ------
    ConfigError
        Where the file or that of its base cannot be read, or a key or value is not accepted.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from drumrs.sweep import read_sweep
    >>> path = pathlib.Path(tempfile.mkdtemp(), "sweep.toml")
    >>> _ = path.write_text("seeds = 2\n[base]\nrun.duration = 1.0\n[axes]\nload.fill = [0.1, 0.2]\n")
    >>> len(read_sweep(path).cases)
    4
    """
    content = read_layer(path, "the file of a sweep", "drumrs sweep --help says what it holds")
    for key in content:
        if key not in _KEYS:
            raise ConfigError(key, content[key], problem="is not a key of a sweep file", hint=_meant(key))
    axes = table_of(content, "axes")
    folder = Path(path).parent
    return Sweep(
        read_base(content, folder),
        None if axes is None else flat(anchored(axes, folder)),
        content.get("seeds") if seeds is None else seeds,
    )


def read_base(content: Mapping[str, Any], folder: Path) -> Config:
    """Read what all cases share: a case file, keys, or keys laid over a case file.

    Raises
    ------
    ConfigError
        Where a file cannot be read, or a key or value is not accepted.
    """
    if isinstance(content.get("base"), str):
        return Config.read(folder / content["base"])
    keys = dict(table_of(content, "base") or {})
    file = keys.pop("file", None)
    if file is None:
        return Config().replace(anchored(keys, folder))
    if not isinstance(file, str):
        raise ConfigError("base.file", file, "the path of a case file")
    return Config.read(folder / file).replace(anchored(keys, folder))


def table_of(content: Mapping[str, Any], key: str) -> Mapping[str, Any] | None:
    """Return a table of a file, `None` where it has none of this name.

    Raises
    ------
    ConfigError
        Where it is no table.
    """
    table = content.get(key)
    if table is not None and not isinstance(table, Mapping):
        choice = " or the path of a case file" if key == "base" else ""
        raise ConfigError(key, table, f"a table{choice}")
    return table


def _meant(key: str) -> str:
    close = difflib.get_close_matches(key, _KEYS, n=1)
    if close:
        return f"did you mean {close[0]}?"
    if key.partition(".")[0] in set(dotted_keys(Config)):
        return f"did you mean base.{key} or axes.{key}? (the case file of a base is base.file)"
    return f"the keys there are {', '.join(_KEYS)}"
