"""Layers of keys: a case file over the baseline, command-line settings over the file, the upper one winning."""

import json
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, ClassVar, Protocol, cast

from pydantic import BaseModel

from drumrs.config.messages import both_given, table_type
from drumrs.errors import ConfigError, format_value


class _Choosing(Protocol):
    choice: ClassVar[tuple[str, ...]]


def nest(dotted: Mapping[str, Any]) -> dict[str, Any]:
    """Turn dotted keys into nested tables.

    Examples
    --------
    >>> nest({"load.fill": 0.4, "run.seed": 2})
    {'load': {'fill': 0.4}, 'run': {'seed': 2}}
    """
    nested: dict[str, Any] = {}
    for key, value in dotted.items():
        *tables, leaf = key.split(".")
        table = nested
        for depth, name in enumerate(tables, 1):
            table = table.setdefault(name, {})
            if not isinstance(table, dict):
                raise ConfigError(".".join(tables[:depth]), table, f"a table, for {key} is given, too")
        if isinstance(value, Mapping) and isinstance(table.get(leaf), dict):
            table[leaf] = {**table[leaf], **value}
        else:
            table[leaf] = value
    return nested


def flat(table: Mapping[str, Any], at: str = "") -> dict[str, Any]:
    """Turn nested tables into dotted keys.

    Examples
    --------
    >>> flat({"load": {"fill": 0.4}, "run.seed": 2})
    {'load.fill': 0.4, 'run.seed': 2}
    """
    dotted: dict[str, Any] = {}
    for key, value in table.items():
        dotted |= flat(value, f"{at}{key}.") if isinstance(value, Mapping) else {f"{at}{key}": value}
    return dotted


def merge(
    model: type[BaseModel], lower: Mapping[str, Any], upper: Mapping[str, Any], prefix: str = ""
) -> dict[str, Any]:
    """Merge two layers, `upper` over `lower`; a key of an either–or choice takes the place of the others.

    Raises
    ------
    ConfigError
        If `upper` holds two of a choice.
    """
    choice = cast("_Choosing", model).choice
    chosen = [key for key in choice if upper.get(key) is not None]
    if len(chosen) > 1:
        raise ConfigError(**both_given(prefix, chosen, upper))
    merged = {key: value for key, value in lower.items() if not (chosen and key in choice)}
    for key, value in upper.items():
        table = table_type(model, key)
        below = merged.get(key)
        if table is not None and isinstance(value, Mapping) and isinstance(below, Mapping):
            merged[key] = merge(table, below, value, f"{prefix}{key}.")
        elif value is None:
            merged.pop(key, None)
        else:
            merged[key] = value
    return merged


def parse_settings(settings: Iterable[str]) -> dict[str, Any]:
    """Read `KEY=VALUE` words into dotted keys; VALUE is a TOML literal, a bare word a string, the last wins.

    Examples
    --------
    >>> parse_settings(["run.window=[5, 15]", "contact.drum.tension=clipped"])
    {'run.window': [5, 15], 'contact.drum.tension': 'clipped'}

    Numbers may also be written as Python or people do: ``.5``, ``5.``, ``25 %``.
    """
    layer: dict[str, Any] = {}
    for setting in settings:
        key, equals, text = setting.partition("=")
        if not equals or not key.strip():
            raise ConfigError("--set", setting, "KEY=VALUE", hint="such as --set load.fill=0.2")
        layer[key.strip()] = _literal(text.strip())
    return layer


def read_toml(text: str, source: str | Path = "the configuration") -> dict[str, Any]:
    """Parse TOML into a layer.

    Raises
    ------
    ConfigError
        If `text` is not TOML; the message names `source`, the line and the column.
    """
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # Besides what is not TOML: integers of thousands of digits, tables nested a thousand deep.
        raise ConfigError(source, problem=f"is not valid TOML: {error}", hint=_corrected(text)) from None


def _corrected(text: str) -> str:
    """Say how to write the line at which TOML ends, where that can be guessed."""
    from tomlkit import exceptions, parse

    if text.lstrip().startswith("{"):
        return "a file of JSON has a name that ends with .json"
    try:
        parse(text)
    except exceptions.ParseError as error:
        line = text.splitlines()[error.line - 1].strip() if text.strip() else ""
        key, equals, typed = (part.strip() for part in line.partition("="))
        if not equals:
            return f"line {error.line} is {format_value(line)}, but must be KEY = VALUE or [TABLE]"
        typed = typed.partition("#")[0].strip()
        value = _typed(typed.replace(",", ".") if _DECIMAL_COMMA.fullmatch(typed) else typed)
        if not isinstance(value, str) or value.isidentifier():
            return f"write {key} = {json.dumps(value)}"
    except Exception:  # noqa: BLE001 - only a hint is lost
        return ""
    return ""


def read_json(text: str, source: str | Path = "the configuration") -> dict[str, Any]:
    """Parse a JSON object into a layer.

    Raises
    ------
    ConfigError
        If `text` is not a JSON object; the message names `source`.
    """
    try:
        layer = json.loads(text)
    except (ValueError, RecursionError) as error:
        # Besides what is not JSON: integers of thousands of digits, lists nested a thousand deep.
        raise ConfigError(source, problem=f"is not valid JSON: {error}") from None
    if not isinstance(layer, dict):
        raise ConfigError(source, layer, "a JSON object of tables")
    return layer


# Numbers that people and Python write, and TOML does not take: .5, 5., 25 %.
_NUMBER = re.compile(r"([+-]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)\s*(%?)")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+")
_WORDS = {"True": True, "False": False, "None": None}


def _literal(text: str) -> Any:
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return _typed(text)
    return parsed["value"] if len(parsed) == 1 else text


def _typed(text: str) -> Any:
    """Return what somebody means who does not write TOML; a bare word is a string."""
    number = _NUMBER.fullmatch(text)
    if number is not None:
        return float(number[1]) / (100.0 if number[2] else 1.0)
    return _WORDS.get(text, text)
