"""The eight impact tests of Chung & Ooi in their disc form: bodies against each other and against a wall.

With kₛ/kₙ = 1/3 and no damping each has a closed form, see `theory.tangential_impulse`. Forces start and end at zero,
so a single impact is met within θ² of the speeds, and within δ/r for the lever arm.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import Simulation, State
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at, shared_curve
from drumrs.verification.scenes import MASS, PAIR_FREQUENCY, RADIUS, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_FRICTION = 0.15
_CLOSING = 0.05
_STEP = TIME_STEP / 4.0
_GAP = 1e-7
_LONG = 1.5 * math.pi / WALL_FREQUENCY + _GAP / _CLOSING
_SOURCE = "Chung & Ooi, Granular Matter 13 (2011) 643, test {}, for discs"
_IMPULSE = "J = min(⅔ m* s, 2 μ m* w)"


def _allowed(frequency: float, step: float = _STEP, radius: float = RADIUS) -> float:
    """Return θ² + δ/r of an elastic impact."""
    return (frequency * step) ** 2 + _CLOSING / frequency / radius


def _half_sine(run: Simulation, frequency: float, mass: float) -> tuple[list[Check], Panel]:
    """Hold overlap and stored energy, at every fourth step, against a half sine of the springs."""
    series = run.series
    times = series["time"].to_numpy() - _GAP / _CLOSING
    overlaps = series["max_overlap_ratio"].to_numpy() * RADIUS * frequency / _CLOSING
    energies = series["elastic_normal"].to_numpy() / (mass / 2.0 * _CLOSING**2)
    times, overlaps, energies = times[::4], overlaps[::4], energies[::4]
    inside = (times > 0.0) & (times < math.pi / frequency)
    expected = np.where(inside, np.sin(frequency * times), 0.0)
    allowed = _allowed(frequency)
    found = checks("overlap ω₀ δ/v at sample {}", "1", expected, overlaps, allowed)
    found += checks("stored / ½ m* v² at sample {}", "1", expected**2, energies, 2.0 * allowed)
    fine = np.linspace(0.0, math.pi, 100)
    traces = (
        Trace("overlap ω₀ δ/v", frequency * times, overlaps, (fine, np.sin(fine))),
        Trace("stored / ½ m* v²", frequency * times, energies, (fine, np.sin(fine) ** 2)),
    )
    return found, Panel("ω₀ t since first touch", "overlap, energy", traces)


@case("two-bodies-head-on", source=_SOURCE.format(1), formula="δ = (v/ω₀) sin ω₀ t, speeds change places")
def two_bodies_head_on() -> Evidence:
    """Elastic normal impact of two bodies: overlap and stored energy over time, and speeds after it.

    θ² + δ/r of the overlap's amplitude and of the speeds, twice that of the energy.
    """
    state = State(
        positions=[[-RADIUS - _GAP / 2.0, 0.0], [RADIUS + _GAP / 2.0, 0.0]],
        velocities=[[0.9 * _CLOSING, 0.0], [-0.1 * _CLOSING, 0.0]],
    )
    config = scenes.free_space({"run.time_step": _STEP, **scenes.elastic(_FRICTION)})
    run = scenes.after(config, state, _LONG, samples=math.ceil(_LONG / _STEP))
    found, panel = _half_sine(run, PAIR_FREQUENCY, MASS / 2.0)
    speeds = run.velocities[:, 0] / _CLOSING
    found += checks(
        "speed of body {} after / closing speed", "1", [-0.1, 0.9], speeds, _allowed(PAIR_FREQUENCY)
    )
    return Evidence(tuple(found), panel)


@case("wall-head-on", source=_SOURCE.format(2), formula="δ = (v/ω₀) sin ω₀ t, the speed turns round")
def wall_head_on() -> Evidence:
    """Elastic normal impact of a body on a wall: overlap and stored energy over time, and the speed after it.

    θ² + δ/r of the overlap's amplitude and of the speed, twice that of the energy.
    """
    config = scenes.floor({"run.time_step": _STEP, **scenes.elastic(_FRICTION)})
    state = scenes.on_the_floor([0.0, -_CLOSING], _GAP)
    run = scenes.after(config, state, _LONG, samples=math.ceil(_LONG / _STEP))
    found, panel = _half_sine(run, WALL_FREQUENCY, MASS)
    speed = run.velocities[:, 1] / _CLOSING
    found += checks("speed after / before", "1", 1.0, speed, _allowed(WALL_FREQUENCY))
    return Evidence(tuple(found), panel)


@case("restitution-sweep", source=_SOURCE.format(3), formula="v' = e v")
def restitution_sweep() -> Evidence:
    """Normal impact on a wall with every restitution, prescribed.

    The dashpot's force jumps at first touch: the mean over 400 onsets is met within θ² + θ/400.
    """
    restitutions, onsets = np.linspace(0.1, 1.0, 10), 400
    measured = []
    for restitution in restitutions:
        config = scenes.floor({"run.time_step": _STEP, "contact.drum.restitution": restitution})
        state = scenes.on_the_floor([0.0, -1.0], (1.0 + scenes.phases(onsets)) * _STEP)
        measured.append(float(scenes.after(config, state, 1e-3).velocities[:, 1].mean()))
    allowed = [
        theory.mean_error(WALL_FREQUENCY, _STEP, onsets, theory.damping_ratio(e)) for e in restitutions
    ]
    found = checks_at([f"v'/v at e = {e:.1f}" for e in restitutions], restitutions, measured, allowed)
    trace = Trace("", restitutions, measured, ([0.0, 1.0], [0.0, 1.0]))
    return Evidence(tuple(found), Panel("restitution e", "speed after / before", (trace,)))


def _against_the_floor(
    tangential: ArrayLike, normal: ArrayLike, spin: ArrayLike, names: list[str]
) -> tuple[list[Check], Array, Array]:
    """Return checks of impacts on the floor, the slip after each of them, and the expected one [m/s]."""
    tangential, normal, spin = np.broadcast_arrays(
        *(np.asarray(a, float) for a in (tangential, normal, spin))
    )
    config = scenes.floor({"run.time_step": _STEP, **scenes.elastic(_FRICTION)})
    state = scenes.on_the_floor(np.column_stack([tangential, -normal]), _STEP * normal, spin)
    run = scenes.after(config, state, _LONG)
    slip = tangential + RADIUS * spin
    impulse = np.array(
        [theory.tangential_impulse(s, w, _FRICTION) for s, w in zip(slip, normal, strict=True)]
    )
    scale = normal + np.abs(slip)
    allowed = _allowed(WALL_FREQUENCY)
    along, across, turning = run.velocities[:, 0], run.velocities[:, 1], RADIUS * run.angular_velocities
    spun = RADIUS * spin - 2.0 * impulse
    pairs = (
        ("vₜ", tangential - impulse, along, scale),
        ("vₙ", normal, across, scale),
        ("r ω", spun, turning, 2.0 * scale),
    )
    found = []
    for quantity, expected, measured, size in pairs:
        places = [f"{quantity}, {name}" for name in names]
        found += checks_at(places, expected, measured, allowed * size, "m/s")
    loss = float(MASS * (impulse * slip - 1.5 * impulse**2).sum())
    lost = scenes.last(run, "dissipated_sliding")
    found.append(Check("loss to sliding, all", "J/m", loss, lost, allowed * MASS * float((scale**2).sum())))
    return found, along + turning, tangential - impulse + spun


def _slips(x: ArrayLike, seen: ArrayLike, fine: tuple[ArrayLike, Array], label: str) -> Panel:
    return Panel(label, "slip after / closing speed", (Trace("", x, seen, fine),))


def _slip_after(slip: ArrayLike, closing: float = 1.0) -> Array:
    """Return the slip after an impact."""
    return np.asarray(slip, float) - 3.0 * theory.tangential_impulse(slip, closing, _FRICTION)


@case("oblique-impact", source=_SOURCE.format(4), formula=f"{_IMPULSE}; vₜ' = vₜ − J/m, r ω' = −2 J/m")
def oblique_impact() -> Evidence:
    """Impact on a wall at one speed, 5 … 85° from the normal.

    θ² + δ/r of closing speed and slip together.
    """
    degrees = np.arange(5.0, 90.0, 5.0)
    angle = np.radians(degrees)
    speed = _CLOSING
    found, slip, _ = _against_the_floor(
        speed * np.sin(angle), speed * np.cos(angle), 0.0, [f"{d:.0f}°" for d in degrees]
    )
    fine = np.radians(np.linspace(1.0, 89.0, 400))
    expected = [_slip_after(np.sin(a), math.cos(a)) for a in fine]
    trace = Trace("", degrees, slip / speed, (np.degrees(fine), np.array(expected)))
    return Evidence(tuple(found), Panel("angle from the normal [°]", "slip after / speed before", (trace,)))


@case("tangential-speeds", source=_SOURCE.format(5), formula=f"{_IMPULSE}; vₜ' = vₜ − J/m, r ω' = −2 J/m")
def tangential_speeds() -> Evidence:
    """Impact on a wall at one normal speed with tangential speeds from sticking to sliding.

    θ² + δ/r of closing speed and slip together.
    """
    speeds = np.array([-2.0, -1.0, -0.3, 0.0, 0.1, 0.3, 0.435, 0.465, 0.6, 0.9, 1.2, 1.6, 2.0])
    names = [f"vₜ/vₙ = {s:g}" for s in speeds]
    found, slip, _ = _against_the_floor(speeds * _CLOSING, _CLOSING, 0.0, names)
    fine = np.linspace(-2.1, 2.1, 400)
    return Evidence(tuple(found), _slips(speeds, slip / _CLOSING, (fine, _slip_after(fine)), "vₜ/vₙ before"))


@case("spins", source=_SOURCE.format(6), formula=f"{_IMPULSE}; vₜ' = vₜ − J/m, r ω' = r ω − 2 J/m")
def spins() -> Evidence:
    """Impact on a wall at one normal speed with spins from sticking to sliding, without and with a tangential speed.

    θ² + δ/r of closing speed and slip together.
    """
    turning = np.array([-2.0, -1.2, -0.6, -0.3, -0.1, 0.1, 0.435, 0.465, 0.9, 1.5, 2.0])
    found, traces = [], []
    for tangential in (0.0, 0.4):
        names = [f"r ω/vₙ = {s:g}, vₜ/vₙ = {tangential:g}" for s in turning]
        more, slip, _ = _against_the_floor(
            tangential * _CLOSING, _CLOSING, turning * _CLOSING / RADIUS, names
        )
        found += more
        fine = np.linspace(-2.1, 2.1, 400)
        label = f"vₜ = {tangential:g} vₙ"
        traces.append(Trace(label, turning, slip / _CLOSING, (fine, _slip_after(fine + tangential))))
    panel = Panel(
        "r ω/vₙ before", "slip after / closing speed", (shared_curve(fine, _slip_after(fine)), *traces)
    )
    return Evidence(tuple(found), panel)


def _of_two_bodies(radii: tuple[float, float], spin: tuple[float, float]) -> tuple[list[Check], float]:
    """Return checks of two bodies that meet along an inclined normal, and the slip after / closing speed."""
    normal, tangent = np.array([math.cos(0.3), math.sin(0.3)]), np.array([-math.sin(0.3), math.cos(0.3)])
    lightest = min(radii) / RADIUS
    step = _STEP * lightest
    half = normal * (sum(radii) + _CLOSING * step) / 2.0
    before = np.outer([0.6 * _CLOSING, -0.4 * _CLOSING], normal)
    state = State([-half, half], before, angular_velocities=spin, radii=radii)
    config = scenes.free_space({"run.time_step": step, **scenes.elastic(_FRICTION)})
    run = scenes.after(config, state, _LONG)
    masses, effective = run.masses, 1.0 / float((1.0 / run.masses).sum())
    frequency = math.sqrt(scenes.PAIR_STIFFNESS / effective)
    turning = np.array(radii) * spin
    slip = -float(turning.sum())
    impulse = effective * float(theory.tangential_impulse(slip, _CLOSING, _FRICTION))
    # What drags body 1 along +t drags body 2 along −t; both spins lose alike.
    push = tangent * impulse - normal * 2.0 * effective * _CLOSING
    after = before + np.outer([1.0, -1.0] / masses, push)
    # Of what an impact changes, 2 w m*/m and 2 J/m at most.
    allowed = 2.0 * _allowed(frequency, step, min(radii)) * (_CLOSING + abs(slip)) * effective / masses
    place = f"radii {radii[0] / RADIUS:g}:{radii[1] / RADIUS:g}, spins {spin[0]:g} and {spin[1]:g} rad/s"
    found = checks(f"v of body {{}} (x, y), {place}", "m/s", after, run.velocities, allowed[:, None])
    spun = turning + 2.0 * impulse / masses
    seen = np.array(radii) * run.angular_velocities
    found += checks(f"r ω of body {{}}, {place}", "m/s", spun, seen, allowed)
    along = float((run.velocities[1] - run.velocities[0]) @ tangent)
    return found, (along - float(seen.sum())) / _CLOSING


def _pairs_with_spins(radii: tuple[float, float], others: tuple[float, ...]) -> Evidence:
    """Return impacts of two bodies with varied spins, the second's a multiple of the first's."""
    found, traces = [], []
    values = np.array([-6.0, -3.0, -1.4, -0.5, 0.4, 1.0, 2.2, 4.0, 6.0])
    for other in others:
        x, y = [], []
        for value in values:
            spin = (float(value), float(other * value))
            more, slip = _of_two_bodies(radii, spin)
            found += more
            x.append(-(radii[0] * spin[0] + radii[1] * spin[1]) / _CLOSING)
            y.append(slip)
        traces.append(Trace(f"ω₂ = {other:g} ω₁", np.array(x), np.array(y)))
    most = max(float(np.max(np.abs(trace.x))) for trace in traces)
    fine = np.linspace(-most, most, 400)
    return Evidence(
        tuple(found),
        Panel(
            "slip before / closing speed",
            "slip after / closing speed",
            (shared_curve(fine, _slip_after(fine)), *traces),
        ),
    )


@case("equal-bodies", source=_SOURCE.format(7), formula=f"{_IMPULSE}; v' = v ± J/m t, r ω' = r ω + 2 J/m")
def equal_bodies() -> Evidence:
    """Two equal bodies with spins: alike, one of them at rest, and geared like two wheels.

    θ² + δ/r of closing speed and slip together, shared in the ratio of the masses.
    """
    return _pairs_with_spins((RADIUS, RADIUS), (1.0, 0.0, -1.0))


@case("unequal-bodies", source=_SOURCE.format(8), formula=f"{_IMPULSE}; v' = v ± J/m t, r ω' = r ω + 2 J/m")
def unequal_bodies() -> Evidence:
    """Two bodies of radii 1 : 0.4 with spins.

    θ² + δ/r of closing speed and slip together, shared in the ratio of the masses.
    """
    return _pairs_with_spins((RADIUS, 0.4 * RADIUS), (1.0, 0.0, -2.5))


CASES = (
    two_bodies_head_on,
    wall_head_on,
    restitution_sweep,
    oblique_impact,
    tangential_speeds,
    spins,
    equal_bodies,
    unequal_bodies,
)
