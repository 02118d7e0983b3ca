"""What the compiled core says of a configuration: what follows from it, and the greatest counts it may have."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

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
class Facts:
    """What places a case among others.

    Attributes
    ----------
    load_mass
        Mass of all bundles per meter of drum depth [kg/m].
    steps_per_collision
        Time steps in the shortest collision.
    critical_angular_velocity
        √(g/(R − r)) [rad/s], from which on a bundle stays on the rim all the way round. R is the radius of the rim, or
        of the smallest circle round a shell, about the axis; `None` without either.
    critical_share
        The drum's greatest speed over the critical one; `None` without rim and shell, or without gravity.
    froude_number
        Ω² R / g at the drum's greatest speed; `None` likewise.
    """

    load_mass: float
    steps_per_collision: float
    critical_angular_velocity: float | None
    critical_share: float | None
    froude_number: float | None

    @classmethod
    def read(cls, core_json: str) -> Self:
        """Read what the core tells of a simulation."""
        return cls(**_numbers(core_json))

    def line(self, *, changing: bool) -> str:
        """Say them in a line; where the drum's speed is changing, the numbers of the greatest one are limits."""
        limit = "up to " if changing else ""
        words = []
        if self.froude_number is not None:
            words.append(f"Froude number {limit}{self.froude_number:.3g}")
        if self.critical_share is not None:
            words.append(f"{limit}{100.0 * self.critical_share:.3g} % of the critical speed")
        words.append(f"load {float(f'{self.load_mass:.3g}'):.15g} kg per m of depth")
        return ", ".join([*words, f"{self.steps_per_collision:.3g} steps per collision"])


@dataclass(frozen=True)
class DerivedSpecies:
    """What there is of one species.

    Attributes
    ----------
    count
        Number of its bundles.
    mass
        Mass of all of them per meter of drum depth, with their water [kg/m].
    smallest, largest
        Diameters of the smallest and the largest of them [m].
    """

    count: int
    mass: float
    smallest: float
    largest: float


@dataclass(frozen=True)
class Derived(Facts):
    """What follows from a configuration; see `Config.derived`.

    Attributes
    ----------
    bundle_mass
        Mass of a bundle per meter of drum depth, on average, with its water [kg/m].
    species
        What there is of each species of ``load.species``, by name.
    time_step
        Time step [s], also where ``run.time_step`` is "auto".
    angular_velocity
        Angular velocity Ω of the drum [rad/s]; `None` where it changes.
    bundle, drum
        The contacts of two bundles, and of a bundle with the drum; of several species, those that are over first.
    """

    bundle_mass: float
    species: dict[str, DerivedSpecies]
    time_step: float
    angular_velocity: float | None
    bundle: DerivedContact
    drum: DerivedContact


def _numbers(core_json: str) -> dict[str, Any]:
    """Read numbers of the core; a mass beyond all numbers, which JSON cannot hold, is infinite."""
    values: dict[str, Any] = json.loads(core_json)
    return values | ({"load_mass": math.inf} if values["load_mass"] is None else {})


def derive(core_json: str, seed: int, names: Sequence[str]) -> Derived:
    """Return what follows from a configuration as the core reads it, with the seed and the names of its species.

    Raises
    ------
    ConfigError
        Where no simulation can have this configuration.
    """
    values = _numbers(_core.derived(core_json, seed))
    species = [DerivedSpecies(**own) for own in values["species"]]
    values["species"] = dict(zip(names, species, strict=True))
    values |= {side: DerivedContact(**values[side]) for side in ("bundle", "drum")}
    return Derived(**values)


def compose(species: list[dict[str, Any]], share_by: str, count: int = 0) -> tuple[float, float, list[int]]:
    """Return area [m²] and mass [kg/m] of a bundle, on average, and how many of `count` are of each species.

    Parameters
    ----------
    species
        The species as the core reads them.
    share_by
        What their shares are counted by: "mass", "area" or "number".
    count
        Number of all bundles.

    Raises
    ------
    ConfigError
        Where a share or a size law is not accepted.
    """
    return _core.composition(json.dumps(species), share_by, count)
