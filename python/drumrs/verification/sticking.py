"""The dashpot beside the tangential spring: how a contact that sticks swings out.

What discs oppose to a tangential force at their rims is a third of their effective mass, mₜ = m*/3, so that the slip u
of a contact obeys u'' + 2 ζₜ ωₜ u' + ωₜ² u = 0 with ωₜ = √(kₛ/mₜ) and the damping ratio ζₜ that is given.
"""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Simulation, State
from drumrs.verification import scenes, theory
from drumrs.verification.advance import advance
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at
from drumrs.verification.scenes import PAIR_FREQUENCY, RADIUS, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_STEP = TIME_STEP / 4.0
_RATIOS = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.5])
_FINE = np.linspace(0.0, 0.55, 200)
_SWING = math.sqrt(3.0) * PAIR_FREQUENCY


def _decay(ratio: float | Array) -> Array:
    """Return the logarithmic decrement of a half wave, π ζ/√(1 − ζ²)."""
    return np.asarray(math.pi * np.asarray(ratio) / np.sqrt(1.0 - np.asarray(ratio) ** 2))


@case("tangential-decrement", source="damped oscillator", formula="ln |uₖ/uₖ₊₁| = π ζₜ/√(1 − ζₜ²)")
def tangential_decrement() -> Evidence:
    """Two discs that stick to each other and spin against each other: decrement of the slip, half wave by half wave.

    Adhesion holds them together at its equilibrium. With θ = ωₜ Δt the dashpot's foretold rate lacks ⅜ θ² of itself and
    the leapfrog swings too fast by θ²/24; the slip at the end of a half wave is interpolated between steps, ⅛ θ² of it:
    θ² of a decrement of π at most.
    """
    phase = _SWING * _STEP
    found: list[Check] = []
    traces: list[Trace] = []
    for ratio in _RATIOS.tolist():
        waves = min(5, int(1.0 / ratio))
        times, slips = _spun(ratio, waves)
        ends = np.arange(waves + 1) * math.pi / (_SWING * math.sqrt(1.0 - ratio**2))
        seen = np.log(np.abs(np.interp(ends, times, slips)))
        places = [f"decrement at ζ = {ratio:g}, half wave {k}" for k in range(1, waves + 1)]
        found += checks_at(places, _decay(ratio), seen[:-1] - seen[1:], math.pi * phase**2)
        traces.append(Trace("", np.full(waves, ratio), -np.diff(seen)))
    curve = Trace("", (), (), (_FINE, _decay(_FINE)))
    return Evidence(tuple(found), Panel("damping ratio ζₜ", "decrement of a half wave", (curve, *traces)))


def _spun(ratio: float, waves: int) -> tuple[Array, Array]:
    """Return times [s] and slips [m/s], step by step, of two discs that are held together and spin alike."""
    friction, pull = 0.5, 4.0
    law = {"adhesion": pull, "friction": friction, "tangential_damping_ratio": ratio}
    changes = {f"contact.bundle.{key}": value for key, value in law.items()}
    # A quarter of the stretch at which the contact slides.
    speed = 0.25 * friction * pull / scenes.PAIR_STIFFNESS * _SWING
    half = RADIUS - 0.5 * pull / scenes.PAIR_STIFFNESS
    state = State([[-half, 0.0], [half, 0.0]], angular_velocities=[0.5 * speed / half] * 2)
    run = scenes.after(scenes.free_space({"run.time_step": _STEP, **changes}), state, 0.0)
    steps = math.ceil((waves + 0.5) * math.pi / (_SWING * math.sqrt(1.0 - ratio**2)) / _STEP)
    seen = [(run.time, _slip(run))]
    for _ in range(steps):
        advance(run, 1)
        seen.append((run.time, _slip(run)))
    times, slips = np.array(seen).T
    # The slip at the start was the spins' alone.
    return np.concatenate([[0.0], times]), np.concatenate([[-speed], slips])


def _slip(run: Simulation) -> float:
    """Return how fast the two discs slip on each other [m/s]."""
    apart = run.positions[1] - run.positions[0]
    distance = float(np.hypot(*apart))
    velocity = run.velocities[1] - run.velocities[0]
    along = (apart[0] * velocity[1] - apart[1] * velocity[0]) / distance
    return float(along - 0.5 * distance * run.angular_velocities.sum())


@case(
    "tangential-restitution",
    source="damped oscillators, kₛ/kₙ = 1/3: both half waves coincide",
    formula="s'/s = −exp(−π ζ/√(1 − ζ²))",
)
def tangential_restitution() -> Evidence:
    """Slip after an oblique impact that sticks, with the same damping ratio along normal and tangent.

    Mean over 400 onsets at a quarter of Table 1's time step: θ² + θ/400 of the slip, and π times δ/r for the lever arm.
    """
    onsets, closing, slip, measured = 400, 0.01, 0.01, []
    for ratio in _RATIOS.tolist():
        law = {"friction": 1e6, "stiffness_ratio": 1.0 / 3.0, "tangential_damping_ratio": ratio}
        changes = {f"contact.drum.{key}": value for key, value in law.items()}
        config = scenes.floor({"run.time_step": _STEP, **scenes.damping(ratio), **changes})
        gaps = (1.0 + scenes.phases(onsets)) * _STEP * closing
        run = scenes.after(config, scenes.on_the_floor([slip, -closing], gaps), 6e-4)
        after = run.velocities[:, 0] + RADIUS * run.angular_velocities
        measured.append(float(after.mean()) / slip)
    arm = math.pi * closing / WALL_FREQUENCY / RADIUS
    allowed = [theory.mean_error(WALL_FREQUENCY, _STEP, onsets, ratio) + arm for ratio in _RATIOS]
    places = [f"s'/s at ζ = {ratio:g}" for ratio in _RATIOS]
    found = checks_at(places, -np.exp(-_decay(_RATIOS)), measured, allowed)
    trace = Trace("", _RATIOS, measured, (_FINE, -np.exp(-_decay(_FINE))))
    return Evidence(tuple(found), Panel("damping ratio ζ", "slip after / before", (trace,)))


CASES = (tangential_decrement, tangential_restitution)
