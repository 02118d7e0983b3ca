"""`ConfigTable`: what every table of a configuration has in common; `key`: a key with its meaning and unit."""

from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from drumrs.config.messages import both_given, conflict, refusal
from drumrs.errors import ConfigError, format_value

if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass
    from pydantic.config import JsonDict
else:
    # The same class, by a public way.
    ModelMetaclass = type(BaseModel)


class _RaisesConfigError(ModelMetaclass):
    """Make a constructor raise `ConfigError`; validation of nested tables does not pass here, so paths stay whole."""

    def __call__(cls: type[Any], *args: Any, **values: Any) -> Any:  # noqa: N805 - a metaclass's self is a class
        if args:
            raise TypeError(
                f"{cls.__name__} takes keys by name; drumrs.baseline().replace({{...}}) takes a dict"
            )
        try:
            return ModelMetaclass.__call__(cls, **values)
        except ValidationError as error:
            raise refusal(cls, error) from None


def key(default: Any, meaning: str, unit: str = "", example: Any = None) -> Any:
    """Describe a key; `example` is what the documented TOML shows for a key that is not set.

    The unit is among the extras of the field's JSON schema, and behind the meaning wherever that is printed; a word
    or a count has none, a plain number the unit "1".
    """
    examples = None if example is None else [example]
    shown = f"{meaning} [{unit}]." if unit not in {"", "1"} else f"{meaning}."
    extra: JsonDict | None = {"unit": unit} if unit else None
    return Field(default=default, description=shown, examples=examples, json_schema_extra=extra)


def _say_choice(schema: dict[str, Any], table: type[Any]) -> None:
    """Say in a JSON schema that no two keys of a choice go together."""
    if table.choice:
        schema["allOf"] = [{"not": {"required": list(pair)}} for pair in combinations(table.choice, 2)]


class ConfigTable(BaseModel, metaclass=_RaisesConfigError):
    """A frozen table of keys that refuses unknown ones."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", validate_default=True, json_schema_extra=_say_choice
    )

    # Keys of which a complete table holds exactly one.
    choice: ClassVar[tuple[str, ...]] = ()

    def __setattr__(self, key: str, value: Any) -> None:
        """Refuse to change a key, and say how to get a copy with another value."""
        raise ConfigError(
            key,
            value,
            problem=f"cannot be set to {format_value(value)}: a configuration does not change",
            hint=f'config.replace({{"…{key}": {format_value(value)}}}) returns a copy with its dotted key changed',
        )

    @model_validator(mode="after")
    def _has_one_of_its_choice(self) -> Self:
        given = [key for key in self.choice if getattr(self, key) is not None]
        if len(given) > 1:
            raise conflict(**both_given("{at}", given, {key: getattr(self, key) for key in given}))
        if self.choice and not given:
            first, *others = (f"{{at}}{key}" for key in self.choice)
            limit = f"given, or {' or '.join(others)} instead"
            raise conflict(first, limit=limit, problem=f"is missing, but must be {limit}")
        return self

    @classmethod
    def model_validate(cls, obj: Any, **options: Any) -> Self:
        """Validate `obj` as pydantic does, but raise `ConfigError`."""
        try:
            return super().model_validate(obj, **options)
        except ValidationError as error:
            raise refusal(cls, error) from None
