"""What the study found: in plain sentences with numbers, and in one small table."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from drumrs.config import baseline
from drumrs.paper.cases import BASELINE_FILL, HALF_FULL, THIRDS, percent
from drumrs.paper.curves import RATIOS, Curve
from drumrs.paper.data import StudyData
from drumrs.paper.states import two_states
from drumrs.paper.verdict import (
    FAILS,
    HOLDS,
    IN_PART,
    OUTCOMES,
    UNDECIDED,
    MissingError,
    Number,
    Verdict,
)
from drumrs.registry import Quantity, quantity


@dataclass(frozen=True)
class Sentence:
    """A finding in words, and the figure that shows it."""

    text: str
    figure: str = ""


def count_of_verdicts(verdicts: Sequence[Verdict]) -> dict[str, int]:
    """Return how many claims hold, hold in part, do not hold, are undecided."""
    found = Counter(verdict.verdict for verdict in verdicts)
    return {outcome: found[outcome] for outcome in OUTCOMES}


def takeaway(data: StudyData) -> list[str]:
    """Return what a reader takes home, in three sentences: verdicts, powers, N/T; less where cases are missing."""
    tell = (lambda data: Sentence(_counted(data.verdicts)), _powers, _exchanged)
    return [sentence.text for sentence in _told(data, tell)]


# Of one claim and of several.
_VERBS = {
    HOLDS: ("holds", "hold"),
    IN_PART: ("holds in part", "hold in part"),
    FAILS: ("does not hold", "do not hold"),
    UNDECIDED: ("is undecided", "are undecided"),
}


def _counted(verdicts: Sequence[Verdict]) -> str:
    """Tell verdicts apart by whether they could confirm anything."""
    evidence = [verdict for verdict in verdicts if verdict.is_evidence]
    others = [verdict for verdict in verdicts if not verdict.is_evidence]
    told = f"Of the paper’s {len(verdicts)} claims {_listed(verdicts)}"
    if not evidence:
        return f"{told}."
    return (
        f"{told}; {len(evidence)} of them served as evidence for the shape of the lost baffle, so that agreeing is no "
        f"confirmation, and of the other {len(others)} {_listed(others)}."
    )


def _listed(verdicts: Sequence[Verdict]) -> str:
    told = [
        f"{count} {_VERBS[outcome][count > 1]}"
        for outcome, count in count_of_verdicts(verdicts).items()
        if count
    ]
    return " and ".join([", ".join(told[:-1]), told[-1]]) if len(told) > 1 else "".join(told)


def _powers(data: StudyData) -> Sentence:
    bare, baffled = _both(data, "fill", "drum_specific_power")
    peaks = [f"{percent(_highest(curve))} fill {curve.label}" for curve in _both(data, "fill", "drum_power")]
    names = {"size": "the bundles’ size"}
    varies = [
        f"{_variation(data, axis)} with {names.get(axis, axis)}"
        for axis in ("fill", "friction", "speed", "restitution", "size")
    ]
    return Sentence(
        f"At the paper’s 25 % fill and 54 rpm the drum puts {_value(bare, BASELINE_FILL)} W into each kilogram of load "
        f"without baffles, and {_value(baffled, BASELINE_FILL)} W with three; of the fills that were run its power is "
        f"greatest at {' and at '.join(peaks)}, and without baffles specific power varies, greatest less least over "
        f"the "
        f"mean, by {', '.join(varies[:-1])} and {varies[-1]}."
    )


def _exchanged(data: StudyData) -> Sentence:
    told = []
    for curve in _both(data, "fill", RATIOS[0]):
        means = sorted((one.mean, point.x) for one, point in zip(curve.estimates, curve.points, strict=True))
        (least, at_least), (most, at_most) = means[0], means[-1]
        told.append(
            f"between {least:.2f} (at {percent(at_least)} fill) and {most:.2f} ({percent(at_most)}) {curve.label}"
        )
    return Sentence(
        f"N/T, the energy that normal contacts exchange over that of tangential ones, is {' and '.join(told)}."
    )


HOW_JUDGED = (
    "A claim is judged part by part, by 95 % intervals: over seeds where there are several, over blocks of time "
    "where there is one. A part that does not hold as a whole may hold over a range of the parameter, between the "
    "outermost of neighboring points, two at least, at each of which it surely does. A claim holds in part where "
    "something surely holds and something surely does not, however the rest comes out. Undecided is what an interval "
    "reaches across, what lacks runs, what only drifting loads would decide, and what depends on how finely a figure "
    "is read: where the text compares by eye (“about”, “nearly”, “similar”), limits are widened by a tenth of the "
    "largest value that the figure shows, and what a twentieth and three twentieths would say is told, too. N/T is "
    "read as gross work; the other two readings stand beside."
)
EVIDENCE = (
    "The shape of the baffles was inferred from the claims that speak of them. That these agree with it is no "
    "confirmation: they are marked as evidence and counted apart, and what they come to with the triangles once "
    "assumed stands beside."
)


def seeds(data: StudyData) -> int:
    """Return the number of seeds of a case, but for those at the ends of curves and about half full."""
    return min(len(runs) for runs in data.seeds)


def more_seeds(data: StudyData) -> str:
    """Say which cases have more seeds, and how long they were run; nothing where none has."""
    usual = seeds(data)
    more = [runs for runs in data.seeds if len(runs) > usual]
    fills = ", ".join(f"{100.0 * fill:.3g}" for fill in HALF_FULL)
    half_full = [runs for runs in more if runs[0].load.fill in HALF_FULL and not runs[0].drum.baffles.count]
    ends = [runs for runs in more if runs not in half_full]
    told = [
        f"{where}, {len(cases[0])} seeds of {cases[0][0].run.duration:g} s"
        for where, cases in ((f"at {fills} % fill of the bare drum", half_full), ("at ends of curves", ends))
        if cases
    ]
    return f" ({'; '.join(told)})" if told else ""


def softer(data: StudyData) -> str:
    """Say how many runs, and of which length, have softer springs; nothing where none has."""
    stiff = baseline().contact.bundle.normal_stiffness
    runs = [one for one in data.configs.values() if one.contact.bundle.normal_stiffness < stiff]
    if not runs:
        return ""
    factor = stiff / runs[0].contact.bundle.normal_stiffness
    [(usual, _)] = Counter(one.run.duration for one in runs).most_common(1)
    return (
        f"; {len(runs)} of the runs, for power alone, are mostly of {usual:g} s with springs softer by "
        f"{factor:g}"
    )


def sentences(data: StudyData) -> list[Sentence]:
    """Return the findings in words; those whose cases are missing are left out."""
    tell: tuple[Callable[[StudyData], Sentence], ...] = (_peak, _fall, _motion, _states)
    return list(_told(data, tell))


def _told(data: StudyData, tell: tuple[Callable[[StudyData], Sentence], ...]) -> Iterator[Sentence]:
    for one in tell:
        try:
            yield one(data)
        except MissingError:
            continue


def _both(data: StudyData, axis: str, column: str) -> tuple[Curve, Curve]:
    bare, baffled = (data.results.curve(axis, column, drum=drum) for drum in data.results.drums)
    return bare.between(), baffled.between()


def _value(curve: Curve, x: float, unit: str = "") -> str:
    return Number.of("", curve.at(x), unit).text


def _peak(data: StudyData) -> Sentence:
    told = []
    for curve in _both(data, "fill", "drum_power"):
        x = _highest(curve)
        told.append(f"{percent(x)} {curve.label} ({_value(curve, x, 'W/m')})")
    return Sentence(
        f"Of the fills that were run, drum power is greatest at {' and at '.join(told)}.",
        "F4",
    )


def _highest(curve: Curve) -> float:
    return float(curve.x[int(np.argmax([one.mean for one in curve.estimates]))])


def _fall(data: StudyData) -> Sentence:
    told = []
    for curve in _both(data, "fill", "drum_specific_power"):
        first, last = curve.points[0].x, curve.points[-1].x
        told.append(
            f"from {_value(curve, first, 'W/kg')} at {percent(first)} fill to {_value(curve, last, 'W/kg')} "
            f"at {percent(last)} {curve.label}"
        )
    return Sentence(f"Specific power goes {', and '.join(told)}.", "F5")


def _states(data: StudyData) -> Sentence:
    half = next(one for one in two_states(data) if one.fill == HALF_FULL[1])
    told = []
    for name, state in (
        ("a ring that the drum carries round", half.ring),
        ("a load that circulates", half.circulating),
    ):
        if state is None:
            continue
        lasts = f"for {state.residence:.0f} s at a time" if state.residence else "to the end of every run"
        ratio, power = Number.of("", state.ratio).text, Number.of("", state.power, "W/kg").text
        told.append(f"{name}, {lasts}, with {power} and N/T {ratio}")
    share = f"{100.0 * half.share:.0f} % of the time"
    runs = f"{len(half.runs)} runs without baffles"
    return Sentence(f"At 50 % fill it is, in {runs}, {share} a ring: {'; and '.join(told)}.", "states")


def _variation(data: StudyData, axis: str) -> str:
    curve = data.results.curve(axis, "drum_specific_power").between(least=2)
    means = [one.mean for one in curve.estimates]
    return f"{100.0 * (max(means) - min(means)) / float(np.mean(means)):.0f} %"


def _motion(data: StudyData) -> Sentence:
    bare, baffled = _both(data, "fill", "carried_round")
    return Sentence(
        "In a turn of the drum at 25 % fill, the share of the load that is carried over the top is "
        f"{_value(bare, 0.25)} without baffles and {_value(baffled, 0.25)} with them.",
        "F3",
    )


@dataclass(frozen=True)
class Line:
    """A row of the headline table: a quantity, and its value without and with baffles at each fill."""

    quantity: Quantity
    values: tuple[str, ...]


_LINES = (
    "drum_specific_power",
    "drum_power",
    *RATIOS,
    "along_the_rim",
    "carried_round",
    "mixed_in_a_turn",
)


def table(data: StudyData) -> list[Line]:
    """Return the headline table: three fills, without and with baffles each; a dash where a case is missing."""
    lines = []
    for column in _LINES:
        curves = [data.results.curve("fill", column, drum=drum) for drum in data.results.drums]
        values = tuple(_or_dash(curve, fill) for fill in THIRDS for curve in curves)
        lines.append(Line(quantity(column), values))
    return lines


def _or_dash(curve: Curve, fill: float) -> str:
    try:
        return _value(curve, fill)
    except MissingError:
        return "–"
