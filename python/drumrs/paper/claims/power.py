"""Claims about the power that the drum draws, and the conditions of each."""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from drumrs.analysis import Estimate, combine, mean_of
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.claims import why
from drumrs.paper.claims.criteria import (
    FALLS,
    ZERO,
    Claim,
    Condition,
    all_of,
    at_fills,
    each_within,
    is_constant,
    is_monotonic,
    is_similar,
    none_outside,
    varies_little,
    within,
)
from drumrs.paper.curves import Curve, Results, peak
from drumrs.paper.drums import Drum
from drumrs.paper.verdict import UNDECIDED, Band, Finding, MissingError, Number

POWER = "drum_specific_power"
_HALF = 0.5
_PEAK = (0.4, 0.5)

Parts = Iterator[tuple[str, Condition]]


def over(one: Estimate, usual: float) -> Estimate:
    """Return an estimate over a value that stands for the usual, and whose own error is beside the point."""
    return combine(one.mean / usual, [(1.0 / usual, one)])


def peaks_between_40_and_50(results: Results) -> Parts:
    """Judge C1 by the vertex of a parabola: which single point is highest is a matter of chance near a flat top."""
    for drum in results.drums:
        yield drum.name, partial(_peak, results.curve("fill", "drum_power", drum=drum))


def _peak(power: Curve) -> Finding:
    found = peak(power)
    name = f"Fill of the greatest power {power.label}"
    if found.bend.interval().high >= 0.0:
        number = Number.of(name, found.place)
        return Finding(UNDECIDED, f"{name}: the curve is too flat or too noisy to tell.", (number,))
    everywhere = Band(power.axis, power.column, power.label, _PEAK, (-np.inf,) * 2, (np.inf,) * 2)
    return all_of([within(name, found.place, *_PEAK)], bands=(everywhere,))


def baffles_draw_less_below_half(results: Results) -> Parts:
    """Judge C2 by the ratio of powers: "less" on average and at no fill surely more; "similar" on F4's scale."""
    bare, baffled = (results.curve("fill", "drum_power", drum=drum) for drum in results.drums)
    yield "less below 50 % fill", partial(_is_less, baffled, bare)
    yield "similar above 50 % fill", partial(similar_above_half, results, "drum_power", "Power")


def _is_less(baffled: Curve, bare: Curve) -> Finding:
    ratios = baffled.below(_HALF).against(bare, lambda a, b: a / b)
    if not ratios:
        raise MissingError("both drums below 50 % fill")
    mean = mean_of([one for _, one in ratios])
    average = within("Mean below 50 % fill of power with over without baffles", mean, high=1.0)
    # Near 50 % the curves meet: single points need not tell them apart, but none may contradict.
    points = [(x, x, one) for x, one in ratios]
    each = none_outside(each_within("Power with over without baffles, fill by fill", points, high=1.0))
    level = tuple(bare.at(x).mean for x, _ in ratios)
    under = Band(
        baffled.axis,
        baffled.column,
        baffled.label,
        tuple(x for x, _ in ratios),
        (-np.inf,) * len(ratios),
        level,
    )
    return all_of([average, each], each.pieces, "fill", bands=(under,))


def similar_above_half(results: Results, column: str, name: str, largest: float | None = None) -> Finding:
    """Ask whether both drums are about the same above 50 % fill, on the scale of the figure unless another is given."""
    bare, baffled = (results.curve("fill", column, drum=drum) for drum in results.drums)
    title = f"{name} with less without baffles, above 50 % fill"
    scale = results.largest("fill", column) if largest is None else largest
    return is_similar(baffled.above(_HALF), bare, title, scale)


def specific_power_falls(results: Results) -> Parts:
    """Judge C3 by slopes over three parts of the axis, so that none hides behind another, and by its steps."""
    for drum in results.drums:
        yield drum.name, partial(_falls, results, results.curve("fill", POWER, drum=drum))


def _falls(results: Results, curve: Curve) -> Finding:
    name = f"specific power [W/kg] over fill {curve.label}"
    return is_monotonic(
        curve, name, FALLS, results.largest("fill", POWER), ((0.0, 0.4), (0.4, 0.6), (0.6, 1.0))
    )


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


def weak_in_size(results: Results) -> Parts:
    """Judge C7 in both drums, since the paper says it of both, by how far power falls from its greatest."""
    for drum in results.drums:
        yield drum.name, partial(_varies_little, results, results.curve("size", POWER, drum=drum), "D/d")


def _varies_little(results: Results, curve: Curve, axis: str) -> Finding:
    name = f"Specific power [W/kg] over {axis} {curve.label}"
    return varies_little(curve, name, results.largest(curve.axis, POWER))


