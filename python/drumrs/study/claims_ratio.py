"""Claims about N/T, what normal contacts take over what tangential contacts take."""

import math

from drumrs.analysis import Estimate, mean_of
from drumrs.study.cases import THIRDS
from drumrs.study.claims_power import percent, steady_level
from drumrs.study.curves import Curve, Results, slope
from drumrs.study.verdict import Finding, all_of, each_within, within
from drumrs.study.words import ABOUT, CIRCULATING

# By what damping and sliding take; work of the contact forces gives the same but for the time step's error.
RATIO = "dissipation_ratio"


def between_one_and_two(results: Results) -> Finding:
    """Judge C4 at every fill of both drums."""
    findings = []
    for baffles in (False, True):
        curve = results.curve("fill", RATIO, baffles=baffles).between()
        findings.append(each_within(f"N/T {curve.label}", _named(curve), 1.0 - ABOUT, 2.0 * (1.0 + ABOUT)))
    return all_of(findings)


def _named(curve: Curve) -> list[tuple[str, Estimate]]:
    return [(percent(point.x), point.estimate) for point in curve.points]


def constant_with_baffles(results: Results) -> Finding:
    """Judge C5 below and above 60 % fill."""
    curve = results.curve("fill", RATIO, baffles=True)
    low = curve.below(0.6)
    high = curve.between(0.6, least=2)
    level = mean_of(low.estimates)
    return all_of(
        [
            steady_level(low, "N/T with baffles below 60 % fill", "fill "),
            within("Its mean", level, 2.2 * (1.0 - ABOUT), 2.2 * (1.0 + ABOUT)),
            within("Slope of N/T over fill from 60 % on", slope(high), high=0.0),
        ]
    )


def rises_steeply_without_baffles(results: Results) -> Finding:
    """Judge C6 below 40 % fill, at 50 %, and between."""
    curve = results.curve("fill", RATIO)
    low = curve.below(0.4)
    return all_of(
        [
            each_within("N/T without baffles below 40 % fill", _named(low), 1.0 - ABOUT, 1.0 + ABOUT),
            within("N/T at 50 % fill", curve.at(0.5), 2.0 * (1.0 - ABOUT), 2.0 * (1.0 + ABOUT)),
            within("Rise of N/T from 40 to 50 % fill", curve.at(0.5) - curve.at(0.4), low=0.5),
        ]
    )


def friction_turns_the_ratio(results: Results) -> Finding:
    """Judge C10 by slopes over the frictions at which the load circulates."""
    findings = []
    for fill in THIRDS:
        curve = results.curve("friction", RATIO, fill=fill).between(circulates(results, fill), least=3)
        low, high = (-math.inf, 0.0) if fill == max(THIRDS) else (0.0, math.inf)
        findings.append(within(f"Slope of N/T over friction, {curve.label}", slope(curve), low, high))
    return all_of(findings)


def circulation(results: Results, fill: float) -> Curve:
    """Return the load's angular momentum about the axis against friction, without baffles."""
    return results.curve("friction", "angular_momentum_per_mass", fill=fill)


def circulates(results: Results, fill: float) -> float:
    """Return the friction from which on the load circulates: with half of its usual angular momentum."""
    curve = circulation(results, fill)
    usual = curve.at(0.5).mean
    still = [point.x for point in curve.points if point.estimate.mean < CIRCULATING * usual]
    return min((x for x in curve.x if x > max(still, default=-1.0)), default=math.inf)
