"""A drum of another size: how every key that has a dimension follows the lengths of the drum."""

import math
import numbers
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, get_args

from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.config.tables import Tables

Keep = Literal["groups", "bundle"]

# The powers of the factor that keys go with: where all groups are kept, and where the bundle stays what it is.
Powers = tuple[float, float]
# Gravity stays, so times go with the root of the lengths; the density stays, so a mass per meter of depth goes with the
# square, and forces too. Stiffness is a force per length, Young's modulus acts in a layer one disc thick.
_DRUM: Powers = (1.0, 1.0)
_TIME: Powers = (0.5, 0.5)
_TURNING: Powers = (-0.5, -0.5)
_BUNDLE: Powers = (1.0, 0.0)
_OF_CONTACTS: Mapping[str, Powers] = {
    "normal_stiffness": (1.0, 0.0),
    "young_modulus": (1.0, 0.0),
    "normal_damping": (1.5, 0.0),
    "adhesion": (2.0, 0.0),
}
_SIZES = ("diameter", "diameters", "top_size", "size_63", "median", "mean", "smallest", "largest")
# By table and name of the key, wherever in the table it stands.
_POWERS: Mapping[str, Mapping[str, Powers]] = {
    "drum": dict.fromkeys(
        ("diameter", "depth", "walls", "height", "base", "tip", "corner_radius", "points", "width"), _DRUM
    ),
    "rotation": {"duration": _TIME, "rpm": _TURNING, "ramp": _TURNING},
    "load": {
        **dict.fromkeys(_SIZES, _BUNDLE),
        **_OF_CONTACTS,
        "start_speed": (0.5, 0.5),
        "count": (0.0, 2.0),
        "mass": (3.0, 3.0),
    },
    "contact": _OF_CONTACTS,
    "run": {
        **dict.fromkeys(("duration", "window", "sample_every", "frame_every"), _TIME),
        **dict.fromkeys(("arc_bin", "corners"), _DRUM),
        **dict.fromkeys(("cell", "skin"), _BUNDLE),
        "time_step": (0.5, 0.0),
        "contact_floor": (3.0, 0.0),
    },
}


def scaling(config: "Tables", factor: float, keep: Keep) -> dict[str, Any]:
    """Return the keys of a drum that is larger by a factor, as a layer.

    Raises
    ------
    ConfigError
        Where the factor is not a positive finite number, or `keep` names nothing that can be kept.
    """
    if isinstance(factor, bool) or not isinstance(factor, numbers.Real) or not 0.0 < factor < math.inf:
        raise ConfigError("factor", factor, "a positive finite number")
    if keep not in get_args(Keep):
        raise ConfigError("keep", keep, "'groups' or 'bundle'")
    which = get_args(Keep).index(keep)
    values = config.model_dump(exclude_none=True)
    layer = {table: _scaled(values[table], table, "", float(factor), which) for table in _POWERS}
    program = values["rotation"].get("program")
    if program is not None:
        root = math.sqrt(factor)
        layer["rotation"]["program"] = [(time * root, rpm / root) for time, rpm in program]
    if layer["load"].get("count") is not None:
        layer["load"]["count"] = round(layer["load"]["count"])
    return layer


def _scaled(value: Any, table: str, name: str, factor: float, which: int) -> Any:
    """Return a value of a table with all that has a dimension scaled."""
    if isinstance(value, Mapping):
        scaled = {key: _scaled(own, table, key, factor, which) for key, own in value.items()}
        if value.get("law") == "normal":
            # A length, in this law alone.
            scaled["sigma"] = value["sigma"] * _power(factor, _BUNDLE[which])
        return scaled
    if isinstance(value, (list, tuple)):
        return [_scaled(own, table, name, factor, which) for own in value]
    powers = _POWERS[table].get(name)
    if powers is None or isinstance(value, (str, bool)):
        return value
    return value * _power(factor, powers[which])


def _power(factor: float, power: float) -> float:
    """Return a power that is a multiple of a half, exact where the factor and its root are powers of two."""
    root = math.sqrt(factor)
    result = math.prod([root] * round(2.0 * abs(power)))
    return 1.0 / result if power < 0.0 else result
