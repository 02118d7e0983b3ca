"""Claims about how the load moves, and the conditions of each."""

from collections.abc import Iterator, Sequence
from functools import partial

from drumrs.analysis import Interval
from drumrs.paper.cases import BASELINE_FILL, THIRDS
from drumrs.paper.claims import why
from drumrs.paper.claims.criteria import (
    ABRUPT,
    ANSWERS,
    CENTRIFUGING,
    CIRCULATING,
    LITTLE_MOTION,
    SMALL,
    SMALL_FRICTION,
    STILL,
    ZERO,
    Claim,
    Condition,
    all_of,
    at_fills,
    band,
    claimed,
    within,
)
from drumrs.paper.claims.power import POWER, over, similar_above_half
from drumrs.paper.claims.ratio import CIRCULATION
from drumrs.paper.curves import Curve, Results
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, Band, Finding, Number

_FULL = 0.75

Parts = Iterator[tuple[str, Condition]]


def rocks_then_circulates(results: Results) -> Parts:
    """Judge C9 at each fill of F9: at the smallest friction, and by the load's angular momentum over friction.

    Powers, not their ratio, and those dissipated: "relative bundle movement results in both normal and tangential power
    dissipation", says the text of what is missing at small friction.
    """
    kinds = {
        "normal power zero": ("normal", (-ZERO, ZERO)),
        "tangential power small": ("sliding", (ZERO, SMALL)),
    }
    for name, (kind, limits) in kinds.items():
        yield name, partial(_at_small_friction, results, kind, limits)
    yield (
        "circulation sets in abruptly",
        lambda: at_fills([(fill, _sets_in(results, fill)) for fill in THIRDS]),
    )


def _at_small_friction(results: Results, kind: str, limits: tuple[float, float]) -> Finding:
    found = []
    for fill in THIRDS:
        curve = results.curve("friction", f"dissipated_{kind}_specific_power", fill=fill)
        least = curve.above(0.0).between(high=SMALL_FRICTION).points[0]
        name = f"{kind.capitalize()} over usual power at μ = {least.x:g}, {curve.label}"
        found.append((fill, within(name, over(least.estimate, results.usual(POWER, fill)), *limits)))
    return at_fills(found)


def _sets_in(results: Results, fill: float) -> Finding:
    """Ask over which range of friction the load comes from rest to circulating, as narrowly as the cases tell.

    Where between two cases a level is passed is not known, so neither is the range: from the least to the greatest
    that is possible. Both within the limit is abrupt, neither is not.
    """
    curve, usual = results.curve("friction", CIRCULATION, fill=fill), results.usual(CIRCULATION, fill)
    shares = [(point.x, over(point.estimate, usual).interval()) for point in curve.points]
    begins, ends = (_passes(shares, level) for level in (STILL, CIRCULATING))
    name = f"Onset of circulation, {curve.label}, width in μ"
    if begins is None or ends is None:
        told = f"Cases are missing: frictions at which the load surely rests and surely circulates, {curve.label}."
        return Finding(UNDECIDED, told)
    least, most = max(0.0, ends[0] - begins[1]), ends[1] - begins[0]
    limit = ABRUPT + 1e-9
    outcome = HOLDS if most <= limit else FAILS if least > limit else UNDECIDED
    told = f"{name}: between {least:.3g} and {most:.3g} ({claimed(high=ABRUPT)}: {ANSWERS[outcome]})."
    numbers = (Number(f"{name}, at least", least, 0.0), Number(f"{name}, at most", most, 0.0))
    passed = Band(
        curve.axis,
        curve.column,
        curve.label,
        (begins[0], ends[1]),
        (STILL * usual,) * 2,
        (CIRCULATING * usual,) * 2,
    )
    return Finding(outcome, told, numbers, bands=(passed,), deviates=outcome == FAILS)


def _passes(shares: Sequence[tuple[float, Interval]], level: float) -> tuple[float, float] | None:
    """Return the last friction surely below a level, and the first one above that is surely over it."""
    below = [x for x, share in shares if share.high < level]
    over = [x for x, share in shares if share.low > level and below and x > max(below)]
    return (max(below), min(over)) if over else None


