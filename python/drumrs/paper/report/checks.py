"""What speaks for and against the numbers: ledgers, the three powers, loads that drift."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from drumrs.analysis.drift import FALSE_ALARMS
from drumrs.paper.cases import THIRDS, percent
from drumrs.paper.curves import RATIOS
from drumrs.paper.data import StudyData
from drumrs.paper.verdict import Number

if TYPE_CHECKING:
    from collections.abc import Mapping

    from drumrs.config import Config

_CASE_DIGITS = 8


@dataclass(frozen=True)
class Run:
    """A run as the report lists it.

    Attributes
    ----------
    name
        Beginning of the case's name.
    parameters
        What was varied, ready to be shown: fill, baffles, D/d, friction, restitution, speed, seed.
    power
        Specific power [W/kg] with its standard error.
    ratio
        N/T by gross work.
    residual
        What the ledger fails to account for, relative.
    disagreement
        Largest relative difference of the three powers.
    drifting
        Whether the load drifts in the window.
    reasons
        Which of its three tests say so, with numbers.
    """

    name: str
    parameters: tuple[str, ...]
    power: str
    ratio: str
    residual: float
    disagreement: float
    drifting: bool
    reasons: str


PARAMETERS = ("fill", "baffles", "D/d", "μ", "e", "rpm", "seed")


def runs(data: StudyData) -> list[Run]:
    """Return every finished run, in the table's order."""
    return [_run(row, data.configs[row["case"]]) for row in data.table.iter_rows(named=True)]


def _run(row: "Mapping[str, Any]", config: "Config") -> Run:
    return Run(
        name=row["case"][:_CASE_DIGITS],
        parameters=_parameters(config),
        power=_value(row["drum_specific_power"], row["drum_specific_power_error"]),
        ratio=_value(row[RATIOS[0]], row[f"{RATIOS[0]}_error"]),
        residual=abs(float(row["energy_residual"])),
        disagreement=abs(float(row["power_disagreement"])),
        drifting=bool(row["drifting"]),
        reasons=_reasons(row),
    )


def _parameters(config: "Config") -> tuple[str, ...]:
    contact = config.contact.bundle
    return (
        f"{100.0 * config.fill:.3g} %",
        str(config.drum.baffles.count),
        f"{config.drum.diameter / config.load.diameter:.3g}",
        f"{contact.friction:g}",
        f"{contact.restitution:g}" if contact.restitution is not None else "–",
        f"{config.rotation.rpm:g}" if config.rotation.rpm is not None else "–",
        str(config.run.seed),
    )


def _value(value: float | None, error: float | None) -> str:
    if value is None:
        return "–"
    return f"{value:.3g}" if error is None else Number("", value, error).text


_TESTS = (
    ("drift", "power changes by {:+.0%}"),
    ("share_drift", "N’s share changes by {:+.2f}"),
    ("share_switching", "N’s share differs by {:.2f} between parts of the run"),
)


def _reasons(row: "Mapping[str, Any]") -> str:
    told = [
        words.format(row[name])
        for name, words in _TESTS
        if row.get(name) is not None and row[f"{name}_significance"] < FALSE_ALARMS
    ]
    return ", ".join(told) if row["drifting"] else ""


@dataclass(frozen=True)
class Softness:
    """Specific power with softer springs over that with Table 1's, at a fill in a drum.

    Attributes
    ----------
    drum
        Its name.
    fill
        The fill, in words.
    factor
        By how much springs are softer.
    ratio
        The ratio of the two, with half its 95 % interval.
    """

    drum: str
    fill: str
    factor: float
    ratio: str


def softness(data: StudyData) -> list[Softness]:
    """Return what softer springs change, drum by drum, at the fills of the snapshots that were run with both."""
    found = []
    for drum in data.results.drums:
        used = data.results.curve("fill", "drum_specific_power", drum=drum)
        if used.softer == 1.0:
            continue
        stiff = data.results.curve("fill", "drum_specific_power", drum=drum, softer=1.0)
        ratios = [(x, ratio) for x, ratio in used.against(stiff, lambda a, b: a / b) if x in THIRDS]
        found += [
            Softness(drum.name, percent(x), used.softer, Number.of("", ratio).text) for x, ratio in ratios
        ]
    return found
