"""Measures of flight: Davis's table, and frames of discs that ride and fly on his orbits."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Frames, Result, State, measures
from drumrs.verification import made_up, scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at

Array = NDArray[np.float64]

# Froude number; release from the top and landing [°], drop, time of flight, speed at landing and its normal part.
_TABLE = (
    (0.3, 72.54, 307.63, 1.0920, 0.1822, 1.5761, 1.1411),
    (0.5, 60.0, 270.0, 1.5, 0.2757, 1.8708, 1.8371),
    (0.774, 39.29, 207.86, 1.2413, 0.3120, 1.8046, 1.3829),
    (0.9, 25.84, 167.53, 0.6840, 0.2497, 1.5060, 0.5657),
)
_GRAVITY, _RADIUS, _FROUDE = 9.81, 0.05, 0.5
_DISCS, _FRAMES, _TURNS = 7, 3000, 6.0


@case(
    "davis",
    source="a parabola from where weight is the centripetal force, by its own equations",
    formula="cos a = Fr; lands at 90° + 3 a; drop 4 sin²a cos a",
    cost=1e5,
)
def davis() -> Evidence:
    """Davis's orbits: a table of them, and the meeting of parabola and rim, solved for numerically.

    Half of the last digit of the table; 10⁻⁹ for the root.
    """
    found, lands = [], []
    for froude, *row in _TABLE:
        orbit = measures.davis(froude)
        seen = [math.degrees(orbit.release), math.degrees(orbit.landing)]
        seen += [orbit.drop, orbit.flight, orbit.speed, orbit.normal_speed]
        names = ("a [°]", "landing [°]", "drop / r", "flight / turn", "speed / √(g r)", "normal part")
        places = [f"{name} at Fr = {froude:g}" for name in names]
        found += checks_at(places, row, seen, [0.0051, 0.0051, 5.1e-5, 5.1e-5, 5.1e-5, 5.1e-5])
        time, place, velocity = _meets(froude)
        lands.append(math.degrees(orbit.landing))
        found += checks_at(
            [
                f"{name} by the root at Fr = {froude:g}"
                for name in ("flight", "x", "y", "speed", "normal speed")
            ],
            [time, *place, float(np.hypot(*velocity)), float(velocity @ place)],
            [
                orbit.flight * math.tau / math.sqrt(froude),
                math.cos(orbit.landing),
                math.cos(orbit.release) - orbit.drop,
                orbit.speed,
                orbit.normal_speed,
            ],
            1e-9,
        )
    fine = np.linspace(0.01, 0.99, 200)
    trace = Trace("", [row[0] for row in _TABLE], lands, (fine, 90.0 + 3.0 * np.degrees(np.arccos(fine))))
    return Evidence(tuple(found), Panel("Froude number", "landing [°]", (trace,)))


def _meets(froude: float) -> tuple[float, Array, Array]:
    """Return when and where a parabola meets the unit circle again, and how fast, for g = 1, by bisection."""
    release, speed = math.acos(froude), math.sqrt(froude)
    start = np.array([math.sin(release), math.cos(release)])
    velocity = speed * np.array([-math.cos(release), math.sin(release)])

    def at(time: float) -> Array:
        place: Array = start + velocity * time - np.array([0.0, 0.5 * time**2])
        return place

    low, high = 0.1 * speed * math.sin(release), 10.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.hypot(*at(middle)) < 1.0 else (low, middle)
    return low, at(low), velocity - np.array([0.0, low])


@case(
    "flight",
    source="Davis's orbits",
    formula="share in flight t_f/(t_f + t_c), falls a turn 2π/(Ω (t_f + t_c)), drop, landing and head of the orbit",
    cost=1e5,
)
def flight() -> Evidence:
    """Seven discs that ride and fly at Fr = 0.5, in 500 frames a turn.

    Two frames, one at either end, of the time of flight, for the share; of the way of a disc, for drop and place of
    landing. The head is the height that all but a hundredth of the flight lies below, to a thousandth of the orbit;
    falls are counted, to one a disc.
    """
    frames, orbit, speed = orbits()
    seen = measures.flight(frames, (0.0, float(frames.times[-1])), gravity=_GRAVITY)
    step, reach = float(frames.times[1]), 1.0 - _RADIUS
    flies = orbit.flight * math.tau / speed
    cycle = flies + (math.tau - 4.0 * orbit.release) / speed
    landing = math.sqrt(_GRAVITY * reach) * orbit.speed
    apex = reach * (math.cos(orbit.release) + orbit.rise) - 0.5 * _GRAVITY * (0.5 * 0.01 * flies) ** 2
    rows = [
        ("share_in_flight", "1", flies / cycle, 2.0 * step / cycle + 2.0 / (_TURNS * _DISCS)),
        ("falls_per_turn", "1", math.tau / (speed * cycle), 1.0 / _TURNS),
        ("mean_drop", "m", reach * orbit.drop, 2.0 * landing * step),
        ("landing_on_drum", "1", 1.0, 0.0),
        ("head_height", "m", apex, 1e-3 * reach),
        ("impact_toe_angle", "rad", orbit.landing, 2.0 * landing * step / reach),
    ]
    found = []
    for name, unit, expected, tolerance in rows:
        mean = seen[name]
        found.append(Check(name, unit, expected, math.nan if mean is None else mean.value, tolerance))
    table = measures.flights(frames, (0.0, float(frames.times[-1])), gravity=_GRAVITY)
    speeds = table.filter("is_fall")["speed"].to_numpy()
    found.append(Check("speed at landing", "m/s", landing, float(speeds.mean()), _GRAVITY * step))
    curve = (np.cos(np.linspace(0.0, math.tau, 200)) * reach, np.sin(np.linspace(0.0, math.tau, 200)) * reach)
    trace = Trace("landings", table["end_x"].to_numpy(), table["end_y"].to_numpy(), curve)
    return Evidence(tuple(found), Panel("x [m]", "y [m]", (trace,)))


def orbits() -> tuple[Frames, measures.Orbit, float]:
    """Return frames of discs on Davis's orbit, the orbit, and the speed of the drum [rad/s]."""
    orbit, reach = measures.davis(_FROUDE), 1.0 - _RADIUS
    speed = math.sqrt(_FROUDE * _GRAVITY / reach)
    flies = orbit.flight * math.tau / speed
    cycle = flies + (math.tau - 4.0 * orbit.release) / speed
    times = np.linspace(0.0, _TURNS * math.tau / speed, _FRAMES)
    phase = (times[:, np.newaxis] + cycle * np.arange(_DISCS) / _DISCS) % cycle
    is_free = phase < flies
    start = 0.5 * math.pi - orbit.release
    x = reach * math.cos(start) - reach * speed * math.sin(start) * phase
    y = reach * math.sin(start) + reach * speed * math.cos(start) * phase - 0.5 * _GRAVITY * phase**2
    rides = orbit.landing + speed * (phase - flies)
    places = np.where(
        is_free[..., np.newaxis],
        np.stack([x, y], axis=-1),
        reach * np.stack([np.cos(rides), np.sin(rides)], axis=-1),
    )
    velocities = np.stack(
        [
            np.full_like(phase, -reach * speed * math.sin(start)),
            reach * speed * math.cos(start) - _GRAVITY * phase,
        ],
        axis=-1,
    )
    contacts = np.where(is_free, 0, 1).astype(np.uint16)
    made = {"times": times, "drum_angles": speed * times, "velocities": velocities, "contacts": contacts}
    return made_up.frames(places, _RADIUS, **made), orbit, speed


