"""Claims about N/T, the power of normal contacts over that of tangential ones, and the conditions of each.

The paper's ratio is of power "dissipated and stored" and "includes both spring and dissipative elements". What springs
store they give back, so on balance they add nothing, and would not have been worth a word: N and T are read as what
contacts exchange, loading and unloading both counted. By the other two readings each claim is judged as well, beside.
"""

import math
from collections.abc import Iterator
from functools import partial

from drumrs.analysis import mean_of
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.claims import why
from drumrs.paper.claims.criteria import (
    CIRCULATING,
    FALLS,
    RISES,
    Claim,
    Condition,
    is_constant,
    is_monotonic,
    stays_within,
    within,
)
from drumrs.paper.curves import Curve, Results
from drumrs.paper.verdict import Finding

CIRCULATION = "specific_angular_momentum"
# "Rises steeply" from about 1 to near 2: by half at least.
_STEEP = 0.5
_LEVEL_WITH_BAFFLES = 2.2

Parts = Iterator[tuple[str, Condition]]


def between_one_and_two(results: Results) -> Parts:
    """Judge C4 at every fill of both drums."""
    for drum in results.drums:
        curve = results.curve("fill", results.ratio, drum=drum)
        yield drum.name, partial(_stays, results, curve, f"N/T {curve.label}", (1.0, 2.0))


def _stays(results: Results, curve: Curve, name: str, limits: tuple[float, float]) -> Finding:
    return stays_within(curve, name, *limits, results.largest("fill", results.ratio))


def constant_with_baffles(results: Results) -> Parts:
    """Judge C5 below and above 60 % fill: "nearly constant", "about 2.2", "falls" are a part each."""
    curve = results.curve("fill", results.ratio, drum=results.baffled)
    name = "N/T with baffles"

    def about() -> Finding:
        mean = mean_of(curve.below(0.6).estimates)
        largest = results.largest("fill", results.ratio)
        return within(f"Mean of {name} below 60 % fill", mean, *(_LEVEL_WITH_BAFFLES,) * 2, largest=largest)

    def constant() -> Finding:
        return is_constant(
            curve.below(0.6), f"{name} below 60 % fill", results.largest("fill", results.ratio)
        )

    def falls() -> Finding:
        largest = results.largest("fill", results.ratio)
        return is_monotonic(curve.between(0.6), f"{name} over fill from 60 % on", FALLS, largest)

    yield "nearly constant below 60 % fill", constant
    yield "about 2.2 on average there", about
    yield "falls from 60 % fill on", falls


def rises_steeply_without_baffles(results: Results) -> Parts:
    """Judge C6 below 40 % fill, at 50 %, and between: "steeply" is by half at least, where the paper has it double."""
    curve = results.curve("fill", results.ratio)

    def near_two() -> Finding:
        largest = results.largest("fill", results.ratio)
        return within("N/T at 50 % fill", curve.at(0.5), 2.0, 2.0, largest=largest)

    name = "N/T without baffles below 40 % fill"
    yield "about 1 below 40 % fill", lambda: _stays(results, curve.below(0.4), name, (1.0, 1.0))
    yield "near 2 at 50 % fill", near_two
    yield (
        "steep from 40 to 50 % fill",
        lambda: within("Rise of N/T from 40 to 50 % fill", curve.at(0.5) - curve.at(0.4), low=_STEEP),
    )


def friction_turns_the_ratio(results: Results) -> Parts:
    """Judge C10 over the frictions at which the load circulates: where it rocks, there is no N to speak of."""
    for fill in THIRDS:
        way = FALLS if fill == max(THIRDS) else RISES
        yield (
            f"{'falls' if way == FALLS else 'rises'} at {percent(fill)} fill",
            partial(_turns, results, fill, way),
        )


def _turns(results: Results, fill: float, way: int) -> Finding:
    curve = results.curve("friction", results.ratio, fill=fill).between(circulates(results, fill), least=3)
    largest = results.largest("friction", results.ratio)
    return is_monotonic(curve, f"N/T over friction, {percent(fill)} fill", way, largest)


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
        "In both drums and at every fill, from 1 to 2, to a tenth of the greatest value shown either way.",
        "F6",
        ("fill", "N/T"),
        between_one_and_two,
        why.thin_loads_slide,
    ),
    Claim(
        "C5",
        "With baffles N/T is nearly constant, about 2.2, below 60 % fill, and falls above.",
        "To a tenth of the greatest value shown: below 60 % every N/T is their mean, and that is 2.2; from 60 % on the "
        "slope is negative, and no step between neighboring fills goes up.",
        "F6",
        ("fill", "N/T"),
        constant_with_baffles,
    ),
    Claim(
        "C6",
        "Without baffles N/T is about 1 below 40 % fill and rises steeply to near 2 at about 50 %.",
        "To a tenth of the greatest value shown: below 40 % every N/T is 1; at 50 % it is 2. From 40 to 50 % it rises "
        "by more than 0.5.",
        "F6",
        ("fill", "N/T"),
        rises_steeply_without_baffles,
        why.thin_loads_slide,
    ),
    Claim(
        "C10",
        "N/T rises with μ at 25 % and 50 % fill and falls with μ at 75 %.",
        "Over the frictions at which the load has more than half of its usual angular momentum, N/T rises at 25 and "
        "50 % and falls at 75 %: the straight line through all points does, and no step between neighboring points "
        "goes the other way by more than a tenth of the greatest value shown.",
        "F9",
        ("friction", "N/T"),
        friction_turns_the_ratio,
        why.ratio_turns_at_the_last_step,
    ),
)
