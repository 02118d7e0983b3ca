"""The regime of loads that move as the name says."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import Frames, measures
from drumrs.verification import made_up
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace
from drumrs.verification.flight import orbits

Array = NDArray[np.float64]

_RADIUS, _SPEED, _TURNS, _FRAMES = 0.04, 2.0, 2.0, 49
# Half of the angle that the bed spans, slope, and how much faster than the rim it flows down its surface.
_HALF_ANGLE, _SLOPE, _FLOW = 1.3, 0.5, 3.0
# How far the surface of the cascading bed is off its chord, over the chord; and so its middle four fifths off theirs.
_S_SHAPE, _S_SHAPE_WITHOUT_ENDS = 0.12, 0.096
# Smaller discs there: a surface that discs trace is too flat where it is hollow, the more the larger they are.
_SMALL = 0.015
# Frames in which a bed goes with the drum, between those in which it flows or slides back.
_RIDES = 3


@case(
    "regimes",
    source="made-up loads",
    formula="each load has the name of its motion; Fr = Ω² R/g, slip, circulation, sag as made",
    cost=1e7,
)
def regimes() -> Evidence:
    """Loads that ride, half of which ride, that fly, stay, ride and slide back, flow in avalanches, straight, in an S.

    Names must be right. Numbers: round-off; the share in throws to a frame a flight; the sag within a fifth of what was
    made, for the surface is a radius above the discs. The surface of the cascading bed is A sin(π x/h) above its chord
    from −h to h. From −0.8 h to 0.8 h it is A (sin u − 0.234 u) off the chord there, at most 0.660 A, at u = 1.335.
    """
    made = _loads()
    seen = {name: measures.regime(load, (0.0, float(load.times[-1]))) for name, load in made.items()}
    found = [Check(f"name is {name!r}", "1", 1.0, float(one.name == name), 0.0) for name, one in seen.items()]
    ring, still = seen["centrifuging"], seen["slipping"]
    _, orbit, speed = orbits()
    flies, rides = orbit.flight * math.tau, math.tau - 4.0 * orbit.release
    # A flight is seen to begin and to end to within a frame.
    thrown, frame = flies / (flies + rides), made["cataracting"].times[1] * speed / (flies + rides)
    rows = [
        ("Froude number", _SPEED**2 / 9.81, ring.froude_number, 1e-12),
        ("carried round, all", 1.0, ring.carried_round, 1e-9),
        ("carried round, half", 0.5, seen["partly centrifuging"].carried_round, 1e-9),
        ("slip of riders", 0.0, ring.wall_slip, 1e-9),
        ("slip of what stays", 1.0, still.wall_slip, 1e-9),
        ("circulation of riders", 1.0, ring.circulation, 1e-9),
        ("circulation of what stays", 0.0, still.circulation, 1e-9),
        ("share of the time that a surging bed sticks", 0.75, seen["surging"].sticking, 1e-9),
        ("slip of a surging bed", 1.0, seen["surging"].wall_slip, 1e-9),
        ("steadiness of avalanches", 0.0, seen["slumping"].steadiness, 1e-9),
        ("share in throws of Davis's orbits", thrown, seen["cataracting"].share_in_throws, frame),
        ("sag of an S", _S_SHAPE_WITHOUT_ENDS, seen["cascading"].sag, 0.2 * _S_SHAPE_WITHOUT_ENDS),
    ]
    found += [Check(name, "1", expected, value, tolerance) for name, expected, value, tolerance in rows]
    trace = Trace("", [row[1] for row in rows], [row[2] for row in rows], ([0.0, 1.0], [0.0, 1.0]))
    return Evidence(tuple(found), Panel("expected", "measured", (trace,)))


def _loads() -> dict[str, Frames]:
    """Return a load for each name."""
    angles = np.linspace(0.0, _TURNS * math.tau, _FRAMES)
    ring = _at_the_rim(0.1 + math.tau * np.arange(30) / 30.0)
    rest = _at_the_rim(-0.5 * math.pi + 0.04 * np.arange(-15, 15))
    riding = np.array([ring @ made_up.turned(angle) for angle in angles])
    staying = np.repeat(rest[np.newaxis], len(angles), axis=0)
    flying, _, _ = orbits()
    # What a bed is ahead by that rides some frames and makes up for it in one, and what it made up by then.
    one = angles[1]
    ahead = one * (np.arange(len(angles)) % (_RIDES + 1))
    surging = np.array([rest @ made_up.turned(angle) for angle in ahead])
    flowing = _bed(angles - ahead, 0.0)
    slumping = np.array([load @ made_up.turned(angle) for load, angle in zip(flowing, ahead, strict=True)])
    return {
        "centrifuging": _frames(riding, angles),
        "partly centrifuging": _frames(np.concatenate([riding, staying], axis=1), angles),
        "cataracting": flying.picked(slice(None, 1000, 20)),
        "slipping": _frames(staying, angles),
        "surging": _frames(surging, angles),
        "slumping": _frames(slumping, angles),
        "cascading": _frames(_bed(angles, _S_SHAPE * 2.0 * math.sin(_HALF_ANGLE), _SMALL), angles, _SMALL),
        "rolling": _frames(_bed(angles, 0.0), angles),
    }


def _at_the_rim(angles: ArrayLike) -> Array:
    places: Array = 0.95 * np.column_stack([np.cos(angles), np.sin(angles)])
    return places


def _frames(places: Array, angles: Array, radius: float = _RADIUS) -> Frames:
    made: dict[str, Any] = {
        "times": angles / _SPEED,
        "drum_angles": angles,
        "contacts": np.full(places.shape[:2], 2, dtype=np.uint16),
    }
    return made_up.frames(places, radius, **made)


def _bed(angles: Array, bulge: float, disc: float = _RADIUS) -> Array:
    """Return a bed whose discs ride their arcs with the drum and flow back along the chord, as the drum's angle says.

    They fill the arcs evenly. Above the chord's middle the bed is lifted, below it lowered, all the more the higher.
    """
    level = math.cos(_HALF_ANGLE)
    load = made_up.lattice(disc)
    load = load[load[:, 1] < -level]
    radius = np.hypot(*load.T)
    half = np.arccos(level / radius)
    width = 2.0 * radius * np.sin(half)
    # Angles by which the drum turns while a disc rides, and while it flows back.
    rides, flows = 2.0 * half, width / _FLOW
    begin = np.arctan2(load[:, 0], -load[:, 1]) + half
    phase = (begin + angles[:, np.newaxis]) % (rides + flows)
    place = phase - half
    share = np.clip((phase - rides) / flows, 0.0, 1.0)
    is_riding = phase < rides
    x = np.where(is_riding, radius * np.sin(place), width * (0.5 - share))
    y = np.where(is_riding, -radius * np.cos(place), -level)
    bottom = -np.sqrt(np.maximum(1.0 - x**2, level**2))
    height = (y - bottom) / np.maximum(-level - bottom, disc)
    y = y + bulge * np.sin(math.pi * x / math.sin(_HALF_ANGLE)) * height
    return np.stack([x, y], axis=-1) @ made_up.turned(_SLOPE)


CASES = (regimes,)
