"""Sections on power and energy: what the drum gives, where it goes, phase by phase, and whether it all adds up."""

import math
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis import Mean, mean_with_error, phases, rate_with_error
from drumrs.config.load import SOLID_FRACTION
from drumrs.energies import powers_to_show
from drumrs.errors import ConfigError
from drumrs.measures import flight, hogg_fuerstenau, morrell, unbalance, wall_slip
from drumrs.measures.frame_window import within
from drumrs.registry import quantity
from drumrs.reports.content import Picture, Table, measured, value

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

    from drumrs.frames import Frames
    from drumrs.reports.content import Block
    from drumrs.reports.run_data import RunData

# Phases of a program that a page lists.
_MOST_PHASES = 24
# A power below this share of the greatest of all phases is none.
_NOTHING = 1e-6
# Samples of a window below which its mean has no error.
_FEWEST = 2
# The records that split what contacts took, by what of them adds up to it.
_SPLITS = {"contacts": "dissipated_", "ledger_split": "dissipated_", "discs": "received_"}


def power(of: "RunData") -> "Iterator[Block]":
    """Write what the drum gives, and what takes it."""
    summary, series, window = of.summary, of.result.series, of.window
    error = summary.drum_specific_power_error
    found = {
        "drum_specific_power": Mean(summary.drum_specific_power, error),
        "drum_power": Mean(summary.drum_power, error and error * of.mass),
        "drum_torque": Mean(summary.drum_torque, _torque_error(of)),
    }
    for name in ("normal", "sliding", "tangential", "rolling"):
        rate = rate_with_error(series, f"dissipated_{name}", window)
        if rate.value or name in ("normal", "sliding"):
            found[f"dissipated_{name}_power"] = rate
    yield measured(found, _of_the_machine(of))
    if of.config.derived.angular_velocity is None:
        yield (
            "The speed changes within the window: the errors take that for chance. Means phase by phase are sharper, "
            "and a torque that turns the load clockwise is negative."
        )


def _torque_error(of: "RunData") -> float | None:
    """Return the standard error of the mean torque, from the means between the samples of the window."""
    inside = of.result.series.filter(of.result.series["time"].is_between(*of.window))
    times, torques = (inside[name].to_numpy() for name in ("time", "drum_torque"))
    return mean_with_error(torques[1:], float(np.diff(times).mean())).error if len(times) > _FEWEST else None


def _of_the_machine(of: "RunData") -> str:
    """Say what numbers per meter of depth are for the machine."""
    depth, error = of.config.drum.depth, of.summary.drum_specific_power_error
    if depth is None:
        return "Per meter of depth: times the depth of the drum, each is the machine’s. W/kg needs no depth."
    own = value(of.summary.drum_power * depth, error and error * of.mass * depth)
    return f"Per meter of depth. With a depth of {depth:.3g} m the drum takes {own} W. W/kg needs no depth."


def beside_models(of: "RunData") -> "Iterator[Block]":
    """Write power, toe and shoulder beside those of Morrell's C-model and of Hogg and Fuerstenau's flat charge."""
    speed, radius, load = of.require_speed(), of.config.drum.area_diameter / 2.0, of.config.load
    if not of.gravity:
        raise ConfigError("gravity", 0.0, "more than 0, to compare with models of mills")
    filling = load.bulk_fill or of.summary.fill / (load.solid_fraction or SOLID_FRACTION)
    froude = speed * speed * radius / of.gravity
    model, ours = morrell.charge(filling, math.sqrt(froude)), of.charge
    slope = of.charge["surface_slope"].value
    flat = hogg_fuerstenau.arm(filling, slope)
    scale = of.mass * of.gravity * radius * speed
    own, error = abs(of.summary.drum_power), of.summary.drum_specific_power_error
    own_arm = Mean(own / scale, error and error * of.mass / scale)
    rows = [
        (
            "power [kW/m]",
            value(1e-3 * own, error and 1e-3 * error * of.mass),
            *(value(1e-3 * arm * scale) for arm in (model.arm, flat)),
        ),
        ("arm: power over M g R Ω", _shown(own_arm), value(model.arm), value(flat)),
    ]
    for name, angle in (("toe", model.toe), ("shoulder", model.shoulder)):
        rows.append((f"{name} [°]", _degrees(ours[f"{name}_angle"]), value(math.degrees(angle)), "–"))
    rows.append(("surface slope, lift angle α [°]", _degrees(ours["surface_slope"]), "–", "this run’s"))
    yield Table(
        ("", "this run", "Morrell", "Hogg–Fuerstenau"),
        rows,
        f"Filling J = {100.0 * filling:.3g} %, Froude number Ω²R/g = {froude:.3g}, whose root is Morrell’s φ. Angles "
        "are counter-clockwise from the horizontal, of a mill that turns counter-clockwise.",
    )
    yield (
        "Morrell’s C-model (Trans. Inst. Min. Metall. C 105 (1996) 43 and 54) was fitted to wet industrial mills, "
        "which it meets within about 10 %; a dry, two-dimensional charge may well be further off. Hogg and "
        "Fuerstenau’s formula (Trans. SME-AIME 252 (1972) 418; 0.238 D³·⁵ (L/D) φ ρ (J − 1.065 J²) sin α, in feet, "
        f"t/m³ and kW) is of a flat charge of which nothing is thrown. {_lift_angle(filling, own_arm.value)} Both are "
        "lines to compare with, not laws."
    )


