"""Measures of unbalance: discs at known places, a load that rides with the drum, a tub that shakes."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import State, measures
from drumrs.verification import made_up, scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace
from drumrs.verification.scenes import DRUM_RADIUS, MASS, RADIUS

Array = NDArray[np.float64]

_ANGLES = np.array([0.1, 0.4, 1.5, 2.6, 4.0])
_SPEED, _TIME = 25.0, 1.0


@case(
    "unbalance",
    source="statics",
    formula="one disc U = m (R − r), n discs evenly 0, in the frame of the drum",
    cost=1e5,
)
def unbalance() -> Evidence:
    """One disc that rides with the drum, seven of them, and one that stays below the axis while the drum turns.

    Round-off of places in double precision, 10⁻¹⁴ for each of two terms; for the disc at rest, whose moment turns in
    the frame of the drum once, the sum of 100 of them.
    """
    turns = np.linspace(0.0, math.tau, 101)
    around = math.tau * np.arange(7) / 7.0
    found = []
    for count, lengths in ((1, (0.9 * 3.0, 0.9 * 3.0, 0.9)), (7, (0.0, 0.0, 0.0))):
        places = [
            0.9 * np.column_stack([np.cos(a), np.sin(a)]) for a in turns[:, np.newaxis] + around[:count]
        ]
        frames = made_up.frames(places, 0.1, drum_angles=turns)
        seen = measures.unbalance(frames, (0.0, 1.0), np.full(count, 3.0))
        found += [
            Check(f"{name}, discs: {count}", "kg", length, seen[name].value, 1e-13)
            for name, length in zip(("unbalance", "turning_unbalance", "eccentricity"), lengths, strict=True)
        ]
    still = made_up.frames(np.full((100, 1, 2), [0.0, -0.9]), 0.1, drum_angles=turns[:-1])
    vectors = measures.unbalance_vectors(still, (0.0, 1.0), [3.0])
    seen = measures.unbalance(still, (0.0, 1.0), [3.0])
    found += [
        Check("unbalance, at rest", "kg", 2.7, seen["unbalance"].value, 1e-13),
        Check("turning_unbalance, at rest", "kg", 0.0, seen["turning_unbalance"].value, 1e-12),
    ]
    circle = (2.7 * np.sin(turns), 2.7 * np.cos(turns))
    return Evidence(
        tuple(found), Panel("U_x [kg]", "U_y [kg]", (Trace("at rest", vectors[:, 0], vectors[:, 1], circle),))
    )


@case("unbalance-force", source="statics", formula="f = Ω² U by places and by forces", cost=3e5)
def unbalance_force() -> Evidence:
    """Five discs that ride with a drum at 240 rpm, without gravity: the force that turns with it, by two routes.

    Half a millionth of Ω² Σ m r, single precision of the places, each at a distance known to 2⁻²⁴.
    """
    orbit = DRUM_RADIUS - RADIUS
    # The springs hold them at Ω² m (R − r + δ) = k δ.
    orbit += MASS * _SPEED**2 * orbit / (scenes.WALL_STIFFNESS - MASS * _SPEED**2)
    places = orbit * np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
    state = State(
        positions=places,
        velocities=_SPEED * np.column_stack([-places[:, 1], places[:, 0]]),
        angular_velocities=np.full(len(places), _SPEED),
    )
    changes = {"rotation.rpm": _SPEED * 30.0 / math.pi, "gravity": (0.0, 0.0), "run.frame_every": 0.02}
    run = scenes.after(scenes.drum(changes), state, _TIME, samples=50)
    vectors = measures.unbalance_vectors(run.frames, (0.0, _TIME), run.masses)
    by_places = _SPEED**2 * vectors.mean(axis=0)
    by_forces = measures.turning_force(run.series, (0.2 * _TIME, _TIME))
    exact = _SPEED**2 * MASS * places.sum(axis=0)
    allowed = 5e-7 * _SPEED**2 * MASS * orbit * len(places)
    found = [
        Check(f"f_{axis} by {route}", "N/m", expected, value, allowed)
        for route, force in (("places", by_places), ("forces", by_forces))
        for axis, expected, value in zip("xy", exact, force, strict=True)
    ]
    traces = (Trace("by places", *by_places[:, np.newaxis]), Trace("by forces", *by_forces[:, np.newaxis]))
    curve = Trace("", (), (), ([0.0, exact[0]], [0.0, exact[1]]))
    return Evidence(tuple(found), Panel("f_x [N/m]", "f_y [N/m]", (curve, *traces)))


@case(
    "suspension",
    source="steady solution of the linear system, by its complex stiffness",
    formula="X = |U Ω²/(k − M Ω² + i c Ω)|",
    cost=1e5,
)
def suspension() -> Evidence:
    """Stroke, floor force and loss of a suspended tub of 30 kg with 4 kg at 0.2 m.

    Round-off, 10⁻¹² of each; half of the last digit of the published numbers.
    """
    tub, load, unbalance = measures.Suspension(tub_mass=30.0, stiffness=2e4, damping=150.0), 4.0, 0.8
    rpm = np.array([100.0, 400.0, 800.0])
    found = [Check("resonance", "rpm", 231.6, tub.resonance(load) * 30.0 / math.pi, 0.05)]
    given = zip(
        rpm, (5.367, 34.96, 25.64), (0.474, 321.7, 692.1), (5e-4, 5e-3, 5e-3), (5e-4, 0.05, 0.05), strict=True
    )
    for turns, millimeters, watts, fine, coarse in given:
        speed = turns * math.pi / 30.0
        response = complex(tub.stiffness - 34.0 * speed**2, tub.damping * speed)
        exact = unbalance * speed**2 / abs(response)
        force = exact * abs(complex(tub.stiffness, tub.damping * speed))
        stroke, loss = tub.stroke(unbalance, load, speed), tub.loss(unbalance, load, speed)
        found += [
            Check(f"stroke at {turns:g} rpm", "mm", millimeters, 1e3 * stroke, fine),
            Check(f"loss at {turns:g} rpm", "W", watts, loss, coarse),
            Check(f"X at {turns:g} rpm", "m", exact, stroke, 1e-12 * exact),
            Check(
                f"floor force at {turns:g} rpm",
                "N",
                force,
                tub.floor_force(unbalance, load, speed),
                1e-12 * force,
            ),
        ]
    fine_rpm = np.linspace(20.0, 900.0, 300)
    speeds = fine_rpm * math.pi / 30.0
    curve = 0.8 * speeds**2 / np.abs(2e4 - 34.0 * speeds**2 + 150.0j * speeds)
    strokes = [tub.stroke(unbalance, load, turns * math.pi / 30.0) for turns in rpm]
    return Evidence(
        tuple(found), Panel("speed [rpm]", "stroke X [m]", (Trace("", rpm, strokes, (fine_rpm, curve)),))
    )


CASES = (unbalance, unbalance_force, suspension)
