"""Rolling resistance: a constant torque while a disc rolls, a rotational spring while it rests.

With the moment M_r = μ_r r N against rolling, m v' = −Fₜ and ½ m r² ω' = r Fₜ − M_r make v' = −⅔ μ_r g on a floor: the
pull μ_r N moves half as much again as the disc's mass, for its spin. The tangential spring that holds Fₜ swings, with
ωₜ = √(3 kₛ/m), and speeds are met within Fₜ/(m ωₜ) and what changes in one step, see `friction`. Lever arms are r − δ,
δ the overlap, where the formulas have r.
"""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import State
from drumrs.verification import scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at
from drumrs.verification.friction import of_the_weight, resting
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, MASS, RADIUS, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_STEP = 1e-5
_WEIGHT = MASS * GRAVITY
_SWING = math.sqrt(3.0) * WALL_FREQUENCY
# The slower of the two frequencies of a disc whose contact neither slides nor rolls, see `stuck_swing`.
_SLOWEST = math.sqrt((5.0 - math.sqrt(17.0)) / 2.0) * WALL_FREQUENCY
_ARM = _WEIGHT / scenes.WALL_STIFFNESS / RADIUS
_AI = "Ai et al., Powder Technology 206 (2011) 269, type C"


def _law(rolling: float) -> dict[str, float]:
    # The swing doubles what friction has to hold, ⅔ μ_r N.
    return {"contact.drum.rolling_friction": rolling, "contact.drum.friction": 2.0}


@case(
    "rolling-stop",
    source=f"derived; {_AI}",
    formula="v = v₀ − ⅔ μ_r g t, stops at 3 v₀²/(4 μ_r g), loss ¾ m v₀²",
)
def rolling_stop() -> Evidence:
    """A disc that rolls on a floor until it stops, against rolling friction.

    Speed: μ_r g/ω, ω² = ½ (5 − √17) kₛ/m, the swing of a disc that has stopped; μ_r g Δt for the step in which it
    stops; of the speed δ/r and what round-off leaves of the weight, see `slip-to-roll`. Distance: that over the time.
    Loss: the work of the moment over one step at v₀, the energy (μ_r m g)²/2 kₛ of each spring, and δ/r and the
    weight's part of it. Nothing slides.
    """
    speed, frictions, found, traces = 0.5, (0.1, 0.2, 0.4), [], []
    for rolling in frictions:
        stop = 1.5 * speed / (rolling * GRAVITY)
        config = scenes.floor({"run.time_step": _STEP, "gravity": (0.0, -GRAVITY), **_law(rolling)})
        state = scenes.on_the_floor([speed, 0.0], resting(_WEIGHT), -speed / (RADIUS * (1.0 - _ARM)))
        run = scenes.after(config, state, 1.25 * stop, samples=20)
        part = _ARM + of_the_weight(speed)
        allowed = rolling * GRAVITY * (1.0 / _SLOWEST + _STEP) + speed * part
        times = run.series["time"].to_numpy()
        seen = np.sqrt(np.maximum(2.0 * run.series["kinetic_translation"].to_numpy() / MASS, 0.0))
        expected = np.maximum(speed * (1.0 - times / stop), 0.0)
        found += checks(f"speed at μ_r = {rolling:g}, sample {{}}", "m/s", expected, seen, allowed)
        way = float(run.positions[0, 0] - np.asarray(state.positions)[0, 0])
        place = f"way at μ_r = {rolling:g}"
        found.append(Check(place, "m", 0.5 * speed * stop, way, allowed * run.time))
        loss, full = scenes.last(run, "dissipated_rolling"), 0.75 * MASS * speed**2
        one_step = rolling * _WEIGHT * speed * _STEP + (rolling * _WEIGHT) ** 2 / scenes.WALL_STIFFNESS
        found.append(Check(f"loss at μ_r = {rolling:g}", "J/m", full, loss, one_step + 2.0 * part * full))
        slid = scenes.last(run, "dissipated_sliding")
        found.append(Check(f"loss to sliding at μ_r = {rolling:g}", "J/m", 0.0, slid, 0.0))
        traces.append(Trace(f"μ_r = {rolling:g}", times / stop, seen / speed))
    fine = np.linspace(0.0, 1.25, 100)
    line = Trace("", (), (), (fine, np.maximum(1.0 - fine, 0.0)))
    return Evidence(tuple(found), Panel("t / (3 v₀/2 μ_r g)", "v / v₀", (line, *traces)))