def _lift_angle(filling: float, arm: float) -> str:
    try:
        angle = math.degrees(hogg_fuerstenau.lift_angle(filling, arm))
    except ConfigError:
        return "No lift angle gives this run’s power."
    return f"It gives this run’s power at a lift angle of α = {angle:.1f}°; 35° to 45° are usual."


def _shown(mean: Mean) -> str:
    return value(mean.value, mean.error)


def _degrees(mean: Mean) -> str:
    return value(math.degrees(mean.value), mean.error and math.degrees(mean.error))


def by_phase(of: "RunData") -> "Iterator[Block]":
    """Write what the drum does in each phase of its program; nothing without one."""
    table = phases(of.result)
    if table.is_empty():
        return
    rows, most = [], float(np.nanmax(np.abs(table["drum_specific_power"].to_numpy().astype(float))))
    for row in table.head(_MOST_PHASES).iter_rows(named=True):
        power, error = row.get("drum_specific_power"), row.get("drum_specific_power_error")
        if power is not None and abs(power) < _NOTHING * most:
            # A load at rest takes nothing, but for what still trembles.
            power, error = 0.0, None
        span = (row["start"], row["end"])
        rubbing = [row.get(f"dissipated_{kind}_power") for kind in ("sliding", "tangential")]
        knocking = row.get("dissipated_normal_power")
        rows.append(
            (
                f"{row['phase']} {row['number']}",
                f"{span[0]:.3g}–{span[1]:.3g}",
                value(power, error),
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


def _in_phase(of: "RunData", span: tuple[float, float]) -> tuple[str, ...]:
    """Return share in flight, falls in a turn, slip and unbalance in a phase; dashes where it holds too few frames."""
    try:
        found = flight(of.frames, span, of.masses, of.gravity)
        turns = _turns(of.frames, span)
        found |= {"slip": wall_slip(of.frames, span) if turns else None}
        found |= {} if turns else {"falls_per_turn": None}
        found |= unbalance(of.frames, span, of.masses)
    except ConfigError:
        return ("–",) * 4
    shown = (found[name] for name in ("share_in_flight", "falls_per_turn", "slip", "unbalance"))
    return tuple("–" if mean is None else value(mean.value, mean.error) for mean in shown)


def _turns(frames: "Frames", span: tuple[float, float]) -> bool:
    """Tell whether the drum turns between any two frames of a time."""
    return bool(np.diff(within(frames, span).drum_angles).all())


def ledger(of: "RunData") -> "Iterator[Block]":
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


def _sums(of: "RunData") -> "Iterator[tuple[str, str]]":
    taken = sum((of.result.dissipated or {}).values())
    for record, start in _SPLITS.items():
        table = getattr(of.result, record)
        if table is not None and taken:
            parts = [float(table[name].sum()) for name in table.columns if name.startswith(start)]
            yield record, value(math.fsum(parts) / taken - 1.0, digits=2)
