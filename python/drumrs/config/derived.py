"""What the compiled core says of a configuration: what follows from it, and the greatest counts it may have."""

import json
from dataclasses import dataclass
from typing import Any

from drumrs import _core

GREATEST_COUNT, GREATEST_SPECIES, GREATEST_BAFFLES = _core.greatest_counts()


@dataclass(frozen=True)
class DerivedContact:
    """What follows for the contacts of one table, ``contact.bundle`` or ``contact.drum``.

    Attributes
    ----------
    effective_mass
        m* = m₁ m₂ / (m₁ + m₂) [kg/m]: half a bundle's mass between two bundles, a bundle's against the drum.
    normal_damping
        Damping of the normal dashpot [N s/m]; `None` with ``contact.base = "hertz"``, whose damping changes with the
        overlap.
    damping_ratio
        Damping over the critical one, 2 √(k m*); `None` likewise.
    restitution
        Coefficient of restitution of a head-on impact.
    collision_time
        Duration of a collision [s].
    """

    effective_mass: float
    normal_damping: float | None
    damping_ratio: float | None
    restitution: float
    collision_time: float


@dataclass(frozen=True)
class Derived:
    """What follows from a configuration, of equal bundles of the configured size; see `Config.derived`.

    Attributes
    ----------
    bundle_mass, load_mass
        Mass of one bundle and of all of them, per meter of drum depth [kg/m].
    time_step
        Time step [s], also where ``run.time_step`` is "auto".
    angular_velocity
        Angular velocity Ω of the drum [rad/s]; `None` where it changes.
    critical_angular_velocity
        √(g/R) [rad/s], from which on a bundle stays on the rim all the way round; `None` without a rim.
    froude_number
        Ω² R / g; `None` without a rim, a constant speed or gravity.
    bundle, drum
        The contacts of two bundles, and of a bundle with the drum.
    """

    bundle_mass: float
    load_mass: float
    time_step: float
    angular_velocity: float | None
    critical_angular_velocity: float | None
    froude_number: float | None
    bundle: DerivedContact
    drum: DerivedContact


def derive(core_json: str) -> Derived:
    """Return what follows from a configuration as the core reads it.

    Raises
    ------
    ConfigError
        Where no simulation can have this configuration.
    """
    values: dict[str, Any] = json.loads(_core.derived(core_json))
    values |= {side: DerivedContact(**values[side]) for side in ("bundle", "drum")}
    return Derived(**values)