@case(
    "rolling-incline",
    source=f"derived; {_AI}",
    formula="a = ⅔ g (sin α − μ_r cos α), rests where tan α ≤ μ_r",
)
def rolling_incline() -> Evidence:
    """A disc on an incline with rolling resistance, at rest or rolling, against the slope.

    The speed reached in 0.1 s. The disc starts with relaxed springs, which swing no slower than with
    ω² = ½ (5 − √17) kₛ/m: within g sin α/ω and g Δt.
    """
    degrees, time = np.array([1.0, 3.0, 5.0, 8.0, 11.0, 11.5, 15.0, 20.0, 30.0, 40.0]), 0.1
    traces, found = [], []
    for rolling in (0.1, 0.2):
        slopes = np.radians(degrees)
        seen = np.array([_acceleration(slope, rolling, time) for slope in slopes])
        allowed = (np.sin(slopes) / _SLOWEST + _STEP) / time
        places = [f"a/g at {angle:g}°, μ_r = {rolling:g}" for angle in degrees]
        found += checks_at(places, _down_the_slope(slopes, rolling), seen, allowed)
        fine = np.linspace(0.0, 41.0, 300)
        curve = (fine, _down_the_slope(np.radians(fine), rolling))
        traces.append(Trace(f"μ_r = {rolling:g}", degrees, seen, curve))
    return Evidence(tuple(found), Panel("slope α [°]", "acceleration / g", tuple(traces)))


def _down_the_slope(slope: Array, rolling: float) -> Array:
    return np.maximum(2.0 / 3.0 * (np.sin(slope) - rolling * np.cos(slope)), 0.0)


def _acceleration(slope: float, rolling: float, time: float) -> float:
    """Return the mean acceleration from rest over g."""
    pull = (GRAVITY * math.sin(slope), -GRAVITY * math.cos(slope))
    config = scenes.floor({"run.time_step": _STEP, "gravity": pull, **_law(rolling)})
    state = scenes.on_the_floor([0.0, 0.0], resting(_WEIGHT * math.cos(slope)))
    run = scenes.after(config, state, time)
    return float(run.velocities[0, 0]) / run.time / GRAVITY


@case(
    "rolling-in-a-drum",
    source=f"statics; {_AI}",
    formula="tan θ = μ_r, ω = Ω R/r, T = μ_r N (R − r), loss μ_r N r (ω − Ω) = T Ω",
)
def rolling_in_a_drum() -> Evidence:
    """A disc that keeps its place in a turning smooth drum by rolling resistance alone, against it.

    It starts in equilibrium but for the two springs: an impulse of Fₜ (Δt + 1/ωₜ) at most is lacking, Fₜ = m g sin θ,
    and the disc swings with √(⅔ g/(ℓ cos θ)), ℓ = R − r, undamped. Means over the time T are met within that swing, the
    spin within that speed. Of the drum's work the part that moves the disc is not lost, the swing times ℓ over the way
    Ω (R − r) T that the disc rolls, nor is that of the first step and of filling the springs.
    """
    frictions = np.array([0.02, 0.05, 0.1, 0.2, 0.35, 0.5])
    seen = np.array([_carried(rolling) for rolling in frictions])
    angles, orbit = np.arctan(frictions), DRUM_RADIUS - RADIUS
    late = GRAVITY * np.sin(angles) * (TIME_STEP + 1.0 / _SWING)
    swing = late / np.sqrt(2.0 / 3.0 * GRAVITY * orbit / np.cos(angles)) + _ARM
    part = swing / _TIME + (TIME_STEP + 1.0 / _SWING) / _TIME
    found = []
    for k, (quantity, unit, expected, allowed) in enumerate(
        (
            ("angle θ", "rad", angles, swing),
            ("torque/(m g (R − r))", "1", np.sin(angles), swing),
            ("spin/(Ω R/r)", "1", np.ones_like(angles), late / (DRUM_RADIUS * _SPEED) + _ARM),
            ("loss to rolling/power", "1", np.ones_like(angles), part),
            ("loss to sliding", "J/m", np.zeros_like(angles), 0.0),
        )
    ):
        places = [f"{quantity} at μ_r = {rolling:g}" for rolling in frictions]
        found += checks_at(places, expected, seen[:, k], allowed, unit)
    fine = np.linspace(0.0, 0.52, 200)
    traces = (
        Trace("θ", frictions, seen[:, 0], (fine, np.arctan(fine))),
        Trace("torque", frictions, seen[:, 1], (fine, np.sin(np.arctan(fine)))),
    )
    return Evidence(tuple(found), Panel("rolling friction μ_r", "θ [rad], torque / m g (R − r)", traces))


