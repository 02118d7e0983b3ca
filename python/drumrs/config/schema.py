"""The keys of a case file as a JSON schema, by which editors complete, explain and check them."""

from typing import Any

from pydantic import BaseModel

# Limits as pydantic writes them beside types of its own making, and as JSON Schema has them.
_LIMITS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}
_DIALECT = "https://json-schema.org/draft/2020-12/schema"
_NULL = {"type": "null"}


def editor_schema(model: type[BaseModel]) -> dict[str, Any]:
    """Return the JSON schema of a file that is laid over defaults: any key may be missing, and none is null.

    Units of values are in ``unit``, and behind their meaning in ``description``.
    """
    schema = _tidy(model.model_json_schema())
    # What is laid over the baseline need not be whole, but for the tables in lists.
    for properties in (schema, *schema["$defs"].values()):
        for field in properties["properties"].values():
            schema["$defs"].get(field.get("$ref", "").rpartition("/")[2], {}).pop("required", None)
    return {"$schema": _DIALECT, "title": "Case of drumrs", **schema}


def _tidy(part: Any) -> Any:
    """Return a part of a schema without nulls and titles, with limits as JSON Schema writes them."""
    if isinstance(part, list):
        return [_tidy(item) for item in part]
    if not isinstance(part, dict):
        return part
    tidy: dict[str, Any] = {}
    for key, value in part.items():
        if key in {"properties", "$defs"}:
            tidy[key] = {name: _tidy(inner) for name, inner in value.items()}
        elif key == "anyOf" and _NULL in value:
            choices = [choice for choice in value if choice != _NULL]
            tidy |= _tidy(choices[0]) if len(choices) == 1 else {"anyOf": _tidy(choices)}
        elif key == "minLength" and part.get("type") == "array":
            tidy["minItems"] = value
        elif key not in {"title", "default"} or (key == "default" and not isinstance(value, dict | None)):
            tidy[str(_LIMITS.get(key, key))] = _tidy(value) if key not in {"default", "examples"} else value
    return tidy
