"""A ball mill after Cleary: what friction does to its power; toe, shoulder and arm beside Morrell's C-model."""

import math
from typing import TYPE_CHECKING

from drumrs.analysis import Estimate, mean_of
from drumrs.config import Config, baseline
from drumrs.measures import morrell
from drumrs.measures.frame_window import with_errors
from drumrs.measures.toe import toe_and_shoulder
from drumrs.validation.cases import BED, GRAVITY, Scale, contacts, stiffness, times, turning, with_seeds
from drumrs.validation.check import NOTHING, Check
from drumrs.validation.drum import PublishedDrum
from drumrs.validation.results import Results, check_of_overlap

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from drumrs.analysis import Mean
    from drumrs.measures.frame_window import FrameWindow

_DIAMETER, _BALL, _DENSITY, _RESTITUTION = 5.0, 0.125, 4000.0, 0.3
_LIFTERS = {"count": 16, "shape": "trapezoid", "height": 0.125, "base": 0.25, "tip": 0.125}
# Speeds over the critical one, √(g/R), and coefficients of friction, of the trend.
_SPEEDS, _FRICTIONS = (0.6, 0.8, 0.9, 1.1, 1.2), (0.2, 0.5, 0.8)
# Fillings and speeds that are compared with the C-model.
_FILLINGS, _MODEL_SPEEDS = (0.2, 0.3, 0.4), (0.6, 0.72, 0.8)
_FILLING, _FRICTION, _HALVING = 0.3, 0.5, 0.05
# Where the shoulder is looked at, and the stiffness halved.
_SPEED = 0.8
_WINDOW = (1.5, 3.5)  # turns
# Frames in a turn: no multiple of the lifters, so that they pass every place alike.
_FRAMES = 61
_DEGREES = 180.0 / math.pi


def point(
    scale: Scale, speed: float = _SPEED, filling: float = _FILLING, friction: float = _FRICTION
) -> Config:
    """Return the mill as a configuration.

    Parameters
    ----------
    scale
        Size of the study.
    speed
        Speed over the critical one, √(g/R).
    filling
        Share of the mill's cross-section that the charge fills at rest.
    friction
        Coefficient of friction, among balls and with the mill.

    Examples
    --------
    >>> from drumrs.validation import Scale, mill
    >>> config = mill.point(Scale(), speed=0.72)
    >>> config.bundle_count, round(config.derived.froude_number, 4)
    (403, 0.5184)
    """
    radius = _DIAMETER / 2.0
    start, end = (scale.duration * turns for turns in _WINDOW)
    return baseline().replace(
        {
            "drum": {"diameter": _DIAMETER, "baffles": _LIFTERS},
            "load": {"diameter": _BALL / scale.fineness, "density": _DENSITY, "fill": BED * filling},
            **contacts(stiffness(_DENSITY, radius, fall=radius), friction, _RESTITUTION),
            **turning(speed * math.sqrt(GRAVITY / radius) * 30.0 / math.pi, (start, end), _FRAMES),
        }
    )


def measures(config: Config, seen: "FrameWindow") -> "Mapping[str, Mean]":
    """Return what frames tell of the charge, by name of the registry."""

    def of(chosen: slice) -> dict[str, float]:
        found = toe_and_shoulder(seen.piece(chosen), config.load.diameter, config.drum.diameter / 2.0)
        return {"toe_angle": found.toe, "shoulder_angle": found.shoulder}

    return with_errors(of, seen.times)


def _cases(scale: Scale) -> list[Config]:
    trend = [point(scale, speed, friction=friction) for speed in _SPEEDS for friction in _FRICTIONS]
    model = [point(scale, speed, filling) for speed in _MODEL_SPEEDS for filling in _FILLINGS]
    return with_seeds([*trend, *model, point(scale).softer(2.0)], scale.seeds)


def _checks(results: Results) -> list[Check]:
    plain = point(results.scale)
    soft = results.estimate(plain.softer(2.0), _POWER) / results.estimate(plain, _POWER)
    shoulder = _change(results, _SPEED, "shoulder_angle")
    return [
        *(_of_friction(results, speed) for speed in _SPEEDS),
        Check(
            f"shoulder at {100.0 * _SPEED:g} % of critical, {_STEP}",
            "higher",
            times(shoulder, _DEGREES),
            low=0.0,
            unit="°",
        ),
        *(check for filling in _FILLINGS for check in _beside_the_model(results, filling)),
        Check(
            "power at half the stiffness, over that at all of it",
            NOTHING,
            soft,
            1.0 - _HALVING,
            1.0 + _HALVING,
        ),
        check_of_overlap(results, plain),
    ]


_POWER = "drum_specific_power"
_STEP = f"from friction {_FRICTIONS[0]:g} to {_FRICTIONS[-1]:g}"


