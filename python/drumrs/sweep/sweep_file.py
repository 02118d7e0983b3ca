"""The file that `drumrs sweep` is given: a base, axes, seeds."""

import difflib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drumrs.config import Config, read_layer
from drumrs.config.messages import dotted_keys
from drumrs.errors import ConfigError
from drumrs.sweep.sweep import Sweep

if TYPE_CHECKING:
    from drumrs.sweep.design import Seeds

_KEYS = ("base", "axes", "seeds")


def read_sweep(path: str | Path, seeds: "Seeds" = None) -> Sweep:
    r"""Read a sweep file.

    ``[base]`` holds keys laid over the baseline, ``[axes]`` a list of values for each key to vary, ``seeds`` a list of
    seeds or their number. Keys are dotted or stand in tables, as in a case file.

    Parameters
    ----------
    path
        TOML file.
    seeds
        Seeds instead of the file's.

    Raises
    ------
    ConfigError
        Where the file cannot be read, or a key or value is not accepted.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from drumrs.sweep import read_sweep
    >>> path = pathlib.Path(tempfile.mkdtemp(), "sweep.toml")
    >>> _ = path.write_text("seeds = 2\n[base]\nrun.duration = 1.0\n[axes]\nload.fill = [0.1, 0.2]\n")
    >>> len(read_sweep(path).cases)
    4
    """
    content = read_layer(path)
    for key in content:
        if key not in _KEYS:
            raise ConfigError(key, content[key], problem="is not a key of a sweep file", hint=_meant(key))
    base, axes = (_table(content, key) for key in ("base", "axes"))
    return Sweep(
        Config().replace(base or {}),
        None if axes is None else dict(_flat(axes)),
        content.get("seeds") if seeds is None else seeds,
    )


def _table(content: Mapping[str, Any], key: str) -> Mapping[str, Any] | None:
    table = content.get(key)
    if table is not None and not isinstance(table, Mapping):
        raise ConfigError(key, table, "a table")
    return table


def _flat(axes: Mapping[str, Any], at: str = "") -> Iterator[tuple[str, Any]]:
    """List the axes by dotted key, whether a table or a dotted key holds them."""
    for key, value in axes.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{at}{key}.")
        else:
            yield f"{at}{key}", value


def _meant(key: str) -> str:
    close = difflib.get_close_matches(key, _KEYS, n=1)
    if close:
        return f"did you mean {close[0]}?"
    if key.partition(".")[0] in set(dotted_keys(Config)):
        return f"did you mean base.{key} or axes.{key}?"
    return f"the keys there are {', '.join(_KEYS)}"
