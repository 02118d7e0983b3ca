"""Softer springs, with the time step to match: the keys that change and their values."""

import math
import numbers
from typing import TYPE_CHECKING, Any

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from drumrs.config.contact import LinearContact, PartialContact
    from drumrs.config.tables import Tables


def softening(config: "Tables", factor: float, name: str = "softer") -> dict[str, tuple[float, float]]:
    """Return the keys that change, each with its value before and after.

    With k / X and dt √X a contact lasts longer by √X and takes as many steps. Restitution depends on ν / √(m k)
    alone, so a damping that is given goes down by √X. A time step of 'auto' follows by itself.

    Raises
    ------
    ConfigError
        Where the factor is not a finite number of at least 1; `name` is what the message calls it.
    """
    if not (isinstance(factor, numbers.Real) and 1.0 <= factor < math.inf):
        raise ConfigError(name, factor, "a finite number of at least 1")
    if config.contact.base != "linear":
        raise ConfigError("contact.base", config.contact.base, "'linear' for softer springs")
    root = math.sqrt(factor)
    changes: dict[str, tuple[float, float]] = {}
    for at, law in _laws(config):
        if law.normal_stiffness is not None:
            changes[f"{at}.normal_stiffness"] = (law.normal_stiffness, law.normal_stiffness / factor)
        if law.normal_damping is not None:
            changes[f"{at}.normal_damping"] = (law.normal_damping, law.normal_damping / root)
    step = config.run.time_step
    if not isinstance(step, str):
        changes["run.time_step"] = (step, step * root)
    return changes


def _laws(config: "Tables") -> "Iterator[tuple[str, LinearContact | PartialContact]]":
    """List the tables that hold a stiffness, each with its key."""
    yield from (("contact.bundle", config.contact.bundle), ("contact.drum", config.contact.drum))
    yield from ((f"contact.pair[{index}]", law) for index, law in enumerate(config.contact.pair or ()))
    for index, species in enumerate(config.load.species or ()):
        if species.contact is not None:
            yield f"load.species[{index}].contact", species.contact


def layer(config: "Tables", changes: dict[str, tuple[float, float]]) -> dict[str, Any]:
    """Return the changes as a layer: those of a table in a list need the whole list."""
    after: dict[str, Any] = {key: new for key, (_, new) in changes.items() if "[" not in key}
    for name, tables in (("contact.pair", config.contact.pair), ("load.species", config.load.species)):
        values = [table.model_dump(exclude_none=True) for table in tables or ()]
        for index, table in enumerate(values):
            at = f"{name}[{index}]."
            for key, (_, new) in changes.items():
                if key.startswith(at):
                    *path, leaf = key.removeprefix(at).split(".")
                    (table[path[0]] if path else table)[leaf] = new
        after |= {name: values} if values else {}
    return after
