"""Claims about how the load moves, and the conditions of each."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

from drumrs.analysis import Estimate, Interval
from drumrs.paper.cases import BASELINE_FILL, THIRDS, percent
from drumrs.paper.claims.criteria import (
    ABOUT,
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
    claimed,
    each_within,
    within,
)
from drumrs.paper.claims.power import POWER, over
from drumrs.paper.claims.ratio import CIRCULATION
from drumrs.paper.curves import Results
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, Finding, MissingError, Number

_HALF = 0.5
_FULL = 0.75


def rocks_then_circulates(results: Results) -> Iterator[Condition]:
    """Judge C9 at each fill of F9: at the smallest friction, and by the load's angular momentum over friction."""
    for fill in THIRDS:
        yield partial(_at_small_friction, results, fill, "normal", (-ZERO, ZERO))
        yield partial(_at_small_friction, results, fill, "sliding", (ZERO, SMALL))
        yield partial(_sets_in, results, fill)


def _at_small_friction(results: Results, fill: float, kind: str, limits: tuple[float, float]) -> Finding:
    curve = results.curve("friction", f"dissipated_{kind}_specific_power", fill=fill)
    least = curve.above(0.0).between(high=SMALL_FRICTION).points[0]
    name = f"{kind.capitalize()} over usual power at μ = {least.x:g}, {curve.label}"
    return within(name, over(least.estimate, results.usual(POWER, fill)), *limits)


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
        raise MissingError(f"frictions at which the load surely rests and surely circulates, {curve.label}")
    least, most = max(0.0, ends[0] - begins[1]), ends[1] - begins[0]
    limit = ABRUPT + 1e-9
    outcome = HOLDS if most <= limit else FAILS if least > limit else UNDECIDED
    told = f"{name}: between {least:.3g} and {most:.3g} ({claimed(high=ABRUPT)}: {ANSWERS[outcome]})."
    numbers = (Number(f"{name}, at least", least, 0.0), Number(f"{name}, at most", most, 0.0))
    return Finding(outcome, told, numbers)


def _passes(shares: Sequence[tuple[float, Interval]], level: float) -> tuple[float, float] | None:
    """Return the last friction surely below a level, and the first one above that is surely over it."""
    below = [x for x, share in shares if share.high < level]
    over = [x for x, share in shares if share.low > level and below and x > max(below)]
    return (max(below), min(over)) if over else None


def baffles_carry_the_load_round(results: Results) -> Iterator[Condition]:
    """Judge C11: carried "for most of the rotation cycle", the paper says, is a share of the time.

    What centrifuges goes with the drum over the top; what mixes less, neighbors part less.
    """
    riding, carried = (
        results.curve("fill", column, baffles=True) for column in ("along_the_rim", "carried_round")
    )
    mixed, bare = (results.curve("fill", "mixed_in_a_turn", baffles=baffles) for baffles in (True, False))
    along, over_the_top = (
        "Share of the time along the rim",
        "Share of the load carried over the top in a turn",
    )
    yield lambda: within(along, riding.at(BASELINE_FILL), low=CENTRIFUGING)
    yield lambda: within(over_the_top, carried.at(BASELINE_FILL), low=CENTRIFUGING)
    parted = "Mixing in a turn, with less without baffles"
    yield lambda: within(parted, mixed.at(BASELINE_FILL) - bare.at(BASELINE_FILL), high=0.0)


def rigid_below_the_surface(results: Results) -> Iterator[Condition]:
    """Judge C12 by speeds relative to the turning drum, deep and at the surface."""
    deep, surface = (results.curve("fill", f"{depth}_speed") for depth in ("deep", "surface"))
    name = "Speed relative to the drum, deep, over the rim's"
    yield lambda: within(name, deep.at(_FULL), 0.0, LITTLE_MOTION)
    yield lambda: within(
        "The same at the surface over that deep", surface.at(_FULL) / deep.at(_FULL), low=2.0
    )


def baffles_matter_little_above_half(results: Results) -> Iterator[Condition]:
    """Judge C13: "power" as such; "kinematics" by angular momentum, what passes over the top, and mixing."""
    for column, name in (("drum_power", "Power"), (CIRCULATION, "Angular momentum")):
        ratios = partial(_above_half, results, column, Estimate.__truediv__)
        title = f"{name} with over without baffles"
        yield partial(_each, title, ratios, (1.0 - ABOUT, 1.0 + ABOUT))
    for column, name in (
        ("carried_round", "Share carried over the top"),
        ("mixed_in_a_turn", "Mixing in a turn"),
    ):
        differences = partial(_above_half, results, column, Estimate.__sub__)
        yield partial(_each, f"{name}, with less without baffles", differences, (-ABOUT, ABOUT))


_Compared = list[tuple[str, Estimate]]


def _each(name: str, points: Callable[[], _Compared], limits: tuple[float, float]) -> Finding:
    return each_within(name, points(), *limits)


def _above_half(results: Results, column: str, f: Callable[[Estimate, Estimate], Estimate]) -> _Compared:
    """Return what a function makes of both drums, at the fills above 50 % that both have."""
    with_baffles, bare = (results.curve("fill", column, baffles=baffles) for baffles in (True, False))
    return [(percent(x), one) for x, one in with_baffles.against(bare, f) if x > _HALF]


CLAIMS = (
    Claim(
        "C9",
        "At small μ the load rocks as a rigid body: normal power zero, tangential power small but not zero; with "
        "rising μ the load abruptly starts to circulate.",
        "At 25, 50 and 75 % fill, at the smallest friction above 0 (0.05 at most), normal power is less than 1 % and "
        "tangential power from 1 to 25 % of the usual (μ = 0.5); from a tenth to half of the usual angular momentum "
        "it takes at most 0.1 in μ, as far as the frictions that were run tell.",
        "F9",
        rocks_then_circulates,
    ),
    Claim(
        "C11",
        "With baffles at 25 % fill the bundles are carried round the rim as if centrifuging; mixing is weaker than "
        "without baffles.",
        "With baffles bundles ride along the rim for more than half of the time, and more than half of the load is "
        "carried over the top in a turn; in a turn neighbors part less than without baffles.",
        "F3",
        baffles_carry_the_load_round,
    ),
    Claim(
        "C12",
        "At 75 % fill without baffles little relative motion occurs except near the free surface.",
        "Relative to the turning drum, bundles more than three diameters below the free surface are slower "
        "than a tenth of the rim, and those at the surface more than twice as fast as they.",
        "F2",
        rigid_below_the_surface,
    ),
    Claim(
        "C13",
        "Baffles have only a minor effect on power and kinematics above 50 % fill.",
        "At each fill above 50 %, power and angular momentum with over without baffles are 1 within 10 %, "
        "and the share carried over the top and the mixing in a turn differ by less than 0.1.",
        "F4",
        baffles_matter_little_above_half,
    ),
)
