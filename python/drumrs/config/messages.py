"""One sentence for what is wrong with a configuration: its key, the value found, what would be accepted."""

import difflib
from collections.abc import Iterator, Sequence
from typing import Any, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails, PydanticCustomError

from drumrs.config.types import Limit

_LONGEST_VALUE = 60
_TABLE = "a table of keys"


def sentence(root: type[BaseModel], error: ValidationError) -> str:
    """Describe the first problem of a failed validation of `root`; a misspelt key comes before all others."""
    problems = error.errors(include_url=False)
    problem = next((p for p in problems if p["type"] == "extra_forbidden"), problems[0])
    if problem["type"] == "extra_forbidden":
        return _unknown_key(root, problem["loc"])
    if problem["type"] == _RELATION:
        at = "".join(f"{part}." for part in problem["loc"])
        return str(problem["ctx"]["text"]).replace("{at}", at)
    return _refused_value(root, problem)


_RELATION = "relation"


def relation(text: str) -> PydanticCustomError:
    """Build the error of fields that do not go together; `{at}` in `text` stands for the dotted table."""
    return PydanticCustomError(_RELATION, "{text}", {"text": text})


def show(value: object) -> str:
    """Show a value on one line, shortened where it is long."""
    try:
        text = repr(list(value) if isinstance(value, tuple) else value).replace("\n", " ")
    except (RecursionError, ValueError):
        # Nested a thousand deep, or an integer of thousands of digits.
        return f"a {type(value).__name__} too large to be shown"
    return text if len(text) <= _LONGEST_VALUE else f"{text[: _LONGEST_VALUE - 1]}…"


def table_type(model: type[BaseModel], key: str) -> type[BaseModel] | None:
    """Return the model behind `key` where the field is a table of its own."""
    field = model.model_fields.get(key)
    kind = field.annotation if field is not None else None
    return kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None


def dotted_keys(model: type[BaseModel], at: str = "") -> Iterator[str]:
    """List every key of `model` and its tables, as a user writes it."""
    for key in model.model_fields:
        yield f"{at}{key}"
        part = table_type(model, key)
        if part is not None:
            yield from dotted_keys(part, f"{at}{key}.")


def _unknown_key(root: type[BaseModel], path: Sequence[str | int]) -> str:
    annotation: Any = root
    prefix = ""
    for part in path[:-1]:
        if isinstance(part, int):
            annotation = _element(annotation, part)
            prefix = f"{prefix.removesuffix('.')}[{part}]."
        else:
            field = annotation.model_fields.get(part) if _is_table(annotation) else None
            annotation = field.annotation if field is not None else None
            prefix = f"{prefix}{part}."
    key = f"{prefix}{path[-1]}"
    sought = key[:_LONGEST_VALUE]
    siblings = [f"{prefix}{name}" for name in annotation.model_fields] if _is_table(annotation) else []
    known = list(dotted_keys(root))
    close = difflib.get_close_matches(sought, siblings, n=1, cutoff=0.8)
    close = close or [name for name in known if name.endswith(f".{path[-1]}")]
    close = close or difflib.get_close_matches(sought, known, n=1, cutoff=0.75)
    shown = key if key.isprintable() and 0 < len(key) <= _LONGEST_VALUE else show(key)
    if close:
        return f"{shown} is not a key; did you mean {close[0]}?"
    return f"{shown} is not a key; the keys there are {', '.join(siblings)}"


def _is_table(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _refused_value(root: type[BaseModel], problem: ErrorDetails) -> str:
    path = problem["loc"]
    if problem["type"] == "missing" and isinstance(path[-1], int):
        # A list that is too short: it is the list that is wrong, not the element it lacks.
        key, limit = _locate(root, path[:-1])
        return f"{key} is {show(problem['input'])}, but must be {limit}"
    key, limit = _locate(root, path)
    if problem["type"] == "missing":
        return f"{key} is missing, but must be {limit}"
    return f"{key or 'the configuration'} is {show(problem['input'])}, but must be {limit}"


def _locate(root: type[BaseModel], path: Sequence[str | int]) -> tuple[str, str]:
    """Return the dotted key and the limit's words; steps into unions carry no key and are passed over."""
    key, limit = "", _TABLE
    annotation: Any = root
    for step in path:
        if _is_table(annotation):
            field = annotation.model_fields.get(str(step))
            if field is None:
                break
            key = f"{key}.{step}" if key else str(step)
            annotation = field.annotation
            keys = ", ".join(annotation.model_fields) if _is_table(annotation) else ""
            limit = _limit(annotation, field.metadata) or (f"{_TABLE}: {keys}" if keys else _TABLE)
        elif isinstance(step, int):
            annotation = _element(annotation, step)
            key = f"{key}[{step}]"
            limit = _limit(annotation, ()) or limit
    return key, limit


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
