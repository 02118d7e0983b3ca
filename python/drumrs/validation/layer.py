"""The half-full drums of Oba and Otsuki: how thick the flowing layer is, over the drum's size and speed."""

import math
import re
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis import Estimate, combine
from drumrs.config import Config, baseline
from drumrs.registry import quantity
from drumrs.validation.cases import (
    BED,
    GRAVITY,
    Scale,
    contacts,
    stiffness,
    teeth,
    times,
    turning,
    with_seeds,
)
from drumrs.validation.check import NOTHING, Check
from drumrs.validation.drum import PublishedDrum
from drumrs.validation.results import Results, check_of_overlap
from drumrs.validation.tracer import measures

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DISC, _DENSITY, _FRICTION, _RESTITUTION = 0.003, 2500.0, 0.5, 0.92
_SIZES, _FROUDES = (32.0, 45.0, 64.0), (1e-3, 3e-3, 1e-2)
# At which size the speed varies, and at which speed the size.
_SIZE, _FROUDE = 45.0, 3e-3
# "Hardly": thickness goes with less than that power of the speed, a quarter over ten times the Froude number.
_HARDLY, _HALVING = 0.2, 0.1
_WINDOW = (0.3, 0.8)  # turns
_FRAMES = 1000  # in a turn
# Lengths times 4ᵏ, times times 2ᵏ.
_SIMILAR, _SIMILAR_SIZE = (0, 1, 2), 16.0


def point(scale: Scale, size: float = _SIZE, froude: float = _FROUDE) -> Config:
    """Return a half-full drum as a configuration.

    Parameters
    ----------
    scale
        Size of the study.
    size
        D/d.
    froude
        Froude number Ω² D / (2 g).

    Examples
    --------
    >>> from drumrs.validation import Scale, layer
    >>> config = layer.point(Scale(), froude=0.01)
    >>> config.bundle_count, round(config.derived.froude_number, 6)
    (850, 0.01)
    """
    return _drum(scale, size * scale.fineness, froude, _DISC)


def similar(scale: Scale, power: int) -> Config:
    """Return a drum with lengths times 4 and times times 2, so often as `power` says: all else that counts is the same.

    Density and gravity stay, so masses go with the square of lengths, and stiffness with lengths.

    Examples
    --------
    >>> from drumrs.validation import Scale, layer
    >>> small, large = (layer.similar(Scale(), power) for power in (0, 1))
    >>> large.drum.diameter / small.drum.diameter, large.derived.time_step / small.derived.time_step
    (4.0, 2.0)
    """
    config = _drum(scale, _SIMILAR_SIZE, _FROUDES[-1], _DISC * 4.0**power)
    return config.replace({"run.frame_every": config.run.duration})


def _drum(scale: Scale, size: float, froude: float, disc: float) -> Config:
    diameter = size * disc
    start, end = (scale.duration * turns for turns in _WINDOW)
    rpm = math.sqrt(froude * 2.0 * GRAVITY / diameter) * 30.0 / math.pi
    return baseline().replace(
        {
            "drum": {"diameter": diameter, "baffles": teeth(diameter, disc)},
            "load": {"diameter": disc, "density": _DENSITY, "fill": 0.5 * BED},
            **contacts(stiffness(_DENSITY, diameter / 2.0), _FRICTION, _RESTITUTION),
            **turning(rpm, (start, end), _FRAMES),
        }
    )


def _cases(scale: Scale) -> list[Config]:
    points = [point(scale, size) for size in _SIZES] + [point(scale, froude=froude) for froude in _FROUDES]
    # The drum that the others are compared with has more starts than they.
    cases = with_seeds([point(scale), point(scale).softer(2.0)], scale.seeds)
    cases += with_seeds(points, scale.few)
    return cases + with_seeds([similar(scale, power) for power in _SIMILAR], scale.seeds[:1])


