"""A constant pull F_c while bodies touch: hanging, riding over the top, impacts, what it presses together.

With ω₀ = √(kₙ/m*) an elastic contact obeys δ'' = −ω₀² (δ − F_c/kₙ), from δ = 0 at the speed v: it swings about F_c/kₙ
with the amplitude √(F_c²/kₙ² + v²/ω₀²), and the pull, which has the potential −F_c δ, gives back what it took.
"""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Simulation, State
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at, shared_curve
from drumrs.verification.friction import at_rest
from drumrs.verification.scenes import (
    DRUM_RADIUS,
    GRAVITY,
    MASS,
    RADIUS,
    TIME_STEP,
    WALL_FREQUENCY,
    WALL_STIFFNESS,
)

Array = NDArray[np.float64]

_STEP = TIME_STEP / 4.0
_WEIGHT = MASS * GRAVITY
_ORBIT = DRUM_RADIUS - RADIUS
_DERIVED = "derived: potential −F_c δ"


@case("hanging", source="statics", formula="δ = (F_c − m g)/kₙ, and none where F_c < m g")
def hanging() -> Evidence:
    """A disc under the top of a drum at rest, against its adhesion.

    At rest the scheme errs by the round-off of positions alone, see `stack`. Where the pull is too weak the disc, which
    starts with an overlap, has left the drum for good.
    """
    pulls = np.array([0.5, 0.9, 0.99, 1.01, 1.1, 1.5, 2.0, 3.0])
    seen = np.array([_overlap_after(pull) for pull in pulls])
    damping = 2.0 * theory.damping_ratio(0.1) * math.sqrt(WALL_STIFFNESS * MASS)
    allowed = np.where(pulls < 1.0, 0.0, at_rest(DRUM_RADIUS, WALL_STIFFNESS, damping, TIME_STEP) / _WEIGHT)
    places = [f"kₙ δ/m g at F_c/m g = {pull:g}" for pull in pulls]
    found = checks_at(places, np.maximum(pulls - 1.0, 0.0), seen, allowed)
    trace = Trace("", pulls, seen, ([0.5, 1.0, 3.0], [0.0, 0.0, 2.0]))
    return Evidence(tuple(found), Panel("F_c / m g", "kₙ δ / m g", (trace,)))


def _overlap_after(pull: float) -> float:
    """Return kₙ δ/m g of a disc that has hung for a while, 0 where it fell."""
    changes = {"rotation.rpm": 0.0, "contact.drum.adhesion": pull * _WEIGHT}
    start = max(pull - 1.0, 0.1) * _WEIGHT / WALL_STIFFNESS
    run = scenes.after(scenes.drum(changes), State([[0.0, _ORBIT + start]]), 0.05)
    overlap = float(run.positions[0, 1]) - _ORBIT
    return max(overlap, 0.0) * WALL_STIFFNESS / _WEIGHT


@case(
    "over-the-top",
    source="statics in the drum's frame",
    formula="leaves at sin θ = F_c/(m g) + Ω² (R − r)/g",
    cost=4e6,
)
def over_the_top() -> Evidence:
    """A disc that the drum carries up from the side, bonded by friction, rolling resistance and adhesion.

    What presses it is F_c + m Ω² (R − r) − m g sin θ, θ from the horizontal; the disc leaves where that vanishes, and
    is carried over the top where it does not. The springs start relaxed and swing at g/ω at most, with
    ω² = ½ (5 − √17) kₛ/m, which is twice that part of the centrifugal force; the dashpot lags by 2 z Ω/ω₀; samples are
    10 steps apart.
    """
    pulls, sums = (0.0, 0.3, 0.6), np.array([0.7, 0.8, 0.9, 0.97, 1.01, 1.1])
    found, traces = [], []
    slowest = math.sqrt((5.0 - math.sqrt(17.0)) / 2.0) * WALL_FREQUENCY
    for pull in pulls:
        speeds = np.sqrt((sums - pull) * GRAVITY / _ORBIT)
        seen = np.array([_left(pull, speed) for speed in speeds])
        swing = 2.0 * GRAVITY / slowest / (speeds * _ORBIT) * (sums - pull)
        allowed = (
            swing + 2.0 * theory.damping_ratio(0.1) * speeds / WALL_FREQUENCY + 10.0 * TIME_STEP * speeds
        )
        places = [f"sin θ at F_c/m g = {pull:g}, sum {total:g}" for total in sums]
        # Where nothing ends the contact, sin θ = 1 stands for the top.
        found += checks_at(places, np.minimum(sums, 1.0), seen, np.where(sums < 1.0, allowed, 0.0))
        traces.append(Trace(f"F_c/m g = {pull:g}", sums, seen))
    line = shared_curve([0.7, 1.0, 1.1], [0.7, 1.0, 1.0])
    return Evidence(tuple(found), Panel("F_c/m g + Ω² (R − r)/g", "sin θ where it leaves", (line, *traces)))


