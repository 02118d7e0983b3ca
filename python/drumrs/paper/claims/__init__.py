"""The paper's claims by subject, each with the conditions that judge it, and a verdict on each."""

from typing import TYPE_CHECKING

from drumrs.paper.claims import motion, power, ratio
from drumrs.paper.claims.criteria import Claim, settle
from drumrs.paper.curves import Results
from drumrs.paper.verdict import UNDECIDED, Finding, Verdict

if TYPE_CHECKING:
    import polars as pl

__all__ = ["CLAIMS", "Claim", "judge"]

# C1 to C14.
CLAIMS = tuple(sorted(power.CLAIMS + ratio.CLAIMS + motion.CLAIMS, key=lambda claim: int(claim.number[1:])))


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