@case(
    "davis-simulated",
    source="Davis's orbits",
    formula="released at cos a = Fr, first touch at 90° + 3 a with the speeds of the parabola",
    cost=1e6,
)
def davis_simulated() -> Evidence:
    """One disc that may not spin is carried up by great friction, flies, and lands: the simulation on Davis's orbit.

    The disc is let go where its spring is relaxed, within the time of half a swing of it, π √(m/k), and ten steps.
    Places and speeds are met within the way at landing, or g, in that time.
    """
    found, traces = [], []
    reach = scenes.DRUM_RADIUS - scenes.RADIUS
    for froude in (0.5, 0.774):
        orbit, scale = measures.davis(froude), math.sqrt(scenes.GRAVITY * reach)
        late = math.pi / scenes.WALL_FREQUENCY + 10.0 * scenes.TIME_STEP
        result = _carried(froude, reach)
        contacts = measures.impacts(result.contacts, result.frames.times[-1])
        landing = contacts.row(1, named=True)
        speed = orbit.speed * scale
        # Velocity at landing, over √(g r), along the rim, which moves on at √Fr.
        velocity = -math.sqrt(froude) * np.array([math.cos(orbit.release), 3.0 * math.sin(orbit.release)])
        along = float(velocity @ np.array([-math.sin(orbit.landing), math.cos(orbit.landing)]))
        slow, slip = late * scenes.GRAVITY / scale, abs(math.sqrt(froude) - along)
        rows = [
            (
                "landing, x / r",
                math.cos(orbit.landing),
                landing["x"] / scenes.DRUM_RADIUS,
                late * speed / reach,
            ),
            (
                "landing, y / r",
                math.sin(orbit.landing),
                landing["y"] / scenes.DRUM_RADIUS,
                late * speed / reach,
            ),
            ("normal speed", orbit.normal_speed, landing["normal_speed"] / scale, slow),
            ("slip at touch", slip, landing["tangential_speed"] / scale, slow),
        ]
        found += [Check(f"{name} at Fr = {froude:g}", "1", *numbers) for name, *numbers in rows]
        path = result.frames.positions[:, 0] / reach
        traces.append(Trace(f"Fr = {froude:g}", path[::4, 0], path[::4, 1]))
    around = np.linspace(0.0, math.tau, 200)
    rim = Trace("", (), (), (np.cos(around), np.sin(around)))
    return Evidence(tuple(found), Panel("x / r", "y / r", (rim, *traces)))


def _carried(froude: float, reach: float) -> Result:
    """Return a run of one disc that rides from the bottom on, until it has landed.

    It does not spin, so it goes as fast as the rim, not as a place of the drum at its center would.
    """
    pace = math.sqrt(froude * scenes.GRAVITY * reach)
    changes = {
        "rotation.rpm": pace / scenes.DRUM_RADIUS * 30.0 / math.pi,
        "load.spin_locked": True,
        "contact.drum.friction": 2000.0,
        "run.frame_every": 0.01 * reach / pace,
        "run.record": ["contacts"],
    }
    held = scenes.MASS * (scenes.GRAVITY + pace**2 / reach) / scenes.WALL_STIFFNESS
    state = State([[0.0, -reach - held]], [[pace, 0.0]])
    return scenes.after(scenes.drum(changes), state, 0.9 * math.tau * reach / pace, samples=10).result()


CASES = (davis, flight, davis_simulated)
