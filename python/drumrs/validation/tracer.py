"""The drum of Alizadeh et al.: the velocity across the bed, from a tracer followed in three dimensions."""

import math
from typing import TYPE_CHECKING

from drumrs.analysis import Estimate
from drumrs.analysis.blocks import Array
from drumrs.config import Config, baseline
from drumrs.measures.profile import Profile, layer_in, profile
from drumrs.validation.cases import BED, Scale, contacts, stiffness, teeth, times, turning, with_seeds
from drumrs.validation.check import NOTHING, Check
from drumrs.validation.drum import PublishedDrum
from drumrs.validation.results import Results, check_of_overlap

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from drumrs.analysis import Mean
    from drumrs.measures.frame_window import FrameWindow

# The experiment.
_DIAMETER, _BEAD, _RPM, _BELOW_AXIS = 0.24, 0.003, 11.6, 0.03
_SURFACE_VELOCITY, _LAYER, _SOLID_ROTATION = 2.39, 0.33, 0.05
# Glass. Its friction is not among the numbers at hand: a usual value, and another beside.
_DENSITY, _RESTITUTION, _FRICTION, _OTHER_FRICTION = 2500.0, 0.9, 0.3, 0.5
_TOLERANCE, _HALVING = 0.15, 0.10
_WINDOW = (0.4, 1.2)  # turns
_FRAMES = 600  # in a turn


def point(scale: Scale, friction: float = _FRICTION) -> Config:
    """Return the drum as a configuration.

    Examples
    --------
    >>> from drumrs.validation import Scale, tracer
    >>> tracer.point(Scale()).bundle_count
    1841
    """
    bead = _BEAD / scale.fineness
    radius = _DIAMETER / 2.0
    half_angle = math.acos(_BELOW_AXIS / radius)
    filled = (half_angle - math.sin(half_angle) * math.cos(half_angle)) / math.pi
    start, end = (scale.duration * turns for turns in _WINDOW)
    return baseline().replace(
        {
            "drum.diameter": _DIAMETER,
            "drum.baffles": teeth(_DIAMETER, bead),
            "load": {"diameter": bead, "density": _DENSITY, "fill": BED * filled},
            **contacts(stiffness(_DENSITY, radius - _BELOW_AXIS), friction, _RESTITUTION),
            **turning(_RPM, (start, end), _FRAMES),
        }
    )


def measures(config: Config, seen: "FrameWindow") -> "Mapping[str, Mean]":
    """Return what frames tell of the velocity across the bed, by name of the registry."""
    return layer_in(seen, config.load.diameter, config.drum.diameter / 2.0)


def _cases(scale: Scale) -> list[Config]:
    plain = point(scale)
    return with_seeds([plain, plain.softer(2.0), point(scale, _OTHER_FRICTION)], scale.seeds)


def _checks(results: Results) -> list[Check]:
    plain, other = point(results.scale), point(results.scale, _OTHER_FRICTION)
    surface, layer = _surface(results, plain), _layer(results, plain)
    depth, core = (results.estimate(plain, name) for name in ("bed_depth", "core_velocity_ratio"))
    soft = plain.softer(2.0)
    least, most = 1.0 - _TOLERANCE, 1.0 + _TOLERANCE
    same = (1.0 - _HALVING, 1.0 + _HALVING)
    asked = _DIAMETER / 2.0 - _BELOW_AXIS
    return [
        Check(
            "surface velocity over that of the rim",
            f"{_SURFACE_VELOCITY}",
            surface,
            _SURFACE_VELOCITY * least,
            _SURFACE_VELOCITY * most,
        ),
        Check("flowing layer over the depth of the bed", f"{_LAYER}", layer, _LAYER * least, _LAYER * most),
        Check(
            "angular velocity of the core over that of the drum",
            "1 within 3–5 %",
            core,
            1.0 - _SOLID_ROTATION,
            1.0 + _SOLID_ROTATION,
        ),
        Check(
            "depth of the bed",
            f"{1e3 * asked:g} mm",
            times(depth, 1e3),
            1e3 * asked * 0.95,
            1e3 * asked * 1.05,
            "mm",
        ),
        Check(
            "layer down to solid rotation, over the depth of the bed",
            NOTHING,
            results.estimate(plain, "layer_to_solid_rotation") / depth,
        ),
        Check(
            "slope of the surface",
            NOTHING,
            times(results.estimate(plain, "center_slope"), 180.0 / math.pi),
            unit="°",
        ),
        Check(
            f"surface velocity with friction {_OTHER_FRICTION:g} instead of {_FRICTION:g}",
            NOTHING,
            _surface(results, other),
        ),
        Check(f"flowing layer with friction {_OTHER_FRICTION:g}", NOTHING, _layer(results, other)),
        Check(
            "surface velocity at half the stiffness, over that at all of it",
            NOTHING,
            _surface(results, soft) / surface,
            *same,
        ),
        Check("flowing layer at half the stiffness, likewise", NOTHING, _layer(results, soft) / layer, *same),
        check_of_overlap(results, plain),
    ]


def _surface(results: Results, config: Config) -> Estimate:
    return results.estimate(config, "surface_velocity_ratio")


def _layer(results: Results, config: Config) -> Estimate:
    return results.estimate(config, "layer_thickness") / results.estimate(config, "bed_depth")


def _draw(results: Results) -> "Figure":
    from drumrs.figures import INK, drumrs_style, line_colors, new_figure

    with drumrs_style():
        figure = new_figure(5.6, 3.8)
        axes = figure.subplots()
        for friction, color in zip((_FRICTION, _OTHER_FRICTION), line_colors(), strict=False):
            for k, seen in enumerate(results.windows(point(results.scale, friction))):
                found = profile(seen, _BEAD / results.scale.fineness, _DIAMETER / 2.0)
                label = f"friction {friction:g}" if not k else None
                axes.plot(*_scaled(found), "os^D"[k % 4], color=color, mfc="none", ms=4.0, label=label)
        ratio = _BELOW_AXIS * 2.0 / _DIAMETER
        axes.plot([-ratio, -1.0], [0.0, 1.0], color="0.5", lw=1.0, ls="--", label="solid rotation")
        tolerance = _TOLERANCE * _SURFACE_VELOCITY
        axes.errorbar(
            [_SURFACE_VELOCITY, 0.0],
            [0.0, _LAYER],
            [0.0, _TOLERANCE * _LAYER],
            [tolerance, 0.0],
            fmt="*",
            color=INK,
            ms=11.0,
            capsize=3.0,
            label="Alizadeh et al., ± 15 %",
        )
        axes.axvline(0.0, color="0.8", lw=0.8, zorder=0)
        axes.set(
            xlabel="velocity down the slope over that of the rim",
            ylabel="depth below the surface over depth of the bed",
            ylim=(1.05, -0.15),
        )
        axes.legend(loc="lower right")
    return figure


def _scaled(found: Profile) -> tuple[Array, Array]:
    """Return velocities over that of the rim, and depths over that of the bed, as far as there is a bed."""
    bed = found.heights < found.surface + 0.5 * (found.heights[1] - found.heights[0])
    velocities = found.velocities / (found.angular_velocity * found.drum_radius)
    return velocities[bed], (found.surface - found.heights[bed]) / found.depth


DRUM = PublishedDrum("tracer", _cases, measures, _checks, _draw)
