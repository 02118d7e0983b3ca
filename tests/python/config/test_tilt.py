"""A tilted axis: gravity in the plane falls by the cosine, and a simulation scales with it to the last bit."""

import math
import warnings

import pytest

import drumrs
from drumrs import ConfigError, DrumrsWarning

BASE = drumrs.baseline(0.1, baffles=True).replace(
    {"run.duration": 0.1, "run.time_step": 3e-6, "load.start_speed": 1.0}
)


def test_gravity_falls_by_the_cosine():
    assert BASE.plane_gravity == (0.0, -9.81)
    tilted = BASE.replace({"drum.tilt": -60.0})
    assert tilted.plane_gravity == pytest.approx((0.0, -9.81 / 2.0))
    assert tilted.derived.froude_number == pytest.approx(2.0 * BASE.derived.froude_number)
    assert tilted.derived.critical_share == pytest.approx(math.sqrt(2.0) * BASE.derived.critical_share)


def test_a_quarter_of_gravity_doubles_times_to_the_bit():
    # Of the numbers about 75.5 degrees one has a cosine of exactly 1/4.
    tilt = math.degrees(math.acos(0.25))
    tilts = [tilt + steps * math.ulp(tilt) for steps in range(-9, 10)]
    tilt = next(tilt for tilt in tilts if math.cos(math.radians(tilt)) == 0.25)
    slow = {
        "drum.tilt": tilt,
        "rotation.rpm": 54.0 / 2.0,
        "run.time_step": 6e-6,
        "run.duration": 0.2,
        "load.start_speed": 0.5,
        "contact.bundle.normal_stiffness": BASE.contact.bundle.normal_stiffness / 4.0,
        "contact.drum.normal_stiffness": BASE.contact.drum.normal_stiffness / 4.0,
    }
    one = drumrs.Simulation(BASE)
    with pytest.warns(DrumrsWarning, match="along the axis are left out"):
        other = drumrs.Simulation(BASE.replace(slow))
    for simulation in (one, other):
        simulation.run(steps=30_000)
    assert one.positions.tobytes() == other.positions.tobytes()
    assert one.velocities.tobytes() == (2.0 * other.velocities).tobytes()
    assert one.time * 2.0 == other.time


def test_a_slide_down_the_plane_takes_the_cosine():
    scene = {"drum.rim": False, "drum.baffles.count": 0, "rotation.rpm": 0.0, "load.count": 1}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DrumrsWarning)
        simulation = drumrs.Simulation(
            BASE.replace({**scene, "drum.tilt": 40.0}), state=drumrs.State([[0.0, 0.0]])
        )
    simulation.run(duration=0.1)
    fall = 0.5 * 9.81 * math.cos(math.radians(40.0)) * simulation.time**2
    assert -simulation.positions[0, 1] == pytest.approx(fall, rel=1e-4)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"drum.tilt": 90}, "drum.tilt is 90, but must be an angle above -90 and below 90 degrees"),
        (
            {"drum.tilt": 10, "gravity": [0, -1.62]},
            "drum.tilt is 10.0, but must be left out where gravity is given; drum.tilt takes its part of 9.81 m/s²; "
            "other gravity is given as gravity = [x, y] in the plane",
        ),
        (
            {"drum.tilt": "10 deg"},
            "drum.tilt is '10 deg', but must be an angle above -90 and below 90 degrees; write a number alone, without "
            "'deg', in degrees",
        ),
    ],
)
def test_bad_tilts_are_refused_in_a_sentence(changes, sentence):
    with pytest.raises(ConfigError) as refused:
        BASE.replace(changes)
    assert str(refused.value) == sentence
