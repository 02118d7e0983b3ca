"""Made-up results of the study: a world in which every claim of the paper holds, to be broken one claim at a time."""

from collections.abc import Callable

import polars as pl

from drumrs import baseline
from drumrs.paper.drums import BAFFLED, BARE
from drumrs.paper.scales import SCALES

DEFAULT = SCALES["default"]
SEEDS = (1, 2, 3)
_BASE = {"fill": 0.25, "size": 20.0, "friction": 0.5, "speed": 54.0, "restitution": 0.1}
_RISE = {0.4: 1.1, 0.425: 1.4, 0.45: 1.7, 0.475: 1.9}


def power(fill: float, baffles: bool) -> float:
    """Return a drum power that peaks at 44 %, lower with baffles below 50 %."""
    return 400.0 * (1.0 - ((fill - 0.44) / 0.6) ** 2) * ((0.93 if fill < 0.5 else 0.97) if baffles else 1.0)


def ratio(fill: float, baffles: bool) -> float:
    """Return N/T against fill as the paper has it."""
    if baffles:
        return 2.1 - 4.0 * max(fill - 0.6, 0.0)
    return 1.0 if fill < 0.4 else _RISE.get(fill, 2.0 - max(fill - 0.5, 0.0))


def friction_factor(friction: float) -> float:
    """Return power over its usual value, constant from 0.3 on."""
    return min(friction / 0.3, 1.0)


def measures(at: dict[str, float], baffles: bool) -> dict[str, float | None]:
    """Return the columns of a point of the world in which all claims hold."""
    fill, friction = at["fill"], at["friction"]
    circulates = friction > 0.12
    specific = power(fill, baffles) / fill / 200.0 * friction_factor(friction)
    specific *= 1.0 + 0.006 * (at["size"] - 20.0)
    specific *= (at["speed"] / 54.0) ** 2 * (1.0 - 0.1 * (at["restitution"] - 0.1))
    turned = (-0.5 if fill == 0.75 else 0.5) * (friction - 0.5)
    n_over_t = ratio(fill, baffles) + turned if circulates else 0.0
    watched = fill in {0.25, 0.5, 0.6, 0.75}
    return {
        "drum_power": power(fill, baffles) * friction_factor(friction),
        "drum_specific_power": specific,
        "dissipated_normal_specific_power": specific * n_over_t / (1.0 + n_over_t),
        "dissipated_sliding_specific_power": specific / (1.0 + n_over_t),
        "gross_work_ratio": n_over_t if friction else 400.0,
        "dissipation_ratio": 0.98 * n_over_t if friction else None,
        "work_ratio": 0.982 * n_over_t if friction else None,
        "specific_angular_momentum": (0.15 if circulates else 0.0) * (1.03 if baffles else 1.0),
        "along_the_rim": 0.7 if baffles else 0.1,
        "carried_round": ((0.6 if fill < 0.5 else 0.2) if baffles else 0.01) * (fill < 0.5)
        + 0.2 * (fill > 0.5),
        "mixed_in_a_turn": (0.4 if baffles else 0.6) if fill < 0.5 else 0.1,
        "deep_speed": 0.03 if watched else None,
        "surface_speed": 0.3 if watched else None,
    }


def points() -> list[tuple[dict[str, float], bool]]:
    """Return every point of the default study as parameters, and whether there are baffles."""
    found = [({**_BASE, "fill": fill}, False) for fill in DEFAULT.fills]
    found += [({**_BASE, "fill": fill}, True) for fill in DEFAULT.fills_with_baffles]
    found += [
        ({**_BASE, "fill": fill, "friction": x}, False)
        for fill in (0.25, 0.5, 0.75)
        for x in DEFAULT.frictions
    ]
    for baffles in (False, True):
        found += [({**_BASE, "fill": 0.4, "size": x}, baffles) for x in DEFAULT.sizes]
        found += [({**_BASE, "speed": x}, baffles) for x in DEFAULT.speeds]
        found += [({**_BASE, "restitution": x}, baffles) for x in DEFAULT.restitutions]
    unique = {(*at.values(), baffles): (at, baffles) for at, baffles in found}
    return list(unique.values())


def _columns(baffles: bool) -> dict[str, object]:
    """Return what a table says of the drum and of contacts, beside what is varied."""
    config = (BAFFLED if baffles else BARE).config()
    kept = config.drum.baffles
    return {
        **{f"drum.baffles.{key}": getattr(kept, key) for key in ("count", "shape", "height", "base", "tip")},
        "contact.bundle.normal_stiffness": baseline().contact.bundle.normal_stiffness,
    }


def world(
    noise: float = 0.004,
    seeds: tuple[int, ...] = SEEDS,
    of: Callable[..., dict[str, float | None]] = measures,
) -> pl.DataFrame:
    """Return the table of a world; seeds scatter by `noise`, relatively, and their blocks know it."""
    rows = []
    for at, baffles in points():
        for seed in seeds:
            row = {
                "load.fill": at["fill"],
                "size_ratio": at["size"],
                "contact.bundle.friction": at["friction"],
                "rotation.rpm": at["speed"],
                "contact.bundle.restitution": at["restitution"],
                **_columns(baffles),
                "seed": seed,
                "window_start": 20.0,
                "window_end": 30.0,
                "drifting": False,
            }
            for name, value in of(at, baffles).items():
                scatter = noise * (seed - 2.0) * (len(seeds) > 1)
                row[name] = None if value is None else value * (1.0 + scatter)
                row[f"{name}_error"] = None if value is None else abs(value) * noise
            rows.append(row)
    return pl.DataFrame(rows, infer_schema_length=None)
