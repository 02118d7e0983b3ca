"""Friction and rolling on a floor: slip to roll, the incline, a stack at rest.

A tangential spring has no dashpot. Where a load Fₜ comes upon it at once it swings, with ωₜ = √(3 kₛ/m), about the
stretch that holds Fₜ, and the center with Fₜ/(m ωₜ); so speeds are met within that, and within what gravity changes in
the one step in which a change of regime falls.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import State
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at
from drumrs.verification.scenes import GRAVITY, MASS, RADIUS, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_SWING = math.sqrt(3.0) * WALL_FREQUENCY
_STEP = 1e-5


def resting(weight: float) -> float:
    """Return the gap of a disc that rests on the floor [m]: minus its overlap."""
    return -weight / scenes.WALL_STIFFNESS


def at_rest(height: ArrayLike, stiffness: ArrayLike, damping: ArrayLike, step: float) -> Array:
    """Return the force by which a contact at a height may be wrong at rest [N/m], see `stack`."""
    return np.asarray(
        theory.EPSILON * np.asarray(height) * (np.asarray(stiffness) + np.asarray(damping) / step)
    )


@case(
    "slip-to-roll",
    source="derived; a disc's 2/3, not a sphere's 5/7",
    formula="u = max(u₀ − μ g t, ⅔ u₀), loss m u₀²/6",
)
def slip_to_roll() -> Evidence:
    """A disc that slides on a floor until it rolls.

    Speed: μ g/ωₜ, the swing of the spring that holds μ m g when sliding ends, and μ g Δt. Loss: the work of μ m g over
    one step at u₀, and the energy of that swing. While it slides the tangential spring stores (μ m g)²/2 kₛ, to what
    round-off leaves of the weight: that of a disc at rest, see `stack`, and the dashpot's part of the speed along
    a floor of half length L, since a point on it, and so the normal, is known to ε L/r.
    """
    speed, friction = 0.5, 0.5
    to_roll = speed / (3.0 * friction * GRAVITY)
    config = scenes.floor(
        {"run.time_step": _STEP, "gravity": (0.0, -GRAVITY), "contact.drum.friction": friction}
    )
    state = scenes.on_the_floor([speed, 0.0], resting(MASS * GRAVITY))
    samples = 30
    run = scenes.after(config, state, 2.0 * to_roll, samples=samples)
    series = run.series
    times = series["time"].to_numpy()
    # Sampled kinetic energies are the leapfrog's: ½ m v₋ v₊, as near to ½ m u² as the speed to u.
    speeds = np.sqrt(2.0 * series["kinetic_translation"].to_numpy() / MASS)
    expected = np.maximum(speed - friction * GRAVITY * times, 2.0 / 3.0 * speed)
    allowed = friction * GRAVITY * (1.0 / _SWING + _STEP)
    found = checks("speed at sample {}", "m/s", expected, speeds, allowed)
    spin = -RADIUS * float(run.angular_velocities[0])
    found.append(Check("r ω at the end", "m/s", 2.0 / 3.0 * speed, spin, 2.0 * allowed))
    force = friction * MASS * GRAVITY
    tolerance = force * speed * _STEP + force**2 / 2.0 / scenes.WALL_STIFFNESS
    loss = scenes.last(run, "dissipated_sliding")
    found.append(Check("loss to sliding", "J/m", MASS * speed**2 / 6.0, loss, tolerance))
    stored = (
        series["elastic_tangential"].to_numpy()[1 : samples // 3] * 2.0 * scenes.WALL_STIFFNESS / force**2
    )
    found += checks("stored / ((μ m g)²/2 kₛ) at sample {}", "1", 1.0, stored, 2.0 * of_the_weight(speed))
    fine = np.linspace(0.0, 2.0, 200)
    curve = (fine, np.maximum(1.0 - fine / 3.0, 2.0 / 3.0))
    trace = Trace("", times / to_roll, speeds / speed, curve)
    return Evidence(tuple(found), Panel("t / (u₀/3 μ g)", "u / u₀", (trace,)))


def of_the_weight(speed: float) -> float:
    """Return the part of its weight by which the floor's force on a sliding disc may be wrong, for round-off."""
    damping = 2.0 * theory.damping_ratio(0.1) * math.sqrt(scenes.WALL_STIFFNESS * MASS)
    tilted = damping * speed * theory.EPSILON * scenes.FLOOR / RADIUS
    return (float(at_rest(RADIUS, scenes.WALL_STIFFNESS, damping, _STEP)) + tilted) / (MASS * GRAVITY)