def _left(pull: float, speed: float) -> float:
    """Return sin θ where the contact ends, 1 where it lasts beyond the top."""
    bonds = {
        "adhesion": pull * _WEIGHT,
        "friction": 1e6,
        "rolling_friction": 1e6,
        "tangential_damping_ratio": 0.3,
    }
    changes = {f"contact.drum.{key}": value for key, value in bonds.items()}
    config = scenes.drum({**changes, "rotation.rpm": speed * 60.0 / math.tau})
    overlap = (pull * _WEIGHT + MASS * speed**2 * _ORBIT) / WALL_STIFFNESS
    orbit = _ORBIT + overlap
    state = State([[orbit, 0.0]], [[0.0, orbit * speed]], angular_velocities=[speed])
    time = 0.75 * math.pi / speed
    run = scenes.after(config, state, time, samples=math.ceil(time / (10.0 * TIME_STEP)))
    apart = np.flatnonzero(run.series["contact_count"].to_numpy() == 0)
    return math.sin(speed * float(run.series["time"][int(apart[0])])) if len(apart) else 1.0


def _impacts(
    pull: float, changes: dict[str, object], seconds: float, onsets: int, samples: int = 1
) -> Simulation:
    """Return impacts on the floor at 1 m/s, one for each onset; `pull` is F_c/(m ω₀ v)."""
    law = {"contact.drum.adhesion": pull * MASS * WALL_FREQUENCY, **changes}
    config = scenes.floor({"run.time_step": _STEP, **law})
    state = scenes.on_the_floor([0.0, -1.0], (1.0 + scenes.phases(onsets)) * config.run.time_step)
    return scenes.after(config, state, seconds, samples=samples)


@case(
    "adhesive-impact",
    source=_DERIVED,
    formula="v' = v, δ = (q + √(1 + q²)) v/ω₀, ω₀ t = 2 (π − atan 1/q), q = F_c/(m ω₀ v)",
)
def adhesive_impact() -> Evidence:
    """Elastic impact with adhesion: rebound, greatest overlap, duration; its energy returns to zero.

    The pull jumps where bodies meet and where they part: half a step of it each, q θ of the speed. The mean over onsets
    leaves some of that, as it changes how long the contact lasts, by whole steps: within q θ + θ² + θ/200 of the speed,
    the overlap and the duration. The column of adhesion, which touching bodies alone fill, is 0 at the end to the bit.
    """
    step, onsets = _STEP / 4.0, 200
    pulls, found, drawn = np.array([0.1, 0.3, 1.0, 2.0]), [], []
    for pull in pulls.tolist():
        turn = math.pi - math.atan(1.0 / pull)
        time = 2.5 * turn / WALL_FREQUENCY
        run = _impacts(
            pull,
            {"contact.drum.restitution": 1.0, "run.time_step": step},
            time,
            onsets,
            math.ceil(time / step),
        )
        series = run.series
        deepest = float(series["max_overlap_ratio"].to_numpy().max()) * RADIUS * WALL_FREQUENCY
        lasted = float(series["contact_count"].sum()) * step / onsets * WALL_FREQUENCY
        allowed = pull * WALL_FREQUENCY * step + theory.mean_error(WALL_FREQUENCY, step, onsets)
        single = (1.0 + pull) * allowed
        place = f"at q = {pull:g}"
        found += [
            Check(f"v'/v {place}", "1", 1.0, float(run.velocities[:, 1].mean()), allowed),
            Check(f"ω₀ δ/v {place}", "1", pull + math.hypot(1.0, pull), deepest, single),
            Check(f"ω₀ t {place}", "1", 2.0 * turn, lasted, 2.0 * turn * allowed),
            Check(f"energy of adhesion at the end {place}", "J/m", 0.0, scenes.last(run, "adhesion"), 0.0),
        ]
        drawn.append((deepest, lasted))
    fine = np.linspace(0.02, 2.1, 100)
    deepest_seen, lasted_seen = np.array(drawn).T
    traces = (
        Trace("overlap ω₀ δ/v", pulls, deepest_seen, (fine, fine + np.hypot(1.0, fine))),
        Trace("duration ω₀ t", pulls, lasted_seen, (fine, 2.0 * (math.pi - np.arctan(1.0 / fine)))),
    )
    return Evidence(tuple(found), Panel("q = F_c/(m ω₀ v)", "overlap, duration", traces))


