"""The release of a disc from a lifter against the balance of forces, exact for a disc that does not spin."""

import math

import numpy as np
import pytest

import drumrs

RADIUS, GRAVITY = 0.02, 9.81
CENTER = 0.2375 - RADIUS  # distance of the disc's center from the axis


def carried(froude: float, lean: float, friction: float, start: float) -> drumrs.Simulation:
    """A disc in the corner of the rim and a plate, which leans back by an angle from the radial through its center."""
    speed = math.sqrt(froude * GRAVITY / CENTER)
    outwards = np.array([math.cos(start), math.sin(start)])
    ahead = np.array([-outwards[1], outwards[0]])
    inwards = -outwards * math.cos(lean) - ahead * math.sin(lean)
    foot = CENTER * outwards - RADIUS * (ahead * math.cos(lean) - outwards * math.sin(lean))
    config = drumrs.baseline().replace(
        {
            "drum.walls": [[(foot - 0.1 * inwards).tolist(), (foot + 0.1 * inwards).tolist()]],
            "rotation.rpm": speed * 30.0 / math.pi,
            "load.diameter": 2.0 * RADIUS,
            "load.count": 1,
            "load.spin_locked": True,
            "contact.drum.friction": friction,
            "run.time_step": "auto",
        }
    )
    state = drumrs.State([CENTER * outwards], [CENTER * speed * ahead])
    return drumrs.Simulation(config.softer(10.0), state=state)


@pytest.mark.parametrize(
    ("froude", "lean", "friction", "angle"),
    [
        (0.5, 0.0, 0.0, 30.0),
        (0.5, math.radians(20.0), math.tan(math.radians(15.0)), 24.87),
        (0.3, math.radians(30.0), 0.5, 13.99),
    ],
)
def test_a_disc_slides_off_a_lifter_where_the_balance_of_forces_says(froude, lean, friction, angle):
    phi = math.atan(friction)
    expected = math.asin(froude * math.cos(lean - phi)) - lean + phi
    assert math.degrees(expected) == pytest.approx(angle, abs=0.005)
    simulation = carried(froude, lean, friction, expected - math.radians(20.0))
    angles, ways = [], []
    while not ways or ways[-1] < 1e-4:
        simulation.run(steps=20)
        x, y = simulation.positions[0]
        angles.append(math.atan2(y, x))
        ways.append(CENTER - math.hypot(x, y))
    # It begins to slide without a jump of the acceleration, so the way grows as the cube of the time.
    angles, roots = np.array(angles), np.cbrt(ways)
    slope, start = np.polyfit(angles[roots > 0.0215], roots[roots > 0.0215], 1)
    released = -start / slope
    assert math.degrees(released) == pytest.approx(angle, abs=0.25)
