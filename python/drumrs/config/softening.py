"""Softer springs and the time step to match: what changes, and from what to what."""

import math
from typing import TYPE_CHECKING

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.config.root import Config


def softening(config: "Config", factor: float, name: str = "softer") -> dict[str, tuple[float, float]]:
    """Return the keys that change, each with its value before and after.

    With k / X and dt √X a contact lasts longer by √X and takes as many steps. Restitution depends on ν / √(m k)
    alone, so a damping that is given goes down by √X. A time step of 'auto' follows by itself.

    Raises
    ------
    ConfigError
        Where the factor is not a finite number of at least 1; `name` is what the sentence calls it.
    """
    if not 1.0 <= factor < math.inf:
        raise ConfigError(f"{name} is {factor}, but must be a finite number of at least 1")
    root = math.sqrt(factor)
    changes: dict[str, tuple[float, float]] = {}
    for side, law in (("bundle", config.contact.bundle), ("drum", config.contact.drum)):
        at = f"contact.{side}.normal"
        changes[f"{at}_stiffness"] = (law.normal_stiffness, law.normal_stiffness / factor)
        if law.normal_damping is not None:
            changes[f"{at}_damping"] = (law.normal_damping, law.normal_damping / root)
    step = config.run.time_step
    if not isinstance(step, str):
        changes["run.time_step"] = (step, step * root)
    return changes
