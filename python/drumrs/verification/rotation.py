"""Single discs and rings in a turning drum: equilibria and rigid rotation, which nothing may disturb."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import Simulation, State
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at, vanishing
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, MASS, RADIUS, TIME_STEP

Array = NDArray[np.float64]

# Bundles of the closed ring, and how often it turns.
_COUNT = 60
_TURNS = 1.0
# How fast the drum turns below a locked disc [rad/s], and how long [s].
_LOCKED_SPEED, _LOCKED_TIME = 1.0, 0.5


def _speed(angular_velocity: float) -> dict[str, float]:
    """Return the key of the drum's speed, given in rad/s."""
    return {"rotation.rpm": angular_velocity * 60.0 / math.tau}


@case(
    "spin-locked-disc",
    source="statics",
    formula="θ = atan μ, torque m g R sin θ, all power in sliding",
)
def spin_locked_disc() -> Evidence:
    """A disc that may not spin, at rest in a slowly turning smooth drum, against friction.

    It starts in equilibrium but for the tangential spring, which one step stretches: an impulse of μ N Δt at most is
    lacking, and the disc swings with √(g/(ℓ cos θ)), ℓ its distance from the axis, undamped. Means over the time T are
    met within that swing. Of the drum's work the part that moves the disc is not sliding, the swing times ℓ over the
    way R Ω T of the rim, nor is that of the first step, Δt/T.
    """
    frictions = np.array([0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0])
    seen = np.array([_locked(friction) for friction in frictions])
    angles = np.arctan(frictions)
    orbit = DRUM_RADIUS - RADIUS
    swing = GRAVITY * np.sin(angles) * TIME_STEP / np.sqrt(GRAVITY * orbit / np.cos(angles))
    moved = swing * orbit / (DRUM_RADIUS * _LOCKED_SPEED * _LOCKED_TIME) + TIME_STEP / _LOCKED_TIME
    found = []
    for k, (quantity, unit, expected, allowed) in enumerate(
        (
            ("angle θ", "rad", angles, swing),
            ("torque/(m g R)", "1", np.sin(angles), swing),
            ("sliding/power", "1", np.ones_like(angles), moved),
        )
    ):
        places = [f"{quantity} at μ = {friction:g}" for friction in frictions]
        found += checks_at(places, expected, seen[:, k], allowed, unit)
    fine = np.linspace(0.0, 1.05, 200)
    panel = Panel(
        "friction μ",
        "θ [rad], torque / m g R",
        (
            Trace("θ", frictions, seen[:, 0], (fine, np.arctan(fine))),
            Trace("torque", frictions, seen[:, 1], (fine, np.sin(np.arctan(fine)))),
        ),
    )
    return Evidence(tuple(found), panel)


def _locked(friction: float) -> tuple[float, float, float]:
    """Return mean angle [rad], torque over m g R, and the part of the power that is sliding."""
    changes = {**_speed(_LOCKED_SPEED), "load.spin_locked": True, "contact.drum.friction": friction}
    angle = math.atan(friction)
    orbit = DRUM_RADIUS - RADIUS + MASS * GRAVITY * math.cos(angle) / scenes.WALL_STIFFNESS
    state = State([[orbit * math.sin(angle), -orbit * math.cos(angle)]])
    run = scenes.after(scenes.drum(changes), state, _LOCKED_TIME, samples=50)
    means = run.summary((0.0, run.time))
    x, y = means.center_of_mass_x, means.center_of_mass_y
    torque = (means.drum_torque or 0.0) / (MASS * GRAVITY * DRUM_RADIUS)
    return math.atan2(x, -y), torque, means.dissipated_sliding_power / means.drum_power


@case("free-disc", source="statics", formula="ω = R Ω/(r − δ), P = 0")
def free_disc() -> Evidence:
    """A free disc at the bottom of a turning drum, spinning with the rim, takes no power; the drum is soft here.

    All forces balance at the start, so round-off alone is left: n ε of m g R Ω and of the spin over n steps.
    """
    stiffness, speed, steps = 1e4, 2.0, 100_000
    changes = {**_speed(speed), "contact.drum.normal_stiffness": stiffness, "run.time_step": 1.5e-5}
    overlap = MASS * GRAVITY / stiffness
    spin = speed * DRUM_RADIUS / (RADIUS - overlap)
    state = State([[0.0, -(DRUM_RADIUS - RADIUS + overlap)]], angular_velocities=[spin])
    run = scenes.after(scenes.drum(changes), state, steps * 1.5e-5, samples=40)
    scale = MASS * GRAVITY * DRUM_RADIUS * speed
    allowed = steps * theory.EPSILON
    found = (
        Check("P/(m g R Ω)", "1", 0.0, run.summary((0.0, run.time)).drum_power / scale, allowed),
        Check("spin/(R Ω/(r − δ))", "1", 1.0, float(run.angular_velocities[0]) / spin, allowed),
        Check("x/R", "1", 0.0, float(run.positions[0, 0]) / DRUM_RADIUS, allowed),
    )
    times, power = (run.series[name].to_numpy() for name in ("time", "drum_power"))
    return Evidence(found, vanishing("time [s]", [Trace("power", times, power / scale / allowed)]))