def _checks(results: Results) -> list[Check]:
    sizes = {size: thickness(results, point(results.scale, size)) for size in _SIZES}
    speeds = [thickness(results, point(results.scale, froude=froude)) for froude in _FROUDES]
    least, middle, most = _SIZES
    by_size = _exponent(sizes[least], sizes[most], most / least)
    by_speed = _exponent(speeds[0], speeds[-1], math.sqrt(_FROUDES[-1] / _FROUDES[0]))
    plain = point(results.scale)
    soft = thickness(results, plain.softer(2.0)) / thickness(results, plain)
    checks = [
        Check(
            f"layer in diameters, D/d from {one:g} to {other:g}",
            "thicker",
            sizes[other] - sizes[one],
            low=0.0,
        )
        for one, other in ((least, middle), (middle, most))
    ]
    checks += [
        Check("power of D/d with which the layer in diameters goes", "above 0", by_size, low=0.0),
        Check("power of Ω with which it goes", "near 0", by_speed, -_HARDLY, _HARDLY),
    ]
    checks += [
        Check(
            f"numbers of the series that change, lengths times {4**power}",
            NOTHING,
            Estimate(_unequal(results, power), 0.0, 1),
            0.0,
            0.0,
        )
        for power in _SIMILAR[1:]
    ]
    return [
        *checks,
        Check(
            "layer at half the stiffness, over that at all of it",
            NOTHING,
            soft,
            1.0 - _HALVING,
            1.0 + _HALVING,
        ),
        check_of_overlap(results, plain),
    ]


def thickness(results: Results, config: Config) -> Estimate:
    """Return the thickness of the flowing layer, in diameters."""
    return times(results.estimate(config, "layer_thickness"), 1.0 / config.load.diameter)


def _exponent(one: Estimate, other: Estimate, factor: float) -> Estimate:
    """Return the power of a factor that the ratio of two means is."""
    scale = 1.0 / math.log(factor)
    parts = [(-scale / one.mean, one), (scale / other.mean, other)]
    return combine(scale * math.log(other.mean / one.mean), parts)


def _unequal(results: Results, power: int) -> int:
    """Count the numbers of the series that differ by a bit from those of the smallest drum, each in its unit."""
    small, large = (results.series(similar(results.scale, k)) for k in (0, power))
    scaled = [
        small[name].to_numpy() * 2.0 ** (power * factor_of(quantity(name).unit)) == large[name].to_numpy()
        for name in small.columns
    ]
    return int(np.sum(~np.array(scaled)))


# The power of 2 by which a unit grows where lengths, that of the drum included, are taken times 4 and times times 2, at
# one density.
_FACTORS = {"1": 0, "rad": 0, "m": 2, "s": 1, "kg": 6, "N": 6, "J": 8, "W": 7}


def factor_of(unit: str) -> int:
    """Return the power of 2 by which numbers of a unit grow where lengths are taken times 4 and times times 2.

    Examples
    --------
    >>> from drumrs.validation.layer import factor_of
    >>> factor_of("J/m"), factor_of("kg m/s"), factor_of("m²/s")
    (6, 7, 3)
    """
    above, _, below = unit.partition("/")

    def of(product: str) -> int:
        parts = re.findall(r"([A-Za-z]+|1)(²?)", product)
        return sum(_FACTORS[name] * (2 if square else 1) for name, square in parts)

    return of(above) - of(below)


def _draw(results: Results) -> "Figure":
    from drumrs.figures import drumrs_style, new_figure

    with drumrs_style():
        figure = new_figure(7.6, 3.2)
        sizes, speeds = figure.subplots(1, 2, sharey=True)
        scale = results.scale
        for axes, places, found in (
            (sizes, _SIZES, [thickness(results, point(scale, size)) for size in _SIZES]),
            (speeds, _FROUDES, [thickness(results, point(scale, froude=froude)) for froude in _FROUDES]),
        ):
            means, halves = [one.mean for one in found], [one.interval().half_width for one in found]
            axes.errorbar(places, means, halves, fmt="o-", mfc="none", capsize=3.0)
            axes.set(xscale="log", yscale="log")
            axes.set_xticks(places, [f"{place:g}" for place in places])
            axes.minorticks_off()
        low, high = sizes.get_ylim()
        ticks = [tick for tick in range(2, 31) if low <= tick <= high]
        sizes.set_yticks(ticks, [str(tick) for tick in ticks])
        title = f"{quantity('size_ratio').title} D/d"
        sizes.set(xlabel=title, ylabel="flowing layer, in diameters", title=f"Froude number {_FROUDE:g}")
        speeds.set(xlabel="Froude number Ω²D/(2g)", title=f"D/d = {_SIZE * scale.fineness:g}")
    return figure


DRUM = PublishedDrum("layer", _cases, measures, _checks, _draw)