def constant_above_some_friction(results: Results) -> Parts:
    """Judge C8 at each fill of F8; from 0.3 on, since power does not jump there."""
    yield "zero at μ = 0", partial(_nothing_without_friction, results)
    for fill in THIRDS:
        yield f"constant above μ = 0.3 at {percent(fill)} fill", partial(_levels_off, results, fill)


def _nothing_without_friction(results: Results) -> Finding:
    found = []
    for fill in THIRDS:
        curve, usual = results.curve("friction", POWER, fill=fill), results.usual(POWER, fill)
        name = f"Power without friction over the usual, {curve.label}"
        found.append((fill, within(name, over(curve.at(0.0), usual), -ZERO, ZERO)))
    return at_fills(found)


def _levels_off(results: Results, fill: float) -> Finding:
    curve = results.curve("friction", POWER, fill=fill).between(0.3)
    name = f"Specific power [W/kg] at {curve.label} from μ = 0.3 on"
    return is_constant(curve, name, results.largest("friction", POWER))


def what_matters_most(results: Results) -> Parts:
    """Judge C14 by how much each parameter changes specific power over its range, in each drum where it varies."""
    for drum, strong in zip(results.drums, (("fill", "speed", "friction"), ("fill", "speed")), strict=True):
        # Friction varies in the bare drum only.
        words = f"{', '.join(strong[:-1])} and {strong[-1]}"
        yield f"size and restitution matter little {drum.name}", partial(_matter_little, results, drum)
        yield f"{words} matter more {drum.name}", partial(_matter_more, results, drum, strong)


def _matter_little(results: Results, drum: Drum) -> Finding:
    return all_of([_varies_little(results, *one) for one in _weak(results, drum)])


def _weak(results: Results, drum: Drum) -> list[tuple[Curve, str]]:
    names = {"size": "D/d", "restitution": "restitution"}
    return [(results.curve(axis, POWER, drum=drum), name) for axis, name in names.items()]


def _matter_more(results: Results, drum: Drum, axes: Sequence[str]) -> Finding:
    weak = [curve for curve, _ in _weak(results, drum)]
    return all_of([_matters_more(results.curve(axis, POWER, drum=drum), weak) for axis in axes])


def _matters_more(curve: Curve, weak: list[Curve]) -> Finding:
    strongest = max((spread(other) for other in weak), key=lambda found: found.mean)
    name = f"Variation with {curve.axis} {curve.label}, less that with size or restitution"
    return within(name, spread(curve) - strongest, low=0.0)


CLAIMS = (
    Claim(
        "C1",
        "Drum power peaks between 40 % and 50 % fill, with and without baffles.",
        "In both drums, the vertex of the parabola through the points within 15 % of fill of the highest "
        "lies between 40 % and 50 %.",
        "F4",
        ("fill", "drum_power"),
        peaks_between_40_and_50,
    ),
    Claim(
        "C2",
        "Below 50 % fill the drum with baffles draws less power than without; at larger fills they are "
        "similar.",
        "With over without baffles, power below 50 % fill is less than 1 on average and at no fill surely "
        "more; at each fill above, both differ by at most a tenth of the greatest power shown.",
        "F4",
        ("fill", "drum_power"),
        baffles_draw_less_below_half,
        why.baffles_fill_the_drum,
    ),
    Claim(
        "C3",
        "Specific power falls as fill rises.",
        "In both drums, the slope of specific power over fill is negative up to 40 %, from 40 to 60 %, and from "
        "60 % on, and no step between neighboring fills goes up by more than a tenth of the greatest value shown.",
        "F5",
        ("fill", POWER),
        specific_power_falls,
    ),
    Claim(
        "C7",
        "Specific power varies by only about 20 % over the whole range of D/d.",
        "In both drums, it is nowhere less than 80 % of its greatest, to a tenth of the greatest value shown.",
        "F7",
        ("size", POWER),
        weak_in_size,
        why.baffles_keep_their_size,
    ),
    Claim(
        "C8",
        "Without baffles specific power is zero at μ = 0 and about constant above μ = 0.3.",
        "At 25, 50 and 75 % fill: without friction less than 1 % of the power at μ = 0.5; from 0.3 on each differs "
        "from their mean by at most a tenth of the greatest value shown.",
        "F8",
        ("friction", POWER),
        constant_above_some_friction,
        why.damping_goes_on_growing,
    ),
    Claim(
        "C14",
        "Fill, speed and friction matter most; bundle size and restitution matter little.",
        "Each of fill, speed and friction changes specific power, greatest less least over the mean, by "
        "more than size and restitution do; with these it falls by at most 20 % of its greatest, read as in C7.",
        "restitution",
        ("restitution", POWER),
        what_matters_most,
    ),
)