@case("capture", source=_DERIVED, formula="δ → F_c/kₙ, loss ½ m v² + F_c²/2 kₙ", cost=6e6)
def capture() -> Evidence:
    """Damped impact with adhesion that does not let go, with either tension: overlap at rest, loss.

    Where tension is clipped the pull stays, or else nothing would hold the disc. Mean over 100 onsets: θ² + θ/100 of
    (1 + q)² ½ m v², θ with the damping ratio: no energy at hand is greater. The overlap settles to what e⁻²⁰ leaves.
    """
    onsets = 100
    pulls, found, traces = (0.5, 1.0, 2.0), [], []
    for tension in ("allowed", "clipped"):
        ratio = theory.damping_ratio(0.1, clipped=tension == "clipped")
        # The slower decay: z ω₀, or ω₀/2 z at the least beyond critical damping.
        settled = 20.0 / (min(ratio, 0.5 / ratio) * WALL_FREQUENCY)
        seen = []
        for pull in pulls:
            run = _impacts(pull, {"contact.drum.tension": tension}, settled, onsets)
            energy = 0.5 * MASS
            lost = scenes.last(run, "dissipated_normal") / onsets / energy
            held = RADIUS - run.positions[:, 1]
            deep = held * WALL_FREQUENCY / pull
            allowed = (1.0 + pull) ** 2 * theory.mean_error(WALL_FREQUENCY, _STEP, onsets, ratio)
            place = f"at q = {pull:g}, tension {tension}"
            found.append(Check(f"loss/½ m v² {place}", "1", 1.0 + pull**2, lost, allowed))
            found += checks(f"kₙ δ/F_c of disc {{}} {place}", "1", 1.0, deep[::20], 1e-6)
            seen.append(lost)
        traces.append(Trace(f"tension {tension}", pulls, seen))
    fine = np.linspace(0.4, 2.1, 100)
    return Evidence(
        tuple(found), Panel("q = F_c/(m ω₀ v)", "loss / ½ m v²", (shared_curve(fine, 1.0 + fine**2), *traces))
    )


@case("pressed-by-adhesion", source=_DERIVED, formula="slides with μ F_c/m, rolls with ⅔ μ_r F_c/m")
def pressed_by_adhesion() -> Evidence:
    """A disc that adhesion alone presses on a floor, without gravity: friction and rolling resistance act in full.

    Speed after a while, within F/(m ωₜ), F Δt/m, and of the speed lost δ/r and what round-off leaves of the force.
    """
    speed, pull, step = 0.5, _WEIGHT, 1e-5
    laws = {"sliding": {"friction": 0.2}, "rolling": {"friction": 0.5, "rolling_friction": 0.2}}
    found, traces = [], []
    swing = math.sqrt(3.0) * WALL_FREQUENCY
    overlap = pull / WALL_STIFFNESS
    for name, law in laws.items():
        changes = {f"contact.drum.{key}": value for key, value in {**law, "adhesion": pull}.items()}
        rate = (0.2 if name == "sliding" else 2.0 / 3.0 * 0.2) * pull / MASS
        spin = 0.0 if name == "sliding" else -speed / (RADIUS - overlap)
        run = scenes.after(
            scenes.floor({"run.time_step": step, **changes}),
            scenes.on_the_floor([speed, 0.0], -overlap, spin),
            0.05,
            samples=10,
        )
        times = run.series["time"].to_numpy()
        seen = np.sqrt(2.0 * run.series["kinetic_translation"].to_numpy() / MASS)
        allowed = rate * (1.0 / swing + step) + speed * 1e-5
        found += checks(f"speed {name}, sample {{}}", "m/s", speed - rate * times, seen, allowed)
        traces.append(Trace(name, times, seen, (times, speed - rate * times)))
    return Evidence(tuple(found), Panel("time [s]", "speed [m/s]", tuple(traces)))


CASES = (hanging, over_the_top, adhesive_impact, capture, pressed_by_adhesion)
