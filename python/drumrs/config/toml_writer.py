"""A configuration as TOML in which every key carries its meaning and unit."""

import textwrap
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeGuard

from pydantic import BaseModel

if TYPE_CHECKING:
    from tomlkit.items import Item, Table
    from tomlkit.toml_document import TOMLDocument

_WIDTH = 100
_LARGE = 1e6


def to_toml(config: BaseModel, *, comments: bool) -> str:
    """Return `config` as TOML; with `comments`, each key has its meaning above it, unset ones as an example."""
    import tomlkit

    document = tomlkit.document()
    _write(document, config, comments=comments)
    return document.as_string()


def _write(into: "TOMLDocument | Table", table: BaseModel, *, comments: bool) -> None:
    import tomlkit

    lists = {key: value for key, value in table if isinstance(value, tuple) and value and _is_table(value[0])}
    values = {key: value for key, value in table if key not in lists and not _is_table(value)}
    for key, value in values.items():
        field = type(table).model_fields[key]
        for line in textwrap.wrap(field.description or "", _WIDTH) if comments else ():
            into.add(tomlkit.comment(line))
        if value is not None:
            into.add(key, toml_item(value))
        elif comments and field.examples:
            into.add(tomlkit.comment(f"{key} = {toml_item(field.examples[0]).as_string()}"))
    for key, tables in lists.items():
        array = tomlkit.aot()
        for one in tables:
            array.append(tomlkit.item({name: toml_item(value) for name, value in one if value is not None}))
        into.add(key, array)
    for key, value in table:
        if _is_table(value):
            inner = tomlkit.table()
            if comments:
                inner.comment((type(value).__doc__ or "").partition("\n")[0])
            _write(inner, value, comments=comments)
            into.add(key, inner)


def _is_table(value: Any) -> TypeGuard[BaseModel]:
    return isinstance(value, BaseModel)


def toml_item(value: Any) -> "Item":
    """Return a value of a configuration as TOML, tables inline; a float reads back as the same bits.

    Examples
    --------
    >>> [toml_item(value).as_string() for value in (9.25e7, (0.0, -9.81), "auto", True)]
    ['9.25e+7', '[0.0, -9.81]', '"auto"', 'true']
    >>> toml_item([{"species": 1, "friction": 0.3}]).as_string()
    '[{species = 1, friction = 0.3}]'
    """
    import tomlkit

    if isinstance(value, BaseModel):
        value = value.model_dump(exclude_defaults=True)
    if isinstance(value, dict):
        inline = tomlkit.inline_table()
        inline.update({key: toml_item(item) for key, item in value.items()})
        return inline
    if isinstance(value, (list, tuple)):
        array = tomlkit.array()
        array.extend(toml_item(item) for item in value)
        array.multiline(len(value) > 1 and isinstance(value[0], (BaseModel, dict)))
        return array
    if isinstance(value, float) and abs(value) >= _LARGE:
        # The shortest digits, with a power of ten.
        value = tomlkit.value(f"{Decimal(repr(value)).normalize():e}")
    item: Item = tomlkit.item(value)
    return item
