"""What the page offers to change: meaning, unit and limits from the schema of a case, and how far a slider goes."""

import math
from functools import cache
from typing import Any

from drumrs.config import Config
from drumrs.config.schema import editor_schema

SPEED = "rotation.rpm"
# How far sliders go; whatever lies beyond is a case file's.
_MOST_FILL, _LEAST_FILL = 0.6, 0.02
_MOST_FRICTION = 1.5
_MOST_HEIGHT = 0.45  # of the radius
_LEAST_RPM = 30.0
_STEPS = 100


def controls(config: Config, speed: float) -> list[dict[str, Any]]:
    """Return the sliders of a case, ready for JSON: those keys of the four that it has.

    Parameters
    ----------
    config
        The case.
    speed
        The drum's present speed [rpm], in whose place no key stands where the drum turns by a program.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.studio.controls import controls
    >>> [(each["label"], each["value"], each["unit"]) for each in controls(drumrs.baseline(), 54.0)]
    [('Speed', 54.0, 'rpm'), ('Fill', 0.25, '1'), ('Friction', 0.5, '1')]
    """
    radius = config.drum.area_diameter / 2.0
    # Twice the speed at which a bundle at the rim would be held there by its weight.
    fastest = max(2.0 * math.sqrt(9.81 / radius) * 30.0 / math.pi, 1.2 * abs(speed), _LEAST_RPM)
    fastest = _round_up(fastest)
    key, amount, one = config.amount
    most = max(_MOST_FILL / config.fill_of(1) * one, amount)
    found = [
        _slider(SPEED, "Speed", speed, (-fastest, fastest), restarts=False),
        _slider(key, _AMOUNTS[key], amount, (max(_LEAST_FILL / _MOST_FILL * most, one), most)),
    ]
    if not any(own.contact and own.contact.friction is not None for own in config.load.species or ()):
        # Species that have friction of their own would not feel another one of all.
        friction = config.contact.bundle.friction
        found.append(_slider("contact.bundle.friction", "Friction", friction, (0.0, _MOST_FRICTION)))
    if config.drum.baffles.count and config.drum.baffles.shape != "polygon":
        height = config.drum.baffles.height
        found.append(_slider("drum.baffles.height", "Baffle height", height, (0.0, _MOST_HEIGHT * radius)))
    if config.drum.liner.rail.count:
        height = config.drum.liner.rail.height
        found.append(_slider("drum.liner.rail.height", "Rail height", height, (0.0, _MOST_HEIGHT * radius)))
    return found


_AMOUNTS = {
    "load.fill": "Fill",
    "load.bulk_fill": "Bulk fill",
    "load.count": "Number of bundles",
    "load.mass": "Mass of the load",
}


def _slider(
    key: str, label: str, value: float, ends: tuple[float, float], *, restarts: bool = True
) -> dict[str, Any]:
    about = _field(key)
    step = 10.0 ** math.floor(math.log10((ends[1] - ends[0]) / _STEPS))
    if about.get("type") == "integer":
        step = max(step, 1.0)
    least = max(ends[0], about.get("minimum", -math.inf))
    if "exclusiveMinimum" in about:
        least = max(least, about["exclusiveMinimum"] + step)
    most = min(ends[1], about.get("maximum", math.inf), about.get("exclusiveMaximum", math.inf))
    # On a grid of the step, so that the values that sliders give are short.
    least, most = math.floor(least / step + 1e-9) * step, math.ceil(most / step - 1e-9) * step
    if "exclusiveMinimum" in about:
        least = max(least, step)
    return {
        "key": key,
        "label": label,
        "meaning": about["description"],
        "unit": about.get("unit", ""),
        "value": value,
        "min": min(_short(least), value),
        "max": max(_short(most), value),
        "step": _short(step),
        "restarts": restarts,
    }


def _field(key: str) -> dict[str, Any]:
    """Return what the schema says of a dotted key."""
    schema = _schema()
    table: dict[str, Any] = schema
    for name in key.split("."):
        field: dict[str, Any] = table["properties"][name]
        table = schema["$defs"].get(field.get("$ref", "").rpartition("/")[2], {})
    return field


@cache
def _schema() -> dict[str, Any]:
    return editor_schema(Config)


def _short(value: float) -> float:
    return float(f"{value:.9g}")


def _round_up(value: float) -> float:
    unit = 10.0 ** math.floor(math.log10(value))
    return math.ceil(value / unit) * unit
