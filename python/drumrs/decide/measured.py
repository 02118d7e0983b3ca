"""What is measured on the frames and records of a run: a row for each function, with the names that it returns."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from drumrs import measures, registry
from drumrs.analysis import Mean
from drumrs.analysis.phases import mass_of
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.result import Result

Window = tuple[float, float]
Means = Mapping[str, Mean | float | None]

_DEPTHS = ("surface_speed", "middle_speed", "deep_speed")
_OF_LEDGER = ("load_knocking", "load_rubbing", "drum_knocking", "drum_rubbing")


class Measured(NamedTuple):
    """What a function measures, by name.

    Attributes
    ----------
    names
        The names.
    of
        The function.
    needs
        ``"frames"``, or what `run.record` must have; nothing where series and configuration are enough.
    has_window
        Whether it is that of a window, not of the whole run: sums that a run keeps begin at t = 0.
    """

    names: tuple[str, ...]
    of: "Callable[[Result, Window], Means]"
    needs: str = "frames"
    has_window: bool = True


def _one(name: str, of: Callable[..., Mean | None]) -> Measured:
    return Measured((name,), lambda result, window: {name: of(result.frames, window)})


def _gravity(result: "Result") -> float:
    return math.hypot(*result.config.plane_gravity)


def _mass(result: "Result") -> float:
    return mass_of(result.config, result.series)


def _diameter(result: "Result", name: str) -> float:
    """Return the diameter that all bundles have."""
    if any(one.diameter is not None or one.sizes is not None for one in result.config.load.species or ()):
        problem = "is that of a load of one size, but species of this one have sizes of their own"
        raise ConfigError(f"the target {name}", problem=problem)
    return result.config.load.diameter


def _impacts(result: "Result", window: Window) -> Means:
    return measures.impact_rates(
        result.contacts, window, _mass(result), result.config.derived.bundle.collision_time
    )


def _wear(result: "Result", _: Window) -> Means:
    turns = abs(float(result.series["drum_angle"][-1])) / math.tau
    return measures.wear_of_parts(result.wall_profile, turns)


def _split(result: "Result", _: Window) -> Means:
    duration = float(result.series["time"][-1])
    found = measures.knocking_and_rubbing(result.ledger_split, _mass(result), duration)
    return dict(zip(_OF_LEDGER, (*found["load"], *found["drum"]), strict=True))


def _overlap(result: "Result", window: Window) -> Means:
    contact = result.config.contact
    if contact.base != "linear":
        problem = "follows from the energy in linear springs, but this run has others"
        hint = "ask for max_overlap_ratio"
        raise ConfigError("the target mean_overlap_ratio", contact.base, problem=problem, hint=hint)
    stiffness, radius = contact.bundle.normal_stiffness, 0.5 * _diameter(result, "mean_overlap_ratio")
    return {"mean_overlap_ratio": measures.mean_overlap_ratio(result.series, window, stiffness, radius)}


_MEASURES = (
    Measured(
        ("toe_angle", "shoulder_angle", "center_slope", "surface_slope", "s_shape", "filling", "arm"),
        lambda result, window: measures.charge(result.frames, window),
    ),
    Measured(
        (
            *("bed_depth", "surface_velocity_ratio", "layer_thickness"),
            *("layer_to_solid_rotation", "core_velocity_ratio"),
        ),
        lambda result, window: measures.flowing_layer(result.frames, window),
    ),
    Measured(
        ("unbalance", "turning_unbalance", "eccentricity"),
        lambda result, window: measures.unbalance(
            result.frames, window, measures.disc_masses(result.config, result.frames)
        ),
    ),
    Measured(
        _DEPTHS,
        lambda result, window: dict(zip(_DEPTHS, measures.depth_profile(result.frames, window), strict=True)),
    ),
    _one("circulation", measures.circulation),
    _one("wall_slip", measures.wall_slip),
    _one("along_the_rim", measures.along_the_rim),
    _one("carried_round", measures.carried_round),
    _one("mixed_in_a_turn", measures.mixed_in_a_turn),
    Measured(
        (
            *("share_in_flight", "falls_per_turn", "mean_drop"),
            *("landing_on_drum", "head_height", "impact_toe_angle"),
        ),
        lambda result, window: measures.flight(
            result.frames, window, measures.disc_masses(result.config, result.frames), _gravity(result)
        ),
    ),
    Measured(
        (
            *("center_turning", "disc_turning", "moving_speed", "moving_spread"),
            *("axis_distance_spread", "shape_factor", "openness", "curtain"),
        ),
        lambda result, window: measures.washing(result.frames, window, _gravity(result)),
    ),
    Measured(
        (
            *("impact_rate", "impact_specific_power", "median_impact_energy"),
            *("drum_impact_rate", "drum_impact_specific_power"),
        ),
        _impacts,
        "contacts",
    ),
    Measured(("archard_wear", "finnie_wear", "wear_peak"), _wear, "wall_profile", has_window=False),
    Measured(_OF_LEDGER, _split, "ledger_split", has_window=False),
    Measured(
        ("received_spread",),
        lambda result, _: {"received_spread": measures.received_spread(result.discs)},
        "discs",
        has_window=False,
    ),
    Measured(
        ("torque_peak_factor",),
        lambda result, window: {
            "torque_peak_factor": measures.peak_factor(result.series, "drum_torque", window)
        },
        "",
    ),
    Measured(("mean_overlap_ratio",), _overlap, ""),
    Measured(
        ("size_ratio",),
        lambda result, _: {
            "size_ratio": Mean(result.config.drum.diameter / _diameter(result, "size_ratio"), 0.0)
        },
        "",
    ),
)
_BY_NAME = {name: measured for measured in _MEASURES for name in measured.names}


def names() -> tuple[str, ...]:
    """Return the names of all measures, but for those of single parts of the drum."""
    return tuple(_BY_NAME)


def measured(name: str) -> Measured | None:
    """Return how a name is measured, that of a part of the drum as well; `None` where the series tells it."""
    of_part = registry.part_and_measure(name)
    return _BY_NAME.get(name if of_part is None else of_part[1])
