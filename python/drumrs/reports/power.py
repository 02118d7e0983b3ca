"""Sections on power and energy: what the drum gives, where it goes, phase by phase, and whether it all adds up."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis import Mean, phases
from drumrs.config.load import SOLID_FRACTION
from drumrs.energies import powers_to_show
from drumrs.errors import ConfigError
from drumrs.measures import flight, morrell, unbalance, wall_slip
from drumrs.measures.frame_window import within
from drumrs.registry import quantity
from drumrs.reports.content import Picture, Table, measured, value

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

    from drumrs.frames import Frames
    from drumrs.reports.content import Block
    from drumrs.reports.material import Material

# Phases of a program that a page lists.
_MOST_PHASES = 24
# The records that split what contacts took, by what of them adds up to it.
_SPLITS = {"contacts": "dissipated_", "ledger_split": "dissipated_", "discs": "received_"}


def power(of: "Material") -> "Iterator[Block]":
    """Write what the drum gives, and what takes it."""
    summary = of.summary
    error = summary.drum_specific_power_error
    found = {
        "drum_specific_power": Mean(summary.drum_specific_power, error),
        "drum_power": Mean(summary.drum_power, error and error * of.mass),
        "drum_torque": Mean(summary.drum_torque, None),
        "dissipated_normal_power": Mean(summary.dissipated_normal_power, None),
        "dissipated_sliding_power": Mean(summary.dissipated_sliding_power, None),
    }
    for name in ("dissipated_tangential_power", "dissipated_rolling_power"):
        if getattr(summary, name):
            found[name] = Mean(getattr(summary, name), None)
    yield measured(
        found, "Per meter of depth: times the depth of the drum, each is the machine’s. W/kg needs no depth."
    )


def beside_the_c_model(of: "Material") -> "Iterator[Block]":
    """Write power, toe and shoulder beside those of Morrell's C-model."""
    speed, radius, load = of.require_speed(), of.config.drum.area_diameter / 2.0, of.config.load
    if not of.gravity:
        raise ConfigError("gravity", 0.0, "more than 0, to compare with the C-model")
    filling = load.bulk_fill or of.summary.fill / (load.solid_fraction or SOLID_FRACTION)
    critical = speed * math.sqrt(radius / of.gravity)
    model, ours = morrell.charge(filling, critical), of.charge
    scale = of.mass * of.gravity * radius * speed
    own, error = abs(of.summary.drum_power), of.summary.drum_specific_power_error
    rows = [
        ("power [W/m]", value(own, error and error * of.mass), value(model.arm * scale)),
        (
            "arm: power over M g R Ω",
            value(own / scale, error and error * of.mass / scale),
            value(model.arm),
        ),
    ]
    for name, angle in (("toe", model.toe), ("shoulder", model.shoulder)):
        mean = ours[f"{name}_angle"]
        shown = value(math.degrees(mean.value), mean.error and math.degrees(mean.error))
        rows.append((f"{name} [°]", shown, value(math.degrees(angle))))
    yield Table(
        ("", "this run", "C-model"),
        rows,
        f"Filling J = {100.0 * filling:.3g} %, {100.0 * critical:.3g} % of the critical speed √(g/R). Angles are "
        "counter-clockwise from the horizontal, of a mill that turns counter-clockwise.",
    )
    yield (
        "Morrell’s C-model (Trans. Inst. Min. Metall. C 105 (1996) 43 and 54) was fitted to wet industrial mills, "
        "which it meets within about 10 %; a dry, two-dimensional charge may well be further off. It is a line to "
        "compare with, not a law."
    )


def by_phase(of: "Material") -> "Iterator[Block]":
    """Write what the drum does in each phase of its program; nothing without one."""
    table = phases(of.result)
    if table.is_empty():
        return
    rows = []
    for row in table.head(_MOST_PHASES).iter_rows(named=True):
        span = (row["start"], row["end"])
        rubbing = [row.get(f"dissipated_{kind}_power") for kind in ("sliding", "tangential")]
        knocking = row.get("dissipated_normal_power")
        rows.append(
            (
                f"{row['phase']} {row['number']}",
                f"{span[0]:.3g}–{span[1]:.3g}",
                value(row.get("drum_specific_power"), row.get("drum_specific_power_error")),
                value(None if knocking is None else knocking / of.mass),
                value(None if rubbing[0] is None else sum(one or 0.0 for one in rubbing) / of.mass),
                *_in_phase(of, span),
            )
        )
    head = ("phase", "time [s]", "power [W/kg]", "knocking [W/kg]", "rubbing [W/kg]", "share in flight")
    more = f" The first {_MOST_PHASES} of {table.height} phases." if table.height > _MOST_PHASES else ""
    yield Table(
        (*head, "falls in a turn", "slip", "unbalance [kg]"),
        rows,
        "Knocking is what normal damping takes, rubbing what sliding and tangential damping take. Unbalance: mean of "
        f"|U| [kg m per m of depth].{more}",
    )


def _in_phase(of: "Material", span: tuple[float, float]) -> tuple[str, ...]:
    """Return share in flight, falls in a turn, slip and unbalance in a phase; dashes where it holds too few frames."""
    try:
        found = flight(of.frames, span, of.masses, of.gravity)
        found |= {"slip": wall_slip(of.frames, span) if _turns(of.frames, span) else None}
        found |= unbalance(of.frames, span, of.masses)
    except ConfigError:
        return ("–",) * 4
    shown = (found[name] for name in ("share_in_flight", "falls_per_turn", "slip", "unbalance"))
    return tuple("–" if mean is None else value(mean.value, mean.error) for mean in shown)


def _turns(frames: "Frames", span: tuple[float, float]) -> bool:
    """Tell whether the drum turns between any two frames of a time."""
    return bool(np.diff(within(frames, span).drum_angles).all())


def ledger(of: "Material") -> "Iterator[Block]":
    """Write where the energy went over the whole run, and how well it adds up."""
    from drumrs import figures

    series, summary = of.result.series, of.summary
    whole = float(series["drum_work"][-1]) or 1.0
    rows = [
        (
            quantity(name).title,
            value(float(series[name][-1])),
            f"{100.0 * float(series[name][-1]) / whole:.1f}",
        )
        for name in powers_to_show({name: series[name].to_numpy() for name in series.columns})
    ]
    yield Table(("from t = 0 to the end", "[J/m]", "share of the drum’s work [%]"), rows)
    missed, apart = (value(one, digits=2) for one in (summary.energy_residual, summary.power_disagreement))
    yield (
        f"Every joule is accounted for: what the ledger misses is at most {missed} of what passed through it, and "
        "three independent ways to the power, by torque, by energy and by angular momentum, differ by at most "
        f"{apart}, relatively. What is missing from 100 % is stored in the load, or came with its fall at the start."
    )
    checked = list(_sums(of))
    if checked:
        yield Table(
            ("record", "its sum over what contacts took, less 1"), checked, "What is recorded adds up."
        )
    starts = [each.start for each in of.config.rotation.intervals]

    def draw() -> "Figure":
        return figures.time_series(series, window=of.window, starts=starts)

    yield Picture("History", "Power, energies, residual of the ledger and center of mass over time.", draw)


def _sums(of: "Material") -> "Iterator[tuple[str, str]]":
    taken = sum((of.result.dissipated or {}).values())
    for record, start in _SPLITS.items():
        table = getattr(of.result, record)
        if table is not None and taken:
            parts = [float(table[name].sum()) for name in table.columns if name.startswith(start)]
            yield record, value(math.fsum(parts) / taken - 1.0, digits=2)
