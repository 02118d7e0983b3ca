"""Claims about how the load moves."""

from collections.abc import Callable

from drumrs.analysis import Estimate, combine
from drumrs.study.cases import BASELINE_FILL, THIRDS
from drumrs.study.claims_power import percent
from drumrs.study.claims_ratio import circulation
from drumrs.study.curves import Curve, Results
from drumrs.study.verdict import UNDECIDED, Finding, Number, all_of, each_within, within
from drumrs.study.words import (
    ABOUT,
    ABRUPT,
    CENTRIFUGING,
    CIRCULATING,
    LITTLE_MOTION,
    SMALL,
    STILL,
    ZERO,
)

_HALF = 0.5
_FULL = 0.75


def _over(one: Estimate, usual: float) -> Estimate:
    """Return an estimate over a value that stands for the usual, and whose own error is beside the point."""
    return combine(one.mean / usual, [(1.0 / usual, one)])


def rocks_then_circulates(results: Results) -> Finding:
    """Judge C9 at the smallest friction, and by the angular momentum over friction."""
    findings = []
    for fill in THIRDS:
        usual = results.curve("friction", "drum_specific_power", fill=fill).at(0.5).mean
        for kind, low, high in (("normal", -ZERO, ZERO), ("tangential", ZERO, SMALL)):
            curve = results.curve("friction", f"{kind}_specific_power", fill=fill).above(0.0)
            least = curve.points[0]
            name = f"{kind.capitalize()} over usual power at μ = {least.x:g}, {curve.label}"
            findings.append(within(name, _over(least.estimate, usual), low, high))
        findings.append(_sets_in(circulation(results, fill)))
    return all_of(findings)


def _sets_in(curve: Curve) -> Finding:
    """Ask over which range of friction the load comes from rest to circulating."""
    usual = curve.at(0.5).mean
    shares = [(point.x, _over(point.estimate, usual).interval()) for point in curve.points]
    still = [x for x, share in shares if share.high < STILL]
    going = [x for x, share in shares if share.low > CIRCULATING]
    name = f"Onset of circulation, {curve.label}"
    if not still or not going or min(going) < max(still):
        return Finding(
            UNDECIDED, f"{name}: no friction at which the load surely rests, below those at which not."
        )
    step = min(going) - max(still)
    between = [x for x, _ in shares if max(still) < x < min(going)]
    number = Number(f"{name}, width in μ", step, 0.0)
    if step > ABRUPT + 1e-9 and not between:
        return Finding(
            UNDECIDED,
            f"{name}: between μ = {max(still):g} and {min(going):g}, with no case there.",
            (number,),
        )
    return within(name + ", width in μ", Estimate(step, 0.0, 1), 0.0, ABRUPT + 1e-9)


def baffles_carry_the_load_round(results: Results) -> Finding:
    """Judge C11 by what passes over the top, and by how far neighbors part."""
    carried = results.curve("fill", "carried_round", baffles=True).at(BASELINE_FILL)
    mixed, bare = (
        results.curve("fill", "mixed_in_a_turn", baffles=baffles).at(BASELINE_FILL)
        for baffles in (True, False)
    )
    return all_of(
        [
            within("Share of the load carried over the top in a turn", carried, low=CENTRIFUGING),
            within("Mixing in a turn, with less without baffles", mixed - bare, high=0.0),
        ]
    )


def rigid_below_the_surface(results: Results) -> Finding:
    """Judge C12 by speeds relative to the turning drum, deep and at the surface."""
    deep = results.curve("fill", "deep_speed").at(_FULL)
    surface = results.curve("fill", "surface_speed").at(_FULL)
    return all_of(
        [
            within("Speed relative to the drum, deep, over the rim's", deep, 0.0, LITTLE_MOTION),
            within("The same at the surface over that deep", surface / deep, low=2.0),
        ]
    )


def baffles_matter_little_above_half(results: Results) -> Finding:
    """Judge C13 by power and angular momentum, carrying and mixing."""
    findings = []
    for column, name in (("drum_power", "Power"), ("angular_momentum_per_mass", "Angular momentum")):
        ratios = [(x, one) for x, one in _both(results, column, Estimate.__truediv__) if x > _HALF]
        named = [(percent(x), one) for x, one in ratios]
        findings.append(each_within(f"{name} with over without baffles", named, 1.0 - ABOUT, 1.0 + ABOUT))
    for column, name in (
        ("carried_round", "Share carried over the top"),
        ("mixed_in_a_turn", "Mixing in a turn"),
    ):
        differences = [(percent(x), one) for x, one in _both(results, column, Estimate.__sub__) if x > _HALF]
        findings.append(each_within(f"{name}, with less without baffles", differences, -ABOUT, ABOUT))
    return all_of(findings)


def _both(
    results: Results, column: str, f: Callable[[Estimate, Estimate], Estimate]
) -> list[tuple[float, Estimate]]:
    with_baffles, bare = (results.curve("fill", column, baffles=baffles) for baffles in (True, False))
    return with_baffles.against(bare, f)
