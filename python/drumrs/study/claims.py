"""The paper's claims, and a verdict on each."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from drumrs.study import claims_motion, claims_power, claims_ratio
from drumrs.study.curves import Results
from drumrs.study.verdict import UNDECIDED, Condition, Finding, Verdict, settle

if TYPE_CHECKING:
    import polars as pl


@dataclass(frozen=True)
class Claim:
    """What the paper says, how that is read as numbers, where it shows, and the conditions that judge it."""

    number: str
    statement: str
    criterion: str
    figure: str
    conditions: Callable[[Results], Iterable[Condition]]


CLAIMS = (
    Claim(
        "C1",
        "Drum power peaks between 40 % and 50 % fill, with and without baffles.",
        "In both drums, the vertex of the parabola through the points within 15 % of fill of the highest "
        "lies between 40 % and 50 %.",
        "F4",
        claims_power.peaks_between_40_and_50,
    ),
    Claim(
        "C2",
        "Below 50 % fill the drum with baffles draws less power than without; at larger fills they are "
        "similar.",
        "With over without baffles, power below 50 % fill is less than 1 on average and at no fill surely "
        "more; at each fill above, 1 within 10 %.",
        "F4",
        claims_power.baffles_draw_less_below_half,
    ),
    Claim(
        "C3",
        "Specific power falls as fill rises.",
        "In both drums, the slope of specific power over fill is negative up to 40 %, from 40 to 60 %, and from "
        "60 % on, and no step between neighboring fills goes up by more than 10 % of the mean.",
        "F5",
        claims_power.specific_power_falls,
    ),
    Claim(
        "C4",
        "N/T lies between just under 1 and just over 2.",
        "In both drums and at every fill, from 1 less 10 % to 2 plus 10 %.",
        "F6",
        claims_ratio.between_one_and_two,
    ),
    Claim(
        "C5",
        "With baffles N/T is nearly constant, about 2.2, below 60 % fill, and falls above.",
        "Below 60 % every N/T is within 10 % of their mean, and that within 10 % of 2.2; from 60 % on it falls: the "
        "slope is negative, and no step between neighboring fills goes up by more than 10 % of the mean.",
        "F6",
        claims_ratio.constant_with_baffles,
    ),
    Claim(
        "C6",
        "Without baffles N/T is about 1 below 40 % fill and rises steeply to near 2 at about 50 %.",
        "Below 40 % every N/T is within 10 % of 1; at 50 % it is within 10 % of 2; from 40 to 50 % it rises "
        "by more than 0.5.",
        "F6",
        claims_ratio.rises_steeply_without_baffles,
    ),
    Claim(
        "C7",
        "Specific power varies by only about 20 % over the whole range of D/d.",
        "In both drums, greatest less least is at most 25 % of the mean, which is what rounds to 20 %.",
        "F7",
        claims_power.weak_in_size,
    ),
    Claim(
        "C8",
        "Without baffles specific power is zero at μ = 0 and about constant above μ = 0.3.",
        "At 25, 50 and 75 % fill: without friction less than 1 % of the power at μ = 0.5; from 0.3 on each "
        "within 10 % of their mean.",
        "F8",
        claims_power.constant_above_some_friction,
    ),
    Claim(
        "C9",
        "At small μ the load rocks as a rigid body: normal power zero, tangential power small but not zero; with "
        "rising μ the load abruptly starts to circulate.",
        "At 25, 50 and 75 % fill, at the smallest friction above 0 (0.05 at most), normal power is less than 1 % and "
        "tangential power from 1 to 25 % of the usual (μ = 0.5); from a tenth to half of the usual angular momentum "
        "it takes at most 0.1 in μ, as far as the frictions that were run tell.",
        "F9",
        claims_motion.rocks_then_circulates,
    ),
    Claim(
        "C10",
        "N/T rises with μ at 25 % and 50 % fill and falls with μ at 75 %.",
        "Over the frictions at which the load has more than half of its usual angular momentum, N/T rises at 25 and "
        "50 % and falls at 75 %: the straight line through all points does, and no step between neighboring points "
        "goes the other way by more than 10 % of the mean.",
        "F9",
        claims_ratio.friction_turns_the_ratio,
    ),
    Claim(
        "C11",
        "With baffles at 25 % fill the bundles are carried round the rim as if centrifuging; mixing is weaker than "
        "without baffles.",
        "With baffles bundles ride along the rim for more than half of the time, and more than half of the load is "
        "carried over the top in a turn; in a turn neighbors part less than without baffles.",
        "F3",
        claims_motion.baffles_carry_the_load_round,
    ),
    Claim(
        "C12",
        "At 75 % fill without baffles little relative motion occurs except near the free surface.",
        "Relative to the turning drum, bundles more than three diameters below the free surface are slower "
        "than a tenth of the rim, and those at the surface more than twice as fast as they.",
        "F2",
        claims_motion.rigid_below_the_surface,
    ),
    Claim(
        "C13",
        "Baffles have only a minor effect on power and kinematics above 50 % fill.",
        "At each fill above 50 %, power and angular momentum with over without baffles are 1 within 10 %, "
        "and the share carried over the top and the mixing in a turn differ by less than 0.1.",
        "F4",
        claims_motion.baffles_matter_little_above_half,
    ),
    Claim(
        "C14",
        "Fill, speed and friction matter most; bundle size and restitution matter little.",
        "Each of fill, speed and friction changes specific power, greatest less least over the mean, by "
        "more than size and restitution do, and those change it by at most 25 %.",
        "speed",
        claims_power.what_matters_most,
    ),
)


def judge(table: "pl.DataFrame") -> list[Verdict]:
    """Give a verdict on each of the paper's claims.

    A claim is judged part by part. A part is undecided where no 95 % interval decides, where cases are missing, and
    where only runs with a drifting load decide: without them its outcome would be another. One part that fails
    makes the claim fail, whatever is open elsewhere.

    Parameters
    ----------
    table
        What `measure` returned.

    Returns
    -------
    list of Verdict
        C1 to C14.
    """
    return [_judge(claim, table) for claim in CLAIMS]


def _judge(claim: Claim, table: "pl.DataFrame") -> Verdict:
    every, steady = (
        [settle(condition) for condition in claim.conditions(Results(table, steady_only=only))]
        for only in (False, True)
    )
    parts = tuple(_unless_drift_decides(*both) for both in zip(every, steady, strict=True))
    return Verdict(claim.number, claim.statement, claim.criterion, claim.figure, parts)


def _unless_drift_decides(every: Finding, steady: Finding) -> Finding:
    if every.outcome == steady.outcome:
        return every
    sentence = (
        f"{every.sentence} Drifting loads would decide: {every.outcome} with them, {steady.outcome} without."
    )
    return Finding(UNDECIDED, sentence, every.numbers)