# How fast the drum turns below the disc [rad/s], and how long [s].
_SPEED, _TIME = 1.0, 0.5


def _carried(rolling: float) -> tuple[float, float, float, float, float]:
    """Return mean angle [rad], torque over m g (R − r), spin over Ω R/r, share of the power, loss to sliding."""
    changes = {"rotation.rpm": _SPEED * 60.0 / math.tau, **_law(rolling)}
    angle = math.atan(rolling)
    overlap = _WEIGHT * math.cos(angle) / scenes.WALL_STIFFNESS
    orbit, spin = DRUM_RADIUS - RADIUS + overlap, _SPEED * DRUM_RADIUS / (RADIUS - overlap)
    state = State([[orbit * math.sin(angle), -orbit * math.cos(angle)]], angular_velocities=[spin])
    run = scenes.after(scenes.drum(changes), state, _TIME, samples=50)
    means = run.summary((0.0, run.time))
    x, y = means.center_of_mass_x, means.center_of_mass_y
    lost = scenes.last(run, "dissipated_rolling") / scenes.last(run, "drum_work")
    return (
        math.atan2(x, -y),
        means.drum_torque / (_WEIGHT * (DRUM_RADIUS - RADIUS)),
        float(run.angular_velocities[0]) / (_SPEED * DRUM_RADIUS / RADIUS),
        lost,
        scenes.last(run, "dissipated_sliding"),
    )


@case(
    "stuck-swing",
    source="derived, k_r = kₛ r²: x'' = −(x + y) kₛ/m, y'' = −2 (x + 2 y) kₛ/m with y = r φ",
    formula="ω² = ½ (5 ∓ √17) kₛ/m",
)
def stuck_swing() -> Evidence:
    """A disc that swings on a floor without sliding or rolling, in either of its two modes.

    The springs' energies over six periods, at a quarter of Table 1's time step: with θ = ω Δt the leapfrog swings too
    fast by θ²/24, and energies, which go with twice the phase, are off by that over the time and by θ² of themselves;
    and by δ/r, in frequency too. Nothing is lost.
    """
    step, found, traces = TIME_STEP / 4.0, [], []
    for sign in (-1.0, 1.0):
        square = (5.0 + sign * math.sqrt(17.0)) / 2.0
        frequency, share = math.sqrt(square) * WALL_FREQUENCY, square - 1.0
        # y = share · x; a quarter of the stretch at which either spring yields.
        stretches = np.array([1.0 + share, share])
        stretches *= 0.125 * _WEIGHT / scenes.WALL_STIFFNESS / np.abs(stretches).max()
        speed = frequency * stretches[1] / share
        config = scenes.floor({"run.time_step": step, "gravity": (0.0, -GRAVITY), **_law(0.5)})
        # A disc that rolls to the right turns clockwise: y grows with its spin where x + y is the slip.
        state = scenes.on_the_floor([speed, 0.0], resting(_WEIGHT), share * speed / RADIUS)
        time = 6.0 * math.tau / frequency
        run = scenes.after(config, state, time, samples=math.ceil(time / step))
        times = run.series["time"].to_numpy()
        phase = frequency * step
        allowed = phase**2 * (1.0 + frequency * time / 12.0) + 2.0 * _ARM * frequency * time
        for column, stretch in zip(("elastic_tangential", "elastic_rolling"), stretches, strict=True):
            seen = run.series[column].to_numpy() / (0.5 * scenes.WALL_STIFFNESS * stretch**2)
            expected = np.sin(frequency * times) ** 2
            name = f"{column} over its greatest, mode {1.5 + sign / 2.0:.0f}, sample {{}}"
            found += checks(name, "1", expected[::7], seen[::7], allowed)
            traces.append(Trace(f"{column}, mode {1.5 + sign / 2.0:.0f}", frequency * times[::7], seen[::7]))
        for loss in ("dissipated_sliding", "dissipated_rolling"):
            found.append(
                Check(f"{loss}, mode {1.5 + sign / 2.0:.0f}", "J/m", 0.0, scenes.last(run, loss), 0.0)
            )
    fine = np.linspace(0.0, 6.0 * math.tau, 600)
    line = Trace("", (), (), (fine, np.sin(fine) ** 2))
    return Evidence(tuple(found), Panel("ω t", "energy / its greatest", (line, *traces)))


CASES = (rolling_stop, rolling_incline, rolling_in_a_drum, stuck_swing)
