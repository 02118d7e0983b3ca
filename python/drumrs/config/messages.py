"""From what pydantic refuses to a `ConfigError`: the key, the value found, what would be accepted."""

import difflib
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails, PydanticCustomError

from drumrs.config.types import Limit
from drumrs.errors import ConfigError, format_value

_LONGEST_KEY = 60
_TABLE = "a table of keys"
_CONFLICT = "conflict"
# The unit of a key that names none itself.
_ITS_UNIT = "the unit that drumrs config gives"


def refusal(model: type[BaseModel], error: ValidationError) -> ConfigError:
    """Return the first problem of a failed validation of `model`; a misspelled key comes before all others."""
    problems = error.errors(include_url=False)
    problem = next((p for p in problems if p["type"] == "extra_forbidden"), problems[0])
    if problem["type"] == "extra_forbidden":
        return _unknown_key(model, problem["loc"], problem["input"])
    if problem["type"] == _CONFLICT:
        table = ""
        for step in problem["loc"]:
            table = f"{table.removesuffix('.')}[{step}]." if isinstance(step, int) else f"{table}{step}."
        key, value, *texts = problem["ctx"]["fields"]
        limit, hint, said = (text.replace("{at}", table) for text in texts)
        return ConfigError(key.replace("{at}", table), value, limit, hint=hint, problem=said)
    return _refused_value(model, problem)


def conflict(
    key: str, value: Any = None, limit: str = "", *, hint: str = "", problem: str = ""
) -> PydanticCustomError:
    """Build the error of keys that do not go together, with the fields of a `ConfigError`.

    In each text ``{at}`` stands for the dotted name of the table that is validated, with a dot at its end.
    """
    fields = (key, value, limit, hint, problem)
    return PydanticCustomError(_CONFLICT, "keys that do not go together", {"fields": fields})


