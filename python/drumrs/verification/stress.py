"""Fields from the record of a run: the stress of a stack at rest and of a ring that turns; a load that turns as one."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import State, measures
from drumrs.measures.recorded import required
from drumrs.verification import scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, MASS, PAIR_STIFFNESS, RADIUS, WALL_STIFFNESS

Array = NDArray[np.float64]

_STACK, _RING, _CELL = 6, 20, 0.007
_FAST = 12.0


@case(
    "stress-of-a-stack",
    source="statics; Goldhirsch 2010, Weinhart 2012",
    formula="∫ σ_yy dx = weight above, ∫ σ_xx dx = 0",
    cost=1e5,
)
def stress_of_a_stack() -> Evidence:
    """A stack of six discs at the bottom of a drum at rest: what each row of cells carries, down to the wall.

    The stack starts at the overlaps that carry it. Its mean over a row is exact, for branches end at the wall: 10⁻⁶ for
    the round-off of overlaps of 10⁻⁸ m.
    """
    weight = MASS * GRAVITY
    above = weight * np.arange(_STACK, 0, -1)
    steps_up = np.array([RADIUS - above[0] / WALL_STIFFNESS, *(2.0 * RADIUS - above[1:] / PAIR_STIFFNESS)])
    heights = np.cumsum(steps_up) - DRUM_RADIUS
    changes = {"rotation.rpm": 0.0, "run.record": ["fields"], "run.cell": _CELL}
    state = State(np.column_stack([np.zeros(_STACK), heights]))
    run = scenes.after(scenes.drum(changes), state, 600 * scenes.TIME_STEP, samples=60)
    found = measures.recorded_fields(run.result().fields, 0.0)
    low, high = found.y - 0.5 * _CELL, found.y + 0.5 * _CELL
    carried = np.clip(
        np.minimum(high[:, np.newaxis], heights) - np.maximum(low, -DRUM_RADIUS)[:, np.newaxis], 0.0, None
    )
    expected = carried.sum(axis=1) * weight / _CELL
    stress = found.contact_stress if found.contact_stress is not None else np.zeros((1, 1, 2, 2))
    borne = stress[..., 1, 1].sum(axis=0) * _CELL
    rows = np.flatnonzero(expected > 0.0)
    every = rows[:: max(1, len(rows) // 8)]
    names = [f"weight above {found.y[row] + DRUM_RADIUS:.4f} m / m g" for row in every]
    results = checks_at(names, expected[every] / weight, borne[every] / weight, np.full(len(every), 1e-6))
    results.append(
        Check("greatest ∫ σ_xx dx / m g", "1", 0.0, np.abs(stress[..., 0, 0]).sum() * _CELL / weight, 1e-9)
    )
    trace = Trace(
        "",
        borne[rows] / weight,
        found.y[rows] + DRUM_RADIUS,
        (expected[rows] / weight, found.y[rows] + DRUM_RADIUS),
    )
    return Evidence(tuple(results), Panel("weight above / m g", "height [m]", (trace,)))


@case(
    "stress-of-a-ring",
    source="the virial theorem",
    formula="∫ (ρ u² + tr σ) dA = n m Ω² ρ R, of which ρ/R is motion and 1 − ρ/R contacts; no fluctuation",
    cost=1e5,
)
def stress_of_a_ring() -> Evidence:
    """A ring of discs held to the rim of a drum that turns fast, without gravity.

    The ring starts at the overlap that carries it: 10⁻⁶ for the round-off of that. Velocities are linear in place, so
    all of the motion is flow, but for what is not known of places within a cell: (side / w)² / 12 of Ω² w², 3 · 10⁻⁴,
    in a ring that is one disc thick several times that.
    """
    orbit = DRUM_RADIUS - RADIUS
    orbit /= 1.0 - MASS * _FAST**2 / WALL_STIFFNESS
    angles = math.tau / _RING * np.arange(_RING)
    places = orbit * np.column_stack([np.cos(angles), np.sin(angles)])
    velocities = _FAST * np.column_stack([-places[:, 1], places[:, 0]])
    changes = {
        "rotation.rpm": _FAST * 60.0 / math.tau,
        "gravity": (0.0, 0.0),
        "run.record": ["fields"],
        "run.cell": 0.125 * RADIUS,
    }
    state = State(places, velocities, angular_velocities=np.full(_RING, _FAST))
    run = scenes.after(scenes.drum(changes), state, 1200 * scenes.TIME_STEP, samples=60)
    table, cell = required(run.result().fields, "fields", "the flux"), (0.125 * RADIUS) ** 2
    found = measures.recorded_fields(table, 2.0 * RADIUS)
    virial = _RING * MASS * _FAST**2 * orbit * DRUM_RADIUS
    raw = measures.recorded_fields(table, 0.0)
    stress = raw.contact_stress if raw.contact_stress is not None else np.zeros((1, 1, 2, 2))
    motion = float((table["momentum_flux_xx"] + table["momentum_flux_yy"]).sum()) * cell
    share = orbit / DRUM_RADIUS
    names = ["motion / n m Ω² ρ R", "contacts / n m Ω² ρ R", "∫ρ / n m"]
    measured = [
        motion / virial,
        float(np.trace(stress, axis1=2, axis2=3).sum()) * cell / virial,
        float(found.density.sum()) * cell / (_RING * MASS),
    ]
    results = checks_at(names, [share, 1.0 - share, 1.0], measured, [1e-6, 1e-6, 1e-12])
    warm = found.fluctuation[found.density > 0.1 * found.density.max()]
    scale = (_FAST * found.width) ** 2
    results.append(Check("greatest T / Ω² w²", "1", 0.0, float(np.abs(warm).max()) / scale, 2e-3))
    row = len(found.x) // 2
    line = found.density[:, row] > 0.1 * found.density.max()
    trace = Trace("", found.x[line], found.velocity[line, row, 1], (found.x[line], _FAST * found.x[line]))
    return Evidence(tuple(results), Panel("x [m]", "u_y [m/s]", (trace,)))


CASES = (stress_of_a_stack, stress_of_a_ring)
