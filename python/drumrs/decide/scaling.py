"""What another size changes: the dimensionless groups of two configurations, and the laws that are known."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drumrs.config import Config

# Two values that differ by less are the same number, rounded.
_SAME = 1e-9


@dataclass(frozen=True)
class Group:
    """A dimensionless group before and after.

    Attributes
    ----------
    name
        What it is.
    symbol
        Its formula.
    before, after
        Its values; not a number where the drum has none, as the Froude number of a drum without gravity.
    """

    name: str
    symbol: str
    before: float
    after: float

    @property
    def is_kept(self) -> bool:
        """Whether it is the same before and after."""
        if math.isnan(self.before) or math.isnan(self.after):
            return math.isnan(self.before) and math.isnan(self.after)
        return math.isclose(self.before, self.after, rel_tol=_SAME, abs_tol=0.0)


def _of_weight(config: "Config", force: float) -> float:
    """Return a force over the weight of a bundle."""
    weight = config.derived.bundle_mass * math.hypot(*config.plane_gravity)
    return force / weight if weight else math.nan


def _stiffness(config: "Config") -> float:
    if config.contact.base == "hertz":
        return _of_weight(config, (config.contact.bundle.young_modulus or math.nan) * _diameter(config))
    return _of_weight(config, config.contact.bundle.normal_stiffness * _diameter(config))


def _diameter(config: "Config") -> float:
    """Return the diameter of a bundle of mean area."""
    return config.drum.area_diameter * math.sqrt(config.fill / config.bundle_count)


def _known(value: float | None) -> float:
    return math.nan if value is None else value


def _turns(config: "Config") -> float:
    """Return the turns of the drum in the run, to or fro, where it turns at one speed."""
    speed = config.derived.angular_velocity
    return math.nan if speed is None else abs(speed) * config.run.duration / (2.0 * math.pi)


# By name: formula, value.
_GROUPS: Mapping[str, tuple[str, Callable[["Config"], float]]] = MappingProxyType(
    {
        "Froude number": ("Ω² R/g", lambda config: _known(config.derived.froude_number)),
        "share of the critical speed": (
            "Ω/√(g/(R − r))",
            lambda config: _known(config.derived.critical_share),
        ),
        "fill": ("Σ d²/D²", lambda config: config.fill),
        "number of bundles": ("N", lambda config: float(config.bundle_count)),
        "size ratio": ("D/d", lambda config: config.drum.area_diameter / _diameter(config)),
        "baffle height": (
            "h/D",
            lambda config: (
                config.drum.baffles.height / config.drum.area_diameter
                if config.drum.baffles.count
                else math.nan
            ),
        ),
        "rail height": (
            "h/D",
            lambda config: (
                config.drum.liner.rail.height / config.drum.area_diameter
                if config.drum.liner.rail.count
                else math.nan
            ),
        ),
        "friction among bundles": ("μ", lambda config: config.contact.bundle.friction),
        "friction at the drum": ("μ", lambda config: config.contact.drum.friction),
        "rolling friction": ("μ_r", lambda config: config.contact.bundle.rolling_friction),
        "restitution among bundles": ("e", lambda config: config.derived.bundle.restitution),
        "restitution at the drum": ("e", lambda config: config.derived.drum.restitution),
        "adhesion over weight": (
            "F_a/(m g)",
            lambda config: _of_weight(config, config.contact.bundle.adhesion),
        ),
        "stiffness": ("k d/(m g)", _stiffness),
        "stiffness under the whole drum": (
            "k d²/(m g D)",
            lambda config: _stiffness(config) * _diameter(config) / config.drum.area_diameter,
        ),
        "steps per collision": ("t_c/h", lambda config: config.derived.steps_per_collision),
        "turns": ("Ω t/2π", _turns),
    }
)


def groups(before: "Config", after: "Config") -> tuple[Group, ...]:
    """Return the dimensionless groups of two configurations, but for those that neither has.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.decide import groups
    >>> small = drumrs.baseline()
    >>> [group.name for group in groups(small, small.scaled(4.0)) if not group.is_kept]
    []
    >>> [group.name for group in groups(small, small.scaled(4.0, "bundle")) if not group.is_kept]
    ['share of the critical speed', 'number of bundles', 'size ratio', 'stiffness under the whole drum']
    """
    found = (Group(name, symbol, of(before), of(after)) for name, (symbol, of) in _GROUPS.items())
    return tuple(group for group in found if not (math.isnan(group.before) and math.isnan(group.after)))


@dataclass(frozen=True)
class Law:
    """How a quantity goes with the size of the drum, at the same Froude number and fill.

    Attributes
    ----------
    name
        What it is of.
    power
        The power of the drum's diameter that it goes with.
    holds
        Where it holds.
    """

    name: str
    power: float
    holds: str


_SIMILAR = "by similarity, where all groups are kept"
# Per meter of depth. Bond's rule is of three-dimensional mills: specific power ∝ D^0.3.
LAWS = (
    Law("times", 0.5, _SIMILAR),
    Law("velocities", 0.5, _SIMILAR),
    Law("power", 2.5, _SIMILAR),
    Law("specific power", 0.5, _SIMILAR),
    Law("work per mass in a turn", 1.0, _SIMILAR),
    Law("energy of a collision", 3.0, _SIMILAR),
    Law("energy of a collision, per mass", 1.0, _SIMILAR),
    Law("pressure in the load", 1.0, _SIMILAR),
    Law("depth of wear in a turn", 2.0, _SIMILAR),
    Law(
        "specific power of tumbling mills",
        0.3,
        "Bond's rule, in three dimensions at the same share of critical",
    ),
)


@dataclass(frozen=True)
class SpeedRule:
    """A rule by which machines of two sizes are run alike, and the speed that it asks for.

    Attributes
    ----------
    name
        What is the same.
    rpm
        Greatest speed of the drum after scaling by it [rpm].
    """

    name: str
    rpm: float


def speed_rules(before: "Config", after: "Config") -> tuple[SpeedRule, ...]:
    """Return the speeds that the usual rules ask of a drum of another size.

    Same Froude number Ω² R/g; same share of the critical speed; same speed of the rim; same Fr √(D/d), which decides
    between modes of a bed (H. Henein et al., Metall. Trans. B 14 (1983) 191).

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.decide import speed_rules
    >>> small = drumrs.baseline()
    >>> for rule in speed_rules(small, small.scaled(4.0, "bundle")):
    ...     print(f"{rule.name}: {rule.rpm:.1f} rpm")
    same Froude number: 27.0 rpm
    same share of the critical speed: 26.5 rpm
    same speed of the rim: 13.5 rpm
    same Fr √(D/d): 19.1 rpm
    """
    speed = max(map(abs, before.rotation.speeds))
    size = after.drum.area_diameter / before.drum.area_diameter
    ratio = size * _diameter(before) / _diameter(after)
    rules = [SpeedRule("same Froude number", speed / math.sqrt(size))]
    one, other = (config.derived.critical_angular_velocity for config in (before, after))
    if one and other:
        rules.append(SpeedRule("same share of the critical speed", speed * other / one))
    rules.append(SpeedRule("same speed of the rim", speed / size))
    # Fr ∝ Ω² D, so Ω² D √(D/d) stays.
    rules.append(SpeedRule("same Fr √(D/d)", speed / math.sqrt(size * math.sqrt(ratio))))
    return tuple(rules)