@case("incline", source="derived", formula="a = ⅔ g sin α where μ ≥ ⅓ tan α, else g (sin α − μ cos α)")
def incline() -> Evidence:
    """A disc on an incline, rolling or sliding, against the slope.

    The speed reached in 0.1 s, within Fₜ/(m ωₜ) and g Δt; the disc starts without spin and with a relaxed spring.
    """
    degrees = np.arange(5.0, 90.0, 5.0)
    time, traces, found = 0.1, [], []
    for friction in (0.2, 0.5):
        slope = np.radians(degrees)
        expected = _down_the_slope(slope, friction)
        seen = np.array([_acceleration(angle, friction, time) for angle in slope])
        held = np.minimum(np.sin(slope) / 3.0, friction * np.cos(slope))
        allowed = (held / _SWING + _STEP) / time
        places = [f"a/g at {angle:.0f}°, μ = {friction:g}" for angle in degrees]
        found += checks_at(places, expected, seen, allowed)
        fine = np.linspace(0.0, 89.0, 300)
        curve = (fine, _down_the_slope(np.radians(fine), friction))
        traces.append(Trace(f"μ = {friction:g}", degrees, seen, curve))
    return Evidence(tuple(found), Panel("slope α [°]", "acceleration / g", tuple(traces)))


def _down_the_slope(slope: Array, friction: float) -> Array:
    rolling = 2.0 / 3.0 * np.sin(slope)
    sliding = np.sin(slope) - friction * np.cos(slope)
    return np.maximum(rolling, sliding)


def _acceleration(slope: float, friction: float, time: float) -> float:
    """Return the mean acceleration from rest over g."""
    pull = (GRAVITY * math.sin(slope), -GRAVITY * math.cos(slope))
    config = scenes.floor({"run.time_step": _STEP, "gravity": pull, "contact.drum.friction": friction})
    state = scenes.on_the_floor([0.0, 0.0], resting(MASS * GRAVITY * math.cos(slope)))
    run = scenes.after(config, state, time)
    return float(run.velocities[0, 0]) / run.time / GRAVITY


@case("stack", source="statics", formula="δ = weight above / k")
def stack() -> Evidence:
    """A stack of eight discs at rest: overlap at each level.

    At rest the scheme errs by the round-off of positions alone. A height y is right to its last place, ε y, which makes
    a force of ε y k; and a speed below ½ ε y/Δt moves nothing, so that the dashpot may hold ν ε y/Δt for good.
    """
    count = 8
    config = scenes.floor({"run.time_step": TIME_STEP, "gravity": (0.0, -GRAVITY)})
    heights = RADIUS * (1.0 + 2.0 * np.arange(count))
    state = State(np.column_stack([np.zeros(count), heights]))
    run = scenes.after(config, state, 0.3)
    places = run.positions[:, 1]
    overlaps = np.concatenate([[RADIUS - places[0]], 2.0 * RADIUS - np.diff(places)])
    stiffness = np.where(np.arange(count) == 0, scenes.WALL_STIFFNESS, scenes.PAIR_STIFFNESS)
    carried = (count - np.arange(count)) * MASS * GRAVITY
    masses = np.where(np.arange(count) == 0, MASS, MASS / 2.0)
    damping = 2.0 * theory.damping_ratio(0.1) * np.sqrt(stiffness * masses)
    allowed = at_rest(places, stiffness, damping, TIME_STEP)
    levels = [f"k δ/m g at level {k}" for k in range(1, count + 1)]
    weight = MASS * GRAVITY
    found = checks_at(levels, carried / weight, overlaps * stiffness / weight, allowed / weight)
    trace = Trace("", np.arange(1, count + 1), overlaps * stiffness / weight, ([1, count], [count, 1]))
    return Evidence(tuple(found), Panel("level", "k δ / m g", (trace,)))


CASES = (slip_to_roll, incline, stack)
