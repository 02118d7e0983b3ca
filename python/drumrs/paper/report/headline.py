"""What the study found: in plain sentences with numbers, and in one small table."""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.curves import RATIOS, Curve
from drumrs.paper.data import StudyData
from drumrs.paper.verdict import FAILS, HOLDS, UNDECIDED, MissingError, Number
from drumrs.registry import Quantity, quantity


@dataclass(frozen=True)
class Sentence:
    """A finding in words, and the figure that shows it."""

    text: str
    figure: str = ""


def count_of_verdicts(data: StudyData) -> dict[str, int]:
    """Return how many claims hold, do not hold, are undecided."""
    found = Counter(verdict.verdict for verdict in data.verdicts)
    return {outcome: found[outcome] for outcome in (HOLDS, FAILS, UNDECIDED)}


def sentences(data: StudyData) -> list[Sentence]:
    """Return the findings in words; those whose cases are missing are left out."""
    tell: tuple[Callable[[StudyData], Sentence], ...] = (_power, _peak, _fall, _ratio, _variations, _motion)
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


def _power(data: StudyData) -> Sentence:
    bare, baffled = _both(data, "fill", "drum_specific_power")
    return Sentence(
        f"At the paper’s 25 % fill and 54 rpm the drum puts {_value(bare, 0.25)} W into each kilogram of load "
        f"without baffles, and {_value(baffled, 0.25)} W with three.",
        "F5",
    )


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


def _ratio(data: StudyData) -> Sentence:
    told = []
    for curve in _both(data, "fill", RATIOS[0]):
        means = sorted((one.mean, point.x) for one, point in zip(curve.estimates, curve.points, strict=True))
        least, most = means[0], means[-1]
        told.append(
            f"{least[0]:.2f} (at {percent(least[1])} fill) to {most[0]:.2f} ({percent(most[1])}) {curve.label}"
        )
    return Sentence(
        f"Damping in normal contacts takes N/T times what sliding takes: {', and '.join(told)}.", "F6"
    )


def _variation(data: StudyData, axis: str) -> str:
    curve = data.results.curve(axis, "drum_specific_power").between(least=2)
    means = [one.mean for one in curve.estimates]
    return f"{100.0 * (max(means) - min(means)) / float(np.mean(means)):.0f} %"


def _variations(data: StudyData) -> Sentence:
    names = {"size": "the bundles’ size"}
    told = [
        f"{_variation(data, axis)} with {names.get(axis, axis)}"
        for axis in ("fill", "speed", "friction", "size", "restitution")
    ]
    return Sentence(
        "Without baffles specific power varies, greatest less least over the mean, by "
        f"{', '.join(told[:-1])} and {told[-1]}.",
        "speed",
    )


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
