"""What is measured on the frames and records of a run: a row for each function, with the names that it returns."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from drumrs import measures, registry
from drumrs.analysis import Mean
from drumrs.analysis.phases import mass_of
from drumrs.decide import chosen
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.result import Result

Window = tuple[float, float]
Means = Mapping[str, Mean | float | None]
# What an argument of a measure may be.
Value = str | float

_DEPTHS = ("surface_speed", "middle_speed", "deep_speed")
_OF_LEDGER = ("load_knocking", "load_rubbing", "drum_knocking", "drum_rubbing")


class Argument(NamedTuple):
    """An argument of a measure.

    Attributes
    ----------
    name
        Its name.
    example
        A value that it may have, of its kind: a text or a positive number.
    default
        Its value where none is given; `None` where one must be given.
    """

    name: str
    example: Value
    default: Value | None = None


class Measured(NamedTuple):
    """What a function measures, by name.

    Attributes
    ----------
    names
        The names.
    of
        The function; it has the arguments by name.
    needs
        ``"frames"``, ``"run.zone"``, or what `run.record` must have; nothing where series and configuration are enough.
    since
        Where what a run adds up begins; empty where it is that of any window.
    arguments
        The arguments that a target has to give.
    check
        Refuses arguments that do not go with a configuration.
    """

    names: tuple[str, ...]
    of: "Callable[..., Means]"
    needs: str = "frames"
    since: str = ""
    arguments: tuple[Argument, ...] = ()
    check: "Callable[..., None] | None" = None

    def bind(self, called: str, given: Sequence[Value], named: Mapping[str, Value]) -> dict[str, Value]:
        """Return all arguments by name, from those that a target gives in their order and by name.

        Raises
        ------
        ConfigError
            Where one is missing, there is one too many, or a number is none.
        """
        known = [one.name for one in self.arguments]
        values = {**dict(zip(known, given, strict=False)), **named}
        wrong = [name for name in named if name not in known or name in known[: len(given)]]
        if wrong or len(given) > len(known):
            may = f"may have {' and '.join(known)} only" if known else "takes no arguments"
            more = f"the argument {wrong[0]}" if wrong else f"{len(given)} arguments"
            raise ConfigError(called, problem=f"has {more}, but {may}, each once")
        return {one.name: _argument(called, one, values.get(one.name, one.default)) for one in self.arguments}


def _argument(called: str, one: Argument, value: Value | None) -> Value:
    if value is None:
        raise ConfigError(
            called,
            problem=f"lacks {one.name}",
            hint=f"write {called.rsplit(maxsplit=1)[-1]}({one.name}={one.example!r})",
        )
    if isinstance(one.example, str):
        return str(value)
    if isinstance(value, str) or not 0.0 < value < math.inf:
        raise ConfigError(f"{one.name} of {called}", value, "a positive number")
    return float(value)


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


def _zone(result: "Result", window: Window, zone: str, time: float = 60.0) -> Means:
    return chosen.zone(result.zone_visits, zone, time, window[1] - window[0])


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
        ("lacey_index",),
        lambda result, window, by, turns: {
            "lacey_index": chosen.lacey_index(result.frames, window, by, turns)
        },
        arguments=(Argument("by", "side"), Argument("turns", 1.0, 1.0)),
        check=chosen.check_coloring,
    ),
    Measured(
        ("zone_residence", "zone_cycle", "zone_share"),
        _zone,
        "run.zone",
        since="the start of run.window",
        arguments=(Argument("zone", "spray"),),
        check=chosen.check_zone,
    ),
    Measured(
        ("zone_spread",),
        _zone,
        "run.zone",
        since="the start of run.window",
        arguments=(Argument("zone", "spray"), Argument("time", 60.0, 60.0)),
        check=chosen.check_zone,
    ),
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
    Measured(("archard_wear", "finnie_wear", "wear_peak"), _wear, "wall_profile", since="t = 0"),
    Measured(_OF_LEDGER, _split, "ledger_split", since="t = 0"),
    Measured(
        ("received_spread",),
        lambda result, _: {"received_spread": measures.received_spread(result.discs)},
        "discs",
        since="t = 0",
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