def _change(results: Results, speed: float, column: str) -> Estimate:
    """Return what the step from the least friction to the greatest changes."""
    least, most = (
        point(results.scale, speed, friction=friction) for friction in (_FRICTIONS[0], _FRICTIONS[-1])
    )
    return results.estimate(most, column) - results.estimate(least, column)


def _of_friction(results: Results, speed: float) -> Check:
    change = _change(results, speed, _POWER) / results.estimate(point(results.scale, speed), _POWER)
    quantity = f"power at {100.0 * speed:g} % of critical, {_STEP}"
    if speed < 1.0:
        return Check(quantity, "more", times(change, 100.0), low=0.0, unit="%")
    return Check(quantity, "less", times(change, 100.0), high=0.0, unit="%")


def arm(results: Results, config: Config) -> Estimate:
    """Return the power over M g R Ω: how far the charge's weight stands from the vertical, over the radius."""
    derived = config.derived
    scale = GRAVITY * config.drum.diameter / 2.0 * (derived.angular_velocity or 0.0)
    return times(results.estimate(config, _POWER), 1.0 / scale)


def _beside_the_model(results: Results, filling: float) -> list[Check]:
    """Return toe, shoulder and arm less the C-model's, means over the speeds."""
    found: dict[str, list[Estimate]] = {"toe": [], "shoulder": [], "arm": []}
    for speed in _MODEL_SPEEDS:
        config, model = point(results.scale, speed, filling), morrell.charge(filling, speed)
        toe, shoulder = (results.estimate(config, f"{name}_angle") for name in ("toe", "shoulder"))
        found["toe"].append(times(toe, _DEGREES, less=model.toe * _DEGREES))
        found["shoulder"].append(times(shoulder, _DEGREES, less=model.shoulder * _DEGREES))
        found["arm"].append(times(arm(results, config), 1.0, less=model.arm))
    return [
        Check(
            f"{name} less the C-model's, filling {filling:g}",
            "0",
            mean_of(values),
            unit="" if name == "arm" else "°",
        )
        for name, values in found.items()
    ]


def _draw(results: Results) -> "Figure":
    from drumrs.figures import drumrs_style, new_figure
    from drumrs.registry import quantity

    with drumrs_style():
        figure = new_figure(8.4, 6.2)
        power, arms, toes, shoulders = figure.subplots(2, 2).flat
        for friction, marker in zip(_FRICTIONS, "os^", strict=True):
            points = {speed: point(results.scale, speed, friction=friction) for speed in _SPEEDS}
            found = {speed: results.estimate(config, _POWER) for speed, config in points.items()}
            _points(power, found, f"friction {friction:g}", marker)
        power.axvline(100.0, color="0.8", lw=0.8, zorder=0)
        power.set(ylabel=quantity(_POWER).label, title=f"filling {_FILLING:g}")
        for filling, marker in zip(_FILLINGS, "os^", strict=True):
            points = {speed: point(results.scale, speed, filling) for speed in _MODEL_SPEEDS}
            label = f"filling {filling:g}"
            _points(arms, {speed: arm(results, config) for speed, config in points.items()}, label, marker)
            for axes, name in ((toes, "toe_angle"), (shoulders, "shoulder_angle")):
                angles = {speed: results.estimate(config, name) for speed, config in points.items()}
                _points(axes, {speed: times(one, _DEGREES) for speed, one in angles.items()}, label, marker)
            models = [morrell.charge(filling, speed) for speed in _MODEL_SPEEDS]
            look = {"color": arms.lines[-1].get_color(), "lw": 1.0, "ls": "--"}
            percent = [100.0 * speed for speed in _MODEL_SPEEDS]
            arms.plot(percent, [model.arm for model in models], **look)
            toes.plot(percent, [model.toe * _DEGREES for model in models], **look)
            shoulders.plot(percent, [model.shoulder * _DEGREES for model in models], **look)
        arms.set(ylabel="arm: power over M g R Ω", title="dashed: C-model")
        toes.set(ylabel="toe [°]")
        shoulders.set(ylabel="shoulder [°]")
        for axes in (power, arms, toes, shoulders):
            axes.set_xlabel("speed over critical speed [%]")
            shown = _SPEEDS if axes is power else _MODEL_SPEEDS
            axes.set_xticks([100.0 * speed for speed in shown])
        for axes, place in ((power, "lower right"), (shoulders, "upper left")):
            axes.legend(loc=place)
    return figure


def _points(axes: "Axes", found: dict[float, Estimate], label: str, marker: str) -> None:
    means = [one.mean for one in found.values()]
    halves = [one.interval().half_width for one in found.values()]
    speeds = [100.0 * speed for speed in found]
    axes.errorbar(speeds, means, halves, marker=marker, mfc="none", ms=5.0, capsize=2.0, lw=1.0, label=label)


DRUM = PublishedDrum("mill", _cases, measures, _checks, _draw)
