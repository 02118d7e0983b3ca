"""Claims about the power that the drum draws."""

import numpy as np

from drumrs.analysis import Estimate, combine, mean_of
from drumrs.study.cases import THIRDS
from drumrs.study.curves import Curve, Results, peak, slope
from drumrs.study.verdict import HOLDS, UNDECIDED, Finding, Number, all_of, each_within, within
from drumrs.study.words import ABOUT, WEAK, ZERO

_DRUMS = (False, True)
_HALF = 0.5


def percent(fill: float) -> str:
    """Name a fill as figures do."""
    return f"{100.0 * fill:.4g} %"


def peaks_between_40_and_50(results: Results) -> Finding:
    """Judge C1 by the vertex of the parabola through the points near the highest."""
    return all_of(_peak(results.curve("fill", "drum_power", baffles=baffles)) for baffles in _DRUMS)


def _peak(power: Curve) -> Finding:
    found = peak(power)
    name = f"Fill of the greatest power {power.label}"
    if found.bend.interval().high >= 0.0:
        number = Number.of(name, found.place)
        return Finding(UNDECIDED, f"{name}: the curve is too flat or too noisy to tell.", (number,))
    return within(name, found.place, 0.4, 0.5)


def baffles_draw_less_below_half(results: Results) -> Finding:
    """Judge C2 by the ratio of powers, with over without baffles."""
    with_baffles, bare = (results.curve("fill", "drum_power", baffles=baffles) for baffles in (True, False))
    ratios = with_baffles.against(bare, lambda a, b: a / b)
    below = [(percent(x), one) for x, one in ratios if x < _HALF]
    above = [(percent(x), one) for x, one in ratios if x > _HALF]
    name = "power with over without baffles"
    single = each_within(f"There the {name}", below, high=1.0)
    mean = within(f"Mean of {name}, below 50 % fill", mean_of([one for _, one in below]), high=1.0)
    # Near 50 % the curves meet: single points need not tell them apart, but none may contradict.
    less = mean if single.outcome in {HOLDS, UNDECIDED} else all_of([mean, single])
    return all_of([less, each_within(f"Above, the {name}", above, 1.0 - ABOUT, 1.0 + ABOUT)])


def specific_power_falls(results: Results) -> Finding:
    """Judge C3 by slopes over three parts of the axis."""
    sections = (("up to 40 %", 0.0, 0.4), ("from 40 to 60 %", 0.4, 0.6), ("from 60 %", 0.6, 1.0))
    findings = []
    for baffles in _DRUMS:
        curve = results.curve("fill", "drum_specific_power", baffles=baffles)
        for name, low, high in sections:
            part = curve.between(low, high, least=2)
            title = f"Slope of specific power {curve.label}, {name} fill"
            findings.append(within(title, slope(part), high=0.0, unit="W/kg"))
    return all_of(findings)


def spread(curve: Curve, name: str) -> tuple[str, Estimate]:
    """Return how much a curve varies: greatest less least, over their mean over all points."""
    curve = curve.between(least=2)
    estimates = curve.estimates
    mean = float(np.mean([one.mean for one in estimates]))
    most, least = max(estimates, key=lambda one: one.mean), min(estimates, key=lambda one: one.mean)
    difference = (most.mean - least.mean) / mean
    return f"{name} {curve.label}", combine(difference, [(1.0 / mean, most), (-1.0 / mean, least)])


def weak_in_size(results: Results) -> Finding:
    """Judge C7 by greatest less least, over the mean."""
    found = [
        spread(results.curve("size", "drum_specific_power", baffles=baffles), "Variation with D/d")
        for baffles in _DRUMS
    ]
    return all_of(within(name, one, 0.0, WEAK) for name, one in found)


def constant_above_some_friction(results: Results) -> Finding:
    """Judge C8 at each of three fills."""
    findings = []
    for fill in THIRDS:
        curve = results.curve("friction", "drum_specific_power", fill=fill)
        # Over a power that stands for the usual one, and whose own error is beside the point.
        usual = curve.at(0.5).mean
        none = combine(curve.at(0.0).mean / usual, [(1.0 / usual, curve.at(0.0))])
        findings.append(within(f"Power without friction over the usual, {curve.label}", none, -ZERO, ZERO))
        findings.append(steady_level(curve.between(0.3, least=2), f"Power at {curve.label}", "μ = "))
    return all_of(findings)


def steady_level(curve: Curve, name: str, prefix: str = "") -> Finding:
    """Ask whether all points lie within 10 % of their mean."""
    level = float(np.mean([one.mean for one in curve.estimates]))
    relative = [
        (f"{prefix}{point.x:.4g}", combine(point.estimate.mean / level, [(1.0 / level, point.estimate)]))
        for point in curve.points
    ]
    return each_within(f"{name} over its mean", relative, 1.0 - ABOUT, 1.0 + ABOUT)


def what_matters_most(results: Results) -> Finding:
    """Judge C14 by how much each parameter changes specific power over its range."""
    findings = []
    for baffles in _DRUMS:
        spreads = {
            axis: spread(
                results.curve(axis, "drum_specific_power", baffles=baffles), f"Variation with {axis}"
            )
            for axis in ("fill", "speed", "friction", "size", "restitution")
            # Friction varies in the bare drum only.
            if axis != "friction" or not baffles
        }
        weak = [spreads.pop("size"), spreads.pop("restitution")]
        findings += [within(name, one, 0.0, WEAK) for name, one in weak]
        strongest = max(weak, key=lambda found: found[1].mean)
        findings += [
            within(f"{name} less that with size or restitution", one - strongest[1], low=0.0)
            for name, one in spreads.values()
        ]
    return all_of(findings)