def _carried(orbits: ArrayLike, angles: ArrayLike, speed: float) -> State:
    """Return discs that turn rigidly with the drum."""
    positions = np.asarray(orbits)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    velocities = speed * np.column_stack([-positions[:, 1], positions[:, 0]])
    return State(positions, velocities, angular_velocities=np.full(len(positions), speed))


@case("co-rotation", source="rigid rotation", formula="ξ = 0, ω = Ω", cost=2e7)
def co_rotation() -> Evidence:
    """A closed ring of discs, carried rigidly with the drum: no tangential spring stretches.

    Chord and arc of a step differ by (Ω Δt)²/24, so the orbits that the leapfrog keeps turn otherwise than the drum by
    that part, and speeds are off by (Ω Δt)²/24 Ω R; springs swing with that: ξ is below it over ω₀, and n ε R for
    round-off over n steps. Spins are off by ω₀ ξ/r.
    """
    found, traces = [], []
    for speed in (10.0, 20.0, 30.0):
        run = _ring(speed, _TURNS, {"gravity": (0.0, 0.0)})
        energies = run.series["elastic_tangential"].to_numpy()
        stretch = np.sqrt(2.0 * energies / scenes.PAIR_STIFFNESS)
        lag = (speed * TIME_STEP) ** 2 / 24.0
        allowed = lag * speed * DRUM_RADIUS / scenes.WALL_FREQUENCY + run.step * theory.EPSILON * DRUM_RADIUS
        place = f"at Ω = {speed:g} rad/s"
        found.append(Check(f"greatest stretch ξ {place}", "m", 0.0, float(stretch.max()), allowed))
        sliding = scenes.last(run, "dissipated_sliding")
        found.append(Check(f"loss to sliding {place}", "J/m", 0.0, sliding, 0.0))
        wrong = float(np.abs(run.angular_velocities / speed - 1.0).max())
        spin = allowed * scenes.WALL_FREQUENCY / speed / RADIUS
        found.append(Check(f"greatest |ω/Ω − 1| {place}", "1", 0.0, wrong, spin))
        turned = run.series["drum_angle"].to_numpy() / math.tau
        traces.append(Trace(f"ξ at {speed:g} rad/s", turned[::10], (stretch / allowed)[::10]))
    return Evidence(tuple(found), vanishing("turns of the drum", traces))


@case("centrifuged-ring", source="limit Ω² R > g", formula="dissipation → 0, mean torque 0", cost=2e7)
def centrifuged_ring() -> Evidence:
    """A closed ring of bundles beyond centrifuging, at several speeds: neither losses nor mean torque.

    The ring starts in equilibrium without gravity. What gravity adds to each contact is m g at most: energies of
    (m g)²/k, which swing or are lost once, so of the powers over the window's length. Each of the two contacts that a
    bundle owns may hold it.
    """
    speeds = np.array([12.0, 18.0, 24.0, 30.0])
    found: list[Check] = []
    drawn: dict[str, list[float]] = {"drum": [], "damping": [], "sliding": []}
    for speed in speeds.tolist():
        run = _ring(speed, _TURNS)
        means = run.summary((0.0, run.time))
        scale = _COUNT * MASS * GRAVITY * DRUM_RADIUS * speed
        allowed = 2.0 * _COUNT * (MASS * GRAVITY) ** 2 / scenes.PAIR_STIFFNESS / run.time / scale
        parts = {
            "drum": means.drum_power,
            "damping": means.dissipated_normal_power,
            "sliding": means.dissipated_sliding_power,
        }
        for name, power in parts.items():
            place = f"power of {name} / (M g R Ω) at Ω = {speed:g} rad/s"
            found.append(Check(place, "1", 0.0, power / scale, allowed))
            drawn[name].append(power / scale / allowed)
    froude = speeds**2 * DRUM_RADIUS / GRAVITY
    traces = [Trace(f"power of {name}", froude, values) for name, values in drawn.items()]
    return Evidence(tuple(found), vanishing("Froude number Ω² R/g", traces))


def _ring(speed: float, turns: float, changes: Mapping[str, Any] | None = None) -> Simulation:
    """Return a closed ring after some turns; it starts where springs and centrifugal force balance."""
    half = math.pi / _COUNT
    closed = RADIUS / math.sin(half)
    radius = closed + RADIUS - 1e-4 * closed
    orbit = closed
    for _ in range(50):
        neighbor = scenes.PAIR_STIFFNESS * (2.0 * RADIUS - 2.0 * orbit * math.sin(half))
        push = MASS * speed**2 * orbit + 2.0 * neighbor * math.sin(half)
        orbit += 0.5 * (radius - RADIUS + push / scenes.WALL_STIFFNESS - orbit)
    config = scenes.drum({**_speed(speed), "drum.diameter": 2.0 * radius, **(changes or {})})
    state = _carried(np.full(_COUNT, orbit), np.linspace(0.0, math.tau, _COUNT, endpoint=False), speed)
    return scenes.after(config, state, turns * math.tau / speed, samples=200)


CASES = (spin_locked_disc, free_disc, co_rotation, centrifuged_ring)
