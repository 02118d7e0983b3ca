"""Claims about the power that the drum draws, and the conditions of each."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from drumrs.analysis import Estimate, combine, mean_of
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.claims.criteria import (
    ABOUT,
    FALLS,
    WEAK,
    ZERO,
    Claim,
    Condition,
    each_within,
    none_outside,
    slopes,
    turns_nowhere,
    within,
)
from drumrs.paper.curves import Curve, Results, peak
from drumrs.paper.verdict import UNDECIDED, Finding, MissingError, Number

POWER = "drum_specific_power"
_DRUMS = (False, True)
_HALF = 0.5


def over(one: Estimate, usual: float) -> Estimate:
    """Return an estimate over a value that stands for the usual, and whose own error is beside the point."""
    return combine(one.mean / usual, [(1.0 / usual, one)])


def peaks_between_40_and_50(results: Results) -> Iterator[Condition]:
    """Judge C1 by the vertex of a parabola: which single point is highest is a matter of chance near a flat top."""
    for baffles in _DRUMS:
        yield partial(_peak, results.curve("fill", "drum_power", baffles=baffles))


def _peak(power: Curve) -> Finding:
    found = peak(power)
    name = f"Fill of the greatest power {power.label}"
    if found.bend.interval().high >= 0.0:
        number = Number.of(name, found.place)
        return Finding(UNDECIDED, f"{name}: the curve is too flat or too noisy to tell.", (number,))
    return within(name, found.place, 0.4, 0.5)


def baffles_draw_less_below_half(results: Results) -> Iterator[Condition]:
    """Judge C2 by the ratio of powers: "less" on average and at no fill surely more, "similar" at each fill."""
    with_baffles, bare = (results.curve("fill", "drum_power", baffles=baffles) for baffles in (True, False))
    ratios = with_baffles.against(bare, lambda a, b: a / b)
    below = [(percent(x), one) for x, one in ratios if x < _HALF]
    above = [(percent(x), one) for x, one in ratios if x > _HALF]
    yield partial(_less_on_average, below)
    # Near 50 % the curves meet: single points need not tell them apart, but none may contradict.
    yield lambda: none_outside("Below 50 % fill, power with over without baffles", below, high=1.0)
    yield lambda: each_within(
        "Above 50 % fill, power with over without baffles", above, 1.0 - ABOUT, 1.0 + ABOUT
    )


def _less_on_average(ratios: list[tuple[str, Estimate]]) -> Finding:
    if not ratios:
        raise MissingError("both drums below 50 % fill")
    mean = mean_of([one for _, one in ratios])
    return within("Mean below 50 % fill of power with over without baffles", mean, high=1.0)


def specific_power_falls(results: Results) -> Iterator[Condition]:
    """Judge C3 by slopes over three parts of the axis, so that none hides behind another, and by its steps."""
    sections = (("up to 40 %", 0.0, 0.4), ("from 40 to 60 %", 0.4, 0.6), ("from 60 %", 0.6, 1.0))
    for baffles in _DRUMS:
        curve = results.curve("fill", POWER, baffles=baffles)
        name = f"specific power over fill {curve.label}"
        for part, low, high in sections:
            yield partial(_falls, curve, f"{name}, {part}", (low, high))
        yield partial(turns_nowhere, curve, name, FALLS)


def _falls(curve: Curve, name: str, reach: tuple[float, float]) -> Finding:
    return slopes(curve.between(*reach), name, FALLS, "W/kg")


def spread(curve: Curve) -> Estimate:
    """Return how much a curve varies: greatest less least, over their mean over all points.

    Raises
    ------
    MissingError
        Where there are fewer than two points.
    """
    estimates = curve.between(least=2).estimates
    mean = float(np.mean([one.mean for one in estimates]))
    most, least = max(estimates, key=lambda one: one.mean), min(estimates, key=lambda one: one.mean)
    return combine((most.mean - least.mean) / mean, [(1.0 / mean, most), (-1.0 / mean, least)])


def weak_in_size(results: Results) -> Iterator[Condition]:
    """Judge C7 in both drums, since the paper says it of both, by greatest less least over the mean."""
    for baffles in _DRUMS:
        yield partial(_varies_little, results.curve("size", POWER, baffles=baffles), "D/d")


def _varies_little(curve: Curve, axis: str) -> Finding:
    return within(f"Variation with {axis} {curve.label}", spread(curve), 0.0, WEAK)


def constant_above_some_friction(results: Results) -> Iterator[Condition]:
    """Judge C8 at each fill of F8; from 0.3 on, since power does not jump there."""
    for fill in THIRDS:
        curve = results.curve("friction", POWER, fill=fill)
        yield partial(_nothing_without_friction, curve, partial(results.usual, POWER, fill))
        yield partial(steady_level, curve, f"Power at {curve.label} from μ = 0.3 on", (0.3, 1.0), "μ = ")


def _nothing_without_friction(curve: Curve, usual: "partial[float]") -> Finding:
    name = f"Power without friction over the usual, {curve.label}"
    return within(name, over(curve.at(0.0), usual()), -ZERO, ZERO)


def steady_level(curve: Curve, name: str, reach: tuple[float, float], prefix: str = "") -> Finding:
    """Ask whether all points within the reach of the parameter lie within 10 % of their mean."""
    part = curve.between(*reach, least=2)
    level = float(np.mean([one.mean for one in part.estimates]))
    relative = [(f"{prefix}{point.x:.4g}", over(point.estimate, level)) for point in part.points]
    return each_within(f"{name}, over its mean", relative, 1.0 - ABOUT, 1.0 + ABOUT)


def what_matters_most(results: Results) -> Iterator[Condition]:
    """Judge C14 by how much each parameter changes specific power over its range, in each drum where it varies."""
    for baffles in _DRUMS:
        weak = [results.curve(axis, POWER, baffles=baffles) for axis in ("size", "restitution")]
        for axis, curve in zip(("size", "restitution"), weak, strict=True):
            yield partial(_varies_little, curve, axis)
        # Friction varies in the bare drum only.
        for axis in ("fill", "speed") if baffles else ("fill", "speed", "friction"):
            yield partial(_matters_more, results.curve(axis, POWER, baffles=baffles), axis, weak)


def _matters_more(curve: Curve, axis: str, weak: list[Curve]) -> Finding:
    strongest = max((spread(other) for other in weak), key=lambda found: found.mean)
    name = f"Variation with {axis} {curve.label}, less that with size or restitution"
    return within(name, spread(curve) - strongest, low=0.0)


CLAIMS = (
    Claim(
        "C1",
        "Drum power peaks between 40 % and 50 % fill, with and without baffles.",
        "In both drums, the vertex of the parabola through the points within 15 % of fill of the highest "
        "lies between 40 % and 50 %.",
        "F4",
        peaks_between_40_and_50,
    ),
    Claim(
        "C2",
        "Below 50 % fill the drum with baffles draws less power than without; at larger fills they are "
        "similar.",
        "With over without baffles, power below 50 % fill is less than 1 on average and at no fill surely "
        "more; at each fill above, 1 within 10 %.",
        "F4",
        baffles_draw_less_below_half,
    ),
    Claim(
        "C3",
        "Specific power falls as fill rises.",
        "In both drums, the slope of specific power over fill is negative up to 40 %, from 40 to 60 %, and from "
        "60 % on, and no step between neighboring fills goes up by more than 10 % of the mean.",
        "F5",
        specific_power_falls,
    ),
    Claim(
        "C7",
        "Specific power varies by only about 20 % over the whole range of D/d.",
        "In both drums, greatest less least is at most 25 % of the mean, which is what rounds to 20 %.",
        "F7",
        weak_in_size,
    ),
    Claim(
        "C8",
        "Without baffles specific power is zero at μ = 0 and about constant above μ = 0.3.",
        "At 25, 50 and 75 % fill: without friction less than 1 % of the power at μ = 0.5; from 0.3 on each "
        "within 10 % of their mean.",
        "F8",
        constant_above_some_friction,
    ),
    Claim(
        "C14",
        "Fill, speed and friction matter most; bundle size and restitution matter little.",
        "Each of fill, speed and friction changes specific power, greatest less least over the mean, by "
        "more than size and restitution do, and those change it by at most 25 %.",
        "speed",
        what_matters_most,
    ),
)
