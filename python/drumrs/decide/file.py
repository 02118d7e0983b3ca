"""`DecisionFile`: what a file of `drumrs screen`, `optimize` or `calibrate` says: a base, keys that vary, a table."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Self

from drumrs.config import Config, anchored, read_layer
from drumrs.config.layers import flat
from drumrs.decide.difference import Difference
from drumrs.decide.space import MOST_KEYS, Space
from drumrs.errors import ConfigError
from drumrs.sweep.sweep_file import read_base, table_of

# By command: what its file is of, and its tables; the last one has the name of the command.
_KINDS = MappingProxyType(
    {
        "screen": ("a screening", ("base", "ranges", "axes", "screen")),
        "optimize": ("an optimization", ("base", "ranges", "axes", "optimize")),
        "calibrate": ("a calibration", ("base", "ranges", "measured", "candidate", "calibrate")),
    }
)
_MOST = 1000


@dataclass(frozen=True)
class DecisionFile:
    """The file of a decision, or a mapping of the same form.

    Attributes
    ----------
    command
        The command that it is for.
    base
        What all runs share.
    content
        The tables, by name.
    folder
        Folder to which paths in it are relative.
    """

    command: str
    base: Config
    content: Mapping[str, Any]
    folder: Path

    @classmethod
    def read(cls, source: "str | Path | Mapping[str, Any]", command: str) -> Self:
        """Read a file, or take a mapping, whose ``base`` may be a `Config`.

        Raises
        ------
        ConfigError
            Where the file cannot be read, it has a table that such a file cannot have, or a key of ``[base]`` is not
            accepted.
        """
        what, tables = _KINDS[command]
        if isinstance(source, Mapping):
            content, folder = source, Path()
        else:
            hint = f"drumrs {command} --help says what [{'], ['.join(tables)}] hold"
            content, folder = read_layer(source, f"the file of {what}", hint), Path(source).parent
        _refuse_unknown(command, content, tables)
        base = content.get("base")
        return cls(command, base if isinstance(base, Config) else read_base(content, folder), content, folder)

    def options(self, *known: str) -> Mapping[str, Any]:
        """Return the table that has the name of the command, with these keys.

        Raises
        ------
        ConfigError
            Where it has another.
        """
        own = table_of(self.content, self.command) or {}
        self.refuse_unknown(own, known, f"{self.command}.")
        return own

    def space(self, most: int = MOST_KEYS) -> Space:
        """Return the keys that vary, at most so many: ranges, and choices where the file may have some.

        Raises
        ------
        ConfigError
            Where a key, a range or a choice is not accepted.
        """
        ranges, axes = (
            flat(anchored(table_of(self.content, key) or {}, self.folder)) for key in ("ranges", "axes")
        )
        space = Space.read(ranges, axes if "axes" in _KINDS[self.command][1] else None, most)
        space.check(self.base)
        return space

    def refuse_unknown(self, table: Mapping[str, Any], known: tuple[str, ...], at: str = "") -> None:
        """Refuse keys that a table of the file cannot have.

        Raises
        ------
        ConfigError
            Where there is one; the sentence lists the keys there are.
        """
        _refuse_unknown(self.command, table, known, at)


def _refuse_unknown(command: str, table: Mapping[str, Any], known: tuple[str, ...], at: str = "") -> None:
    for key in table:
        if key not in known:
            hint = f"the keys there are {', '.join(known)}"
            raise ConfigError(
                f"{at}{key}",
                table[key],
                problem=f"is not a key of {_KINDS[command][0]}",
                hint="each run has a seed of its own" if key == "seeds" else hint,
            )


def whole(value: Any, key: str, least: int, most: int = _MOST) -> int:
    """Return a whole number.

    Raises
    ------
    ConfigError
        Where it is none, or out of its limits.
    """
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise ConfigError(key, value, f"a whole number from {least} to {most}", bound=least)
    return value


def share(value: Any, unit: str, key: str) -> Difference:
    """Read a percentage, or a number in a unit.

    Raises
    ------
    ConfigError
        Where it is neither.
    """
    try:
        return Difference.parse(value, unit)
    except ConfigError as error:
        error.key = key
        raise


def listed(table: Mapping[str, Any], key: str, default: tuple[Any, ...] = ()) -> list[Any]:
    """Return what a key lists; a single value stands for a list of one."""
    value = table.get(key, default)
    return list(value) if isinstance(value, (list, tuple)) else [value]
