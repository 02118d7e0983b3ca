"""Claims about N/T, what normal contacts take over what tangential contacts take: the conditions of each."""

import math
from collections.abc import Iterator
from functools import partial

from drumrs.analysis import Estimate, mean_of
from drumrs.study.cases import THIRDS
from drumrs.study.claims_power import percent, steady_level
from drumrs.study.curves import Curve, Results
from drumrs.study.trend import FALLS, RISES, goes
from drumrs.study.verdict import Condition, each_within, within
from drumrs.study.words import ABOUT, CIRCULATING

# By what damping and sliding take; work of the contact forces gives the same but for the time step's error.
RATIO = "dissipation_ratio"
CIRCULATION = "angular_momentum_per_mass"


def between_one_and_two(results: Results) -> Iterator[Condition]:
    """Judge C4 at every fill of both drums: "just under 1" is down to 10 % less, "just over 2" up to 10 % more."""
    for baffles in (False, True):
        curve = results.curve("fill", RATIO, baffles=baffles)
        name = f"N/T {curve.label}"
        yield partial(each_within, name, _named(curve), 1.0 - ABOUT, 2.0 * (1.0 + ABOUT))


def _named(curve: Curve) -> list[tuple[str, Estimate]]:
    return [(percent(point.x), point.estimate) for point in curve.points]


def constant_with_baffles(results: Results) -> Iterator[Condition]:
    """Judge C5 below and above 60 % fill: "nearly constant", "about 2.2", "falls" are a part each."""
    curve = results.curve("fill", RATIO, baffles=True)
    yield lambda: steady_level(curve.below(0.6), "N/T with baffles below 60 % fill", (0.0, 1.0), "fill ")
    yield lambda: within(
        "Its mean", mean_of(curve.below(0.6).estimates), 2.2 * (1.0 - ABOUT), 2.2 * (1.0 + ABOUT)
    )
    yield from goes(lambda: curve.between(0.6), "N/T with baffles over fill from 60 % on", FALLS)


def rises_steeply_without_baffles(results: Results) -> Iterator[Condition]:
    """Judge C6 below 40 % fill, at 50 %, and between: "steeply" is by half at least, where the paper has it double."""
    curve = results.curve("fill", RATIO)
    name = "N/T without baffles below 40 % fill"
    yield lambda: each_within(name, _named(curve.below(0.4)), 1.0 - ABOUT, 1.0 + ABOUT)
    yield lambda: within("N/T at 50 % fill", curve.at(0.5), 2.0 * (1.0 - ABOUT), 2.0 * (1.0 + ABOUT))
    yield lambda: within("Rise of N/T from 40 to 50 % fill", curve.at(0.5) - curve.at(0.4), low=0.5)


def friction_turns_the_ratio(results: Results) -> Iterator[Condition]:
    """Judge C10 over the frictions at which the load circulates: where it rocks, there is no N to speak of."""
    for fill in THIRDS:
        way = FALLS if fill == max(THIRDS) else RISES
        yield from goes(partial(_circulating, results, fill), f"N/T over friction, {percent(fill)} fill", way)


def _circulating(results: Results, fill: float) -> Curve:
    return results.curve("friction", RATIO, fill=fill).between(circulates(results, fill), least=3)


def circulates(results: Results, fill: float) -> float:
    """Return the friction from which on the load circulates: with half of its usual angular momentum."""
    curve = results.curve("friction", CIRCULATION, fill=fill)
    usual = results.usual(CIRCULATION, fill)
    still = [point.x for point in curve.points if point.estimate.mean < CIRCULATING * usual]
    return min((x for x in curve.x if x > max(still, default=-1.0)), default=math.inf)
