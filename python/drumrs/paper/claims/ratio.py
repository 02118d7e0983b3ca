"""Claims about N/T, what normal contacts take over what tangential contacts take, and the conditions of each."""

import math
from collections.abc import Iterator
from functools import partial

from drumrs.analysis import Estimate, mean_of
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.claims.criteria import (
    ABOUT,
    CIRCULATING,
    FALLS,
    RISES,
    Claim,
    Condition,
    each_within,
    is_monotonic,
    within,
)
from drumrs.paper.claims.power import steady_level
from drumrs.paper.curves import Curve, Results

# By what damping and sliding take; with what springs store counted as well it is nearly the same.
RATIO = "dissipation_ratio"
CIRCULATION = "specific_angular_momentum"


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
    yield from is_monotonic(lambda: curve.between(0.6), "N/T with baffles over fill from 60 % on", FALLS)


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
        yield from is_monotonic(
            partial(_circulating, results, fill), f"N/T over friction, {percent(fill)} fill", way
        )


def _circulating(results: Results, fill: float) -> Curve:
    return results.curve("friction", RATIO, fill=fill).between(circulates(results, fill), least=3)


def circulates(results: Results, fill: float) -> float:
    """Return the friction from which on the load circulates: with half of its usual angular momentum."""
    curve = results.curve("friction", CIRCULATION, fill=fill)
    usual = results.usual(CIRCULATION, fill)
    still = [point.x for point in curve.points if point.estimate.mean < CIRCULATING * usual]
    return min((x for x in curve.x if x > max(still, default=-1.0)), default=math.inf)


CLAIMS = (
    Claim(
        "C4",
        "N/T lies between just under 1 and just over 2.",
        "In both drums and at every fill, from 1 less 10 % to 2 plus 10 %.",
        "F6",
        between_one_and_two,
    ),
    Claim(
        "C5",
        "With baffles N/T is nearly constant, about 2.2, below 60 % fill, and falls above.",
        "Below 60 % every N/T is within 10 % of their mean, and that within 10 % of 2.2; from 60 % on it falls: the "
        "slope is negative, and no step between neighboring fills goes up by more than 10 % of the mean.",
        "F6",
        constant_with_baffles,
    ),
    Claim(
        "C6",
        "Without baffles N/T is about 1 below 40 % fill and rises steeply to near 2 at about 50 %.",
        "Below 40 % every N/T is within 10 % of 1; at 50 % it is within 10 % of 2; from 40 to 50 % it rises "
        "by more than 0.5.",
        "F6",
        rises_steeply_without_baffles,
    ),
    Claim(
        "C10",
        "N/T rises with μ at 25 % and 50 % fill and falls with μ at 75 %.",
        "Over the frictions at which the load has more than half of its usual angular momentum, N/T rises at 25 and "
        "50 % and falls at 75 %: the straight line through all points does, and no step between neighboring points "
        "goes the other way by more than 10 % of the mean.",
        "F9",
        friction_turns_the_ratio,
    ),
)
