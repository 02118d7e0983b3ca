"""A configuration as TOML in which every key carries its meaning and unit."""

import json
import textwrap
from collections.abc import Iterator
from decimal import Decimal
from typing import Any

from pydantic import BaseModel

_WIDTH = 100
_LARGE = 1e6


def to_toml(config: BaseModel, *, comments: bool) -> str:
    """Write `config` as TOML; with `comments`, keys that are not set stand there commented out."""
    lines = list(_table(config, "", comments=comments))
    return "\n".join(lines).strip() + "\n"


def _table(part: BaseModel, path: str, *, comments: bool) -> Iterator[str]:
    tables = {key: value for key, value in part if isinstance(value, BaseModel)}
    if path:
        yield ""
        if comments:
            yield from _comment((type(part).__doc__ or "").partition("\n")[0])
        yield f"[{path}]"
    for key, value in part:
        if key not in tables:
            yield from _key(part, key, value, comments=comments)
    for key, value in tables.items():
        yield from _table(value, f"{path}.{key}" if path else key, comments=comments)


def _key(part: BaseModel, key: str, value: Any, *, comments: bool) -> Iterator[str]:
    field = type(part).model_fields[key]
    if comments:
        yield from _comment(field.description or "")
    if value is not None:
        yield f"{key} = {literal(value)}"
    elif comments and field.examples:
        yield f"# {key} = {literal(field.examples[0])}"


def _comment(text: str) -> list[str]:
    return [f"# {line}" for line in textwrap.wrap(text, _WIDTH)]


def literal(value: Any) -> str:
    """Write a value of a configuration as TOML; a float reads back as the same bits.

    Examples
    --------
    >>> literal(9.25e7), literal((0.0, -9.81)), literal("auto"), literal(True)
    ('9.25e+7', '[0.0, -9.81]', '"auto"', 'true')
    >>> literal({"species": 1, "friction": 0.3})
    '{ species = 1, friction = 0.3 }'
    """
    if isinstance(value, BaseModel):
        value = value.model_dump(exclude_none=True)
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {literal(item)}' for key, item in value.items())} }}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(literal(item) for item in value)}]"
    if isinstance(value, float) and abs(value) >= _LARGE:
        return str(Decimal(repr(value)).normalize()).lower() if "e" not in repr(value) else repr(value)
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value)
