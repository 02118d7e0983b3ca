"""Claims about N/T, what normal contacts take over what tangential contacts take: the conditions of each."""

import math
from collections.abc import Iterator
from functools import partial

from drumrs.analysis import Estimate, mean_of
from drumrs.study.cases import THIRDS
from drumrs.study.claims_power import percent, steady_level
from drumrs.study.curves import Curve, Results, slope
from drumrs.study.verdict import Condition, Finding, each_within, within
from drumrs.study.words import ABOUT, CIRCULATING

# By what damping and sliding take; work of the contact forces gives the same but for the time step's error.
RATIO = "dissipation_ratio"
_HALF = 0.5
CIRCULATION = "angular_momentum_per_mass"


def between_one_and_two(results: Results) -> Iterator[Condition]:
    """Judge C4 at every fill of both drums."""
    for baffles in (False, True):
        curve = results.curve("fill", RATIO, baffles=baffles)
        name = f"N/T {curve.label}"
        yield partial(each_within, name, _named(curve), 1.0 - ABOUT, 2.0 * (1.0 + ABOUT))


def _named(curve: Curve) -> list[tuple[str, Estimate]]:
    return [(percent(point.x), point.estimate) for point in curve.points]


def constant_with_baffles(results: Results) -> Iterator[Condition]:
    """Judge C5 below and above 60 % fill."""
    curve = results.curve("fill", RATIO, baffles=True)
    yield lambda: steady_level(curve.below(0.6), "N/T with baffles below 60 % fill", (0.0, 1.0), "fill ")
    yield lambda: within(
        "Its mean", mean_of(curve.below(0.6).estimates), 2.2 * (1.0 - ABOUT), 2.2 * (1.0 + ABOUT)
    )
    yield lambda: within("Slope of N/T over fill from 60 % on", slope(curve.between(0.6)), high=0.0)


def rises_steeply_without_baffles(results: Results) -> Iterator[Condition]:
    """Judge C6 below 40 % fill, at 50 %, and between."""
    curve = results.curve("fill", RATIO)
    name = "N/T without baffles below 40 % fill"
    yield lambda: each_within(name, _named(curve.below(0.4)), 1.0 - ABOUT, 1.0 + ABOUT)
    yield lambda: within("N/T at 50 % fill", curve.at(0.5), 2.0 * (1.0 - ABOUT), 2.0 * (1.0 + ABOUT))
    yield lambda: within("Rise of N/T from 40 to 50 % fill", curve.at(0.5) - curve.at(0.4), low=0.5)


def friction_turns_the_ratio(results: Results) -> Iterator[Condition]:
    """Judge C10 by slopes over the frictions at which the load circulates, up to 0.5 and from there on."""
    for fill in THIRDS:
        for part in ("up to 0.5", "from 0.5 on"):
            yield partial(_turns, results, fill, part)


def _turns(results: Results, fill: float, part: str) -> Finding:
    reach = (circulates(results, fill), _HALF) if part == "up to 0.5" else (_HALF, math.inf)
    curve = results.curve("friction", RATIO, fill=fill)
    low, high = (-math.inf, 0.0) if fill == max(THIRDS) else (0.0, math.inf)
    name = f"Slope of N/T over friction {part}, {curve.label}"
    return within(name, slope(curve.between(*reach)), low, high)


def circulates(results: Results, fill: float) -> float:
    """Return the friction from which on the load circulates: with half of its usual angular momentum."""
    curve = results.curve("friction", CIRCULATION, fill=fill)
    usual = results.usual(CIRCULATION, fill)
    still = [point.x for point in curve.points if point.estimate.mean < CIRCULATING * usual]
    return min((x for x in curve.x if x > max(still, default=-1.0)), default=math.inf)