def baffles_carry_the_load_round(results: Results) -> Parts:
    """Judge C11: carried "for most of the rotation cycle", the paper says, is a share of the time.

    What centrifuges goes with the drum over the top; what mixes less, neighbors part less.
    """
    riding, carried, mixed = (
        results.curve("fill", column, drum=results.baffled)
        for column in ("along_the_rim", "carried_round", "mixed_in_a_turn")
    )
    bare = results.curve("fill", "mixed_in_a_turn")
    parted = "Mixing in a turn, with less without baffles"
    yield "carried along the rim", partial(_most, riding, "Share of the time along the rim")
    yield "carried over the top", partial(_most, carried, "Share of the load carried over the top in a turn")
    yield (
        "mixes less",
        lambda: within(parted, mixed.at(BASELINE_FILL) - bare.at(BASELINE_FILL), high=0.0),
    )


def _most(curve: Curve, name: str) -> Finding:
    here = band(curve.between(BASELINE_FILL, BASELINE_FILL), CENTRIFUGING, 1.0)
    return all_of([within(name, curve.at(BASELINE_FILL), low=CENTRIFUGING)], bands=(here,))


def rigid_below_the_surface(results: Results) -> Parts:
    """Judge C12 by speeds relative to the turning drum, deep and at the surface."""
    deep, surface = (results.curve("fill", f"{depth}_speed") for depth in ("deep", "surface"))

    def still() -> Finding:
        found = within("Speed relative to the drum, deep, over the rim's", deep.at(_FULL), 0.0, LITTLE_MOTION)
        return all_of([found], bands=(band(deep.between(_FULL, _FULL), 0.0, LITTLE_MOTION),))

    ratio = "Speed relative to the drum at the surface over that deep"
    yield "slow below the surface", still
    yield "faster at the surface", lambda: within(ratio, surface.at(_FULL) / deep.at(_FULL), low=2.0)


def baffles_matter_little_above_half(results: Results) -> Parts:
    """Judge C13: "power" as such; "kinematics" by angular momentum, what passes over the top, and mixing.

    The last two are shares, and read on their own scale, from 0 to 1.
    """
    for column, name in (("drum_power", "Power"), (CIRCULATION, "Angular momentum")):
        yield name.lower(), partial(similar_above_half, results, column, name)
    for column, name in (
        ("carried_round", "Share carried over the top"),
        ("mixed_in_a_turn", "Mixing in a turn"),
    ):
        yield name.lower(), partial(similar_above_half, results, column, name, 1.0)


CLAIMS = (
    Claim(
        "C9",
        "At small μ the load rocks as a rigid body: normal power zero, tangential power small but not zero; with "
        "rising μ the load abruptly starts to circulate.",
        "At 25, 50 and 75 % fill, at the smallest friction above 0 (0.05 at most), normal power is less than 1 % and "
        "tangential power from 1 to 25 % of the usual (μ = 0.5); from a tenth to half of the usual angular momentum "
        "it takes at most 0.1 in μ, as far as the frictions that were run tell.",
        "F9",
        ("friction", CIRCULATION),
        rocks_then_circulates,
        why.sliding_is_compared_with_little,
    ),
    Claim(
        "C11",
        "With baffles at 25 % fill the bundles are carried round the rim as if centrifuging; mixing is weaker than "
        "without baffles.",
        "With baffles bundles ride along the rim for more than half of the time, and more than half of the load is "
        "carried over the top in a turn; in a turn neighbors part less than without baffles.",
        "F3",
        ("fill", "carried_round"),
        baffles_carry_the_load_round,
    ),
    Claim(
        "C12",
        "At 75 % fill without baffles little relative motion occurs except near the free surface.",
        "Relative to the turning drum, bundles more than three diameters below the free surface are slower "
        "than a tenth of the rim, and those at the surface more than twice as fast as they.",
        "F2",
        ("fill", "deep_speed"),
        rigid_below_the_surface,
    ),
    Claim(
        "C13",
        "Baffles have only a minor effect on power and kinematics above 50 % fill.",
        "At each fill above 50 %, power and angular momentum of both drums differ by at most a tenth of the greatest "
        "value shown, the share carried over the top and the mixing in a turn by at most 0.1.",
        "F4",
        ("fill", "drum_power"),
        baffles_matter_little_above_half,
        why.baffles_fill_the_drum,
    ),
)
