"""The paper's claims by subject, each with the conditions that judge it, and a verdict on each."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from drumrs.paper.claims import motion, power, ratio
from drumrs.paper.claims.criteria import Claim, settle
from drumrs.paper.curves import RATIOS, Results
from drumrs.paper.drums import BAFFLED, TRIANGLES, Drum
from drumrs.paper.verdict import UNDECIDED, Finding, MissingError, OtherReading, Verdict

if TYPE_CHECKING:
    import polars as pl

__all__ = ["CLAIMS", "EVIDENCE", "Claim", "judge"]

# C1 to C14.
CLAIMS = tuple(sorted(power.CLAIMS + ratio.CLAIMS + motion.CLAIMS, key=lambda claim: int(claim.number[1:])))

# Claims that say what sentences say from which the shape of the lost baffle was inferred (`paper.baffle.sentences`):
# agreeing with them is no confirmation.
EVIDENCE = frozenset({"C1", "C2", "C3", "C4", "C5", "C7", "C11", "C13"})

_OF_RATIO = frozenset(claim.number for claim in ratio.CLAIMS)
_RATIO_NAMES = dict(zip(RATIOS, ("by gross work", "by dissipation", "by net work"), strict=True))


def judge(table: "pl.DataFrame", drum: Drum = BAFFLED) -> list[Verdict]:
    """Give a verdict on each of the paper's claims.

    A claim is judged part by part. A part holds, does not hold, or is undecided: where no 95 % interval decides, where
    cases are missing, where only runs with a drifting load decide, and where the text compares by eye and the outcome
    depends on how finely. A part that does not hold as a whole may hold over a range of the parameter: between the
    outermost of neighboring points, two at least, at each of which it surely holds.

    The claim then *holds* where all its parts do, *does not hold* where none does anywhere, *holds in part* where
    something surely holds and something surely does not, however the rest comes out, and is *undecided* otherwise.

    Parameters
    ----------
    table
        What `measure` returned.
    drum
        The drum that stands for the paper's with baffles.

    Returns
    -------
    list of Verdict
        C1 to C14.
    """
    results = Results(table, baffled=drum)
    return [_with_context(_judge(claim, results), claim, results) for claim in CLAIMS]


def _with_context(verdict: Verdict, claim: Claim, results: Results) -> Verdict:
    """Add what stands beside a verdict: other readings, why it fails where it does, whether it is evidence."""
    why = ""
    if claim.why and any(part.deviates for part in verdict.parts):
        with suppress(MissingError, ZeroDivisionError):
            why = claim.why(results)
    evidence = claim.number in EVIDENCE and _is_inferred(results)
    return replace(verdict, others=tuple(_others(claim, results)), why=why, is_evidence=evidence)


def _is_inferred(results: Results) -> bool:
    return results.baffled == BAFFLED


def _others(claim: Claim, results: Results) -> Iterator[OtherReading]:
    """Judge a claim as it may be read otherwise: N/T by other ratios, the baffles as those once assumed."""
    if claim.number in _OF_RATIO:
        for column in RATIOS[1:]:
            yield _other(_RATIO_NAMES[column], claim, replace(results, ratio=column))
    triangles_were_run = results.curve("fill", "drum_power", drum=TRIANGLES).points
    if claim.number in EVIDENCE and _is_inferred(results) and triangles_were_run:
        yield _other(TRIANGLES.name, claim, replace(results, baffled=TRIANGLES))


def _other(name: str, claim: Claim, results: Results) -> OtherReading:
    found = _judge(claim, results)
    return OtherReading(name, found.verdict, found.where)


def _judge(claim: Claim, results: Results) -> Verdict:
    every, steady = (
        [settle(*condition) for condition in claim.conditions(replace(results, steady_only=only))]
        for only in (False, True)
    )
    parts = tuple(_unless_drift_decides(*both) for both in zip(every, steady, strict=True))
    return Verdict(claim.number, claim.statement, claim.criterion, claim.figure, parts)


def _unless_drift_decides(every: Finding, steady: Finding) -> Finding:
    """Leave open what has another outcome without the runs that drift, as a whole or piece by piece."""
    alone = {(piece.low, piece.high): piece.outcome for piece in steady.pieces}
    pieces = tuple(
        piece if alone.get((piece.low, piece.high)) == piece.outcome else replace(piece, outcome=UNDECIDED)
        for piece in every.pieces
    )
    every = replace(every, pieces=pieces)
    if every.outcome == steady.outcome:
        return every
    sentence = (
        f"{every.sentence} Drifting loads would decide: {every.outcome} with them, {steady.outcome} without."
    )
    return replace(every, outcome=UNDECIDED, sentence=sentence)