def both_given(table: str, keys: Sequence[str], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of the error that two keys, of which only one may be, are given in one layer."""
    first, second = (f"{table}{key}" for key in keys[:2])
    one, other = (format_value(values[key]) for key in keys[:2])
    return {
        "key": first,
        "value": values[keys[0]],
        "limit": f"left out where {second} is given",
        "problem": f"and {second} are both given ({one} and {other}), but only one of them may be",
    }


def table_type(model: type[BaseModel], key: str) -> type[BaseModel] | None:
    """Return the class of the table that a key of `model` holds; `None` where it holds a value."""
    field = model.model_fields.get(key)
    kind = field.annotation if field is not None else None
    return kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None


def dotted_keys(model: type[BaseModel], table: str = "") -> Iterator[str]:
    """List every key of `model` and its tables, as a user writes it."""
    for key in model.model_fields:
        yield f"{table}{key}"
        kind = table_type(model, key)
        if kind is not None:
            yield from dotted_keys(kind, f"{table}{key}.")


def _unknown_key(model: type[BaseModel], path: Sequence[str | int], value: Any) -> ConfigError:
    annotation: Any = model
    table = ""
    for step in path[:-1]:
        if isinstance(step, int):
            annotation = _element(annotation, step)
            table = f"{table.removesuffix('.')}[{step}]."
        else:
            field = annotation.model_fields.get(step) if _is_table(annotation) else None
            annotation = _present(field.annotation) if field is not None else None
            table = f"{table}{step}."
    key = f"{table}{path[-1]}"
    siblings = [f"{table}{name}" for name in annotation.model_fields] if _is_table(annotation) else []
    meant = _closest(key[:_LONGEST_KEY], siblings, list(dotted_keys(model)))
    shown = key if key.isprintable() and 0 < len(key) <= _LONGEST_KEY else format_value(key)
    hint = f"did you mean {meant}?" if meant else f"the keys there are {', '.join(siblings)}"
    return ConfigError(shown, value, hint=hint, problem="is not a key")


def _closest(key: str, siblings: Sequence[str], known: Sequence[str]) -> str | None:
    """Return the key that is most likely meant: one of the same table, one of the same last word, one spelled alike."""
    close = difflib.get_close_matches(key, siblings, n=1, cutoff=0.8)
    close = close or [name for name in known if name.rpartition(".")[2] == key.rpartition(".")[2]]
    close = close or difflib.get_close_matches(key, known, n=1, cutoff=0.75)
    return close[0] if close else None


def _is_table(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _present(annotation: Any) -> Any:
    """Return the table that an annotation may also leave out; any other annotation as it is."""
    choices = () if get_origin(annotation) is tuple else get_args(annotation)
    return next((choice for choice in choices if _is_table(choice)), annotation)


def _refused_value(model: type[BaseModel], problem: ErrorDetails) -> ConfigError:
    path, value = problem["loc"], problem["input"]
    is_missing = problem["type"] == "missing"
    if is_missing and isinstance(path[-1], int):
        # A list that is too short: it is the list that is wrong, not the element it lacks.
        path, is_missing = path[:-1], False
    key, limit, annotation, unit = _locate(model, path)
    if is_missing:
        return ConfigError(key, None, limit, problem=f"is missing, but must be {limit}")
    hint = _numbers_in(value, annotation, unit) if isinstance(value, str) else ""
    return ConfigError(key or "the configuration", value, limit, hint=hint)


def _numbers_in(text: str, annotation: Any, unit: str) -> str:
    """Say how to write what was typed as text where a number, or a list of them, is needed."""
    pair = _SEPARATED.fullmatch(text.strip())
    if _element(annotation, 0) is not None:
        return f"write [{pair[1]}, {pair[2]}]" if pair else ""
    if not _holds(annotation, (int, float)):
        return ""
    if pair:
        return f"write {pair[1]}{'' if _holds(annotation, (int,)) else '.'}{pair[2]}"
    with_unit = _WITH_UNIT.fullmatch(text.strip())
    return f"write a number alone, without {with_unit[2]!r}, in {unit}" if with_unit else ""


# A number with a unit, and two numbers with a comma or so between them.
_NUMBER = r"(-?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
_WITH_UNIT = re.compile(rf"{_NUMBER}\s*([^\W\d]\S*|°)")
_SEPARATED = re.compile(rf"{_NUMBER}\s*[,;:]\s*{_NUMBER}")


def _holds(annotation: Any, kinds: tuple[type, ...]) -> bool:
    """Return whether a value of the annotation may be of one of some plain types."""
    return annotation in kinds or any(_holds(argument, kinds) for argument in get_args(annotation))


def _locate(model: type[BaseModel], path: Sequence[str | int]) -> tuple[str, str, Any, str]:
    """Return the dotted key, the limit's words, type and unit; steps into unions carry no key and are passed over."""
    key, limit, unit = "", _TABLE, _ITS_UNIT
    annotation: Any = model
    for step in path:
        if _is_table(annotation):
            field = annotation.model_fields.get(str(step))
            if field is None:
                break
            key = f"{key}.{step}" if key else str(step)
            annotation = _present(field.annotation)
            extra = field.json_schema_extra
            unit = str(extra.get("unit", _ITS_UNIT)) if isinstance(extra, dict) else _ITS_UNIT
            keys = ", ".join(annotation.model_fields) if _is_table(annotation) else ""
            limit = _limit(annotation, field.metadata) or (f"{_TABLE}: {keys}" if keys else _TABLE)
        elif isinstance(step, int):
            annotation = _element(annotation, step)
            key = f"{key}[{step}]"
            limit = _limit(annotation, ()) or limit
    return key, limit, annotation, unit


def _limit(annotation: Any, metadata: Sequence[Any]) -> str | None:
    """Find the outermost `Limit` of an annotation."""
    for item in (*metadata, *getattr(annotation, "__metadata__", ())):
        if isinstance(item, Limit):
            return item.text
    inner = (_limit(argument, ()) for argument in get_args(annotation))
    return next((text for text in inner if text is not None), None)


def _element(annotation: Any, index: int) -> Any:
    """Return the annotation of one element of the tuple that `annotation` holds, however wrapped."""
    if get_origin(annotation) is tuple:
        elements = get_args(annotation)
        return elements[0] if elements[-1] is Ellipsis else elements[min(index, len(elements) - 1)]
    wrapped = (_element(argument, index) for argument in get_args(annotation))
    return next((element for element in wrapped if element is not None), None)
