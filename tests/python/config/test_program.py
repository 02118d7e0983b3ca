"""Programs of the drum's speed: phases in the order of time, knots, and every bad input with its sentence."""

import math
import time

import pytest

import drumrs
from drumrs import ConfigError
from drumrs.config.program import MOST_PHASES

REVERSING = {
    "name": "wash",
    "repeat": 3,
    "reversing": True,
    "phase": [{"name": "tumble", "duration": 12.0, "rpm": 54.0}, {"duration": 3, "rpm": 0}],
}
SPIN = {"name": "spin up", "duration": 5.0, "ramp": [0.0, 400.0]}


def rotation(*phases):
    return drumrs.baseline().replace({"rotation.phase": phases}).rotation


def test_phases_follow_each_other_and_groups_repeat():
    intervals = rotation(REVERSING, SPIN).intervals
    told = [(each.name, each.start, each.end, each.speeds) for each in intervals]
    assert told == [
        ("tumble", 0.0, 12.0, (54.0, 54.0)),
        ("wash.2", 12.0, 15.0, (0.0, 0.0)),
        ("tumble", 15.0, 27.0, (-54.0, -54.0)),
        ("wash.2", 27.0, 30.0, (0.0, 0.0)),
        ("tumble", 30.0, 42.0, (54.0, 54.0)),
        ("wash.2", 42.0, 45.0, (0.0, 0.0)),
        ("spin up", 45.0, 50.0, (0.0, 400.0)),
    ]
    # A standstill has no direction.
    assert all(math.copysign(1.0, speed) == 1.0 for each in intervals[1::2] for speed in each.speeds)


def test_a_reversing_group_turns_what_is_in_it_the_other_way():
    inner = {"phase": [{"duration": 1.0, "rpm": 2.0}], "repeat": 2, "reversing": True}
    both = rotation({"phase": [inner, {"duration": 1.0, "ramp": [3.0, 4.0]}], "repeat": 2, "reversing": True})
    assert [each.speeds[1] for each in both.intervals] == [2.0, -2.0, 4.0, -2.0, 2.0, -4.0]


def test_phases_become_knots_with_jumps_where_speeds_differ():
    assert rotation({"duration": 2.0, "rpm": 10.0}, {"duration": 1.0, "ramp": [10.0, -5.0]}, SPIN).knots == (
        (0.0, 10.0),
        (2.0, 10.0),
        (3.0, -5.0),
        (3.0, 0.0),
        (8.0, 400.0),
    )


def test_phases_and_their_knots_are_one_simulation():
    config = drumrs.baseline(0.1, baffles=True).replace({"run.duration": 0.05})
    phases = [
        {"duration": 0.02, "rpm": 54.0},
        {"duration": 0.01, "ramp": [54.0, 0.0]},
        {"duration": 0.02, "rpm": -54.0},
    ]
    by_phase = config.replace({"rotation.phase": phases})
    by_knots = config.replace(
        {"rotation.program": [[0.0, 54.0], [0.02, 54.0], [0.03, 0.0], [0.03, -54.0], [0.05, -54.0]]}
    )
    ends = []
    for each in (by_phase, by_knots):
        simulation = drumrs.Simulation(each)
        simulation.run()
        ends.append((simulation.positions.tobytes(), simulation.drum_angle, simulation.drum_angular_velocity))
    assert ends[0] == ends[1]
    speed = 54.0 * math.pi / 30.0
    assert ends[0][1:] == pytest.approx((speed * (0.02 + 0.005 - 0.02), -speed), rel=1e-3)


def test_thousands_of_repeats_cost_no_time():
    config = drumrs.baseline(0.01).replace({"run.time_step": "auto"})
    phases = [
        {"phase": [{"duration": 1e-5, "rpm": 54.0}, {"duration": 1e-5, "rpm": -54.0}], "repeat": 50_000}
    ]
    many = drumrs.Simulation(config.replace({"rotation.phase": phases}))
    few = drumrs.Simulation(config.replace({"rotation.program": [[0.0, 54.0], [1.0, -54.0]]}))
    took = []
    for simulation in (few, many):
        simulation.run(duration=0.98)
        began = time.process_time()
        simulation.run(steps=20_000)
        took.append(time.process_time() - began)
    # A search knot by knot would cost a hundred times as much.
    assert took[1] < 10.0 * took[0]


BAD = {
    "no duration": (
        [{"rpm": 54.0}],
        "rotation.phase[0].duration is missing, but must be given: how many seconds the phase lasts",
    ),
    "no speed": (
        [{"duration": 1.0}],
        "rotation.phase[0].rpm is missing, but must be given, or rotation.phase[0].ramp "
        "or rotation.phase[0].phase instead",
    ),
    "two speeds": (
        [{"duration": 1.0, "rpm": 5.0, "ramp": [0, 5]}],
        "rotation.phase[0].rpm and rotation.phase[0].ramp are both given (5.0 and [0.0, 5.0]), "
        "but only one of them may be",
    ),
    "a group that lasts": (
        [{"duration": 4.0, "phase": [{"duration": 1.0, "rpm": 5.0}]}],
        "rotation.phase[0].duration is 4.0, but must be left out of a group, which lasts as long as its phases",
    ),
    "a phase that repeats": (
        [{"duration": 4.0, "rpm": 5.0, "repeat": 2}],
        "rotation.phase[0].repeat is 2, but must be left out of a phase that is no group; "
        "a group is { phase = [{ … }, { … }], repeat = 10 }",
    ),
    "a phase that reverses": (
        [{"duration": 4.0, "rpm": 5.0, "reversing": True}],
        "rotation.phase[0].reversing is True, but must be left out of a phase that is no group; "
        "a group is { phase = [{ … }, { … }], repeat = 10 }",
    ),
    "too many": (
        [{"phase": [{"phase": [{"duration": 1, "rpm": 1}], "repeat": 1000}], "repeat": 1000}],
        f"rotation.phase has 1000000 phases, repeats counted, but must have at most {MOST_PHASES} of them; "
        "lower repeat, or shorten the program to the time that is simulated",
    ),
    "none": (
        [],
        "rotation.phase is [], but must be a list of phases: tables with name, duration, and rpm or ramp, or a "
        "group with phase and repeat",
    ),
    "backwards in time": (
        [{"phase": [{"duration": -1, "rpm": 1}]}],
        "rotation.phase[0].phase[0].duration is -1, but must be a positive finite number",
    ),
    "misspelled": (
        [{"phase": [{"duraton": 1, "rpm": 1}]}],
        "rotation.phase[0].phase[0].duraton is not a key; did you mean rotation.phase[0].phase[0].duration?",
    ),
    "half a ramp": (
        [{"duration": 1, "ramp": [1]}],
        "rotation.phase[0].ramp is [1], but must be a pair [from, to] of speeds",
    ),
    "a name that is none": (
        [{"name": 3, "duration": 1, "rpm": 1}],
        "rotation.phase[0].name is 3, but must be a name of 1 to 60 characters",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_phases_are_refused_in_a_sentence(name):
    phases, sentence = BAD[name]
    with pytest.raises(ConfigError) as refused:
        drumrs.baseline().replace({"rotation.phase": phases})
    assert str(refused.value) == sentence


@pytest.mark.parametrize(
    ("knots", "sentence"),
    [
        (
            [[0, 1], [2, 3], [1, 4]],
            "rotation.program[2] is at 1.0 s, but must be no earlier than the knot before it, which is at 2.0 s",
        ),
        (
            [[0, 1], [2, 3], [2, 4], [2, 5]],
            "rotation.program[3] is at 2.0 s, but must be later than the two knots before it, which are a jump",
        ),
    ],
)
def test_bad_knots_are_refused_in_a_sentence(knots, sentence):
    with pytest.raises(ConfigError) as refused:
        drumrs.baseline().replace({"rotation.program": knots})
    assert str(refused.value) == sentence


def test_one_way_to_turn_takes_the_place_of_the_others():
    phases = drumrs.baseline().replace({"rotation.phase": [SPIN]})
    assert phases.rotation.rpm is None
    assert phases.replace({"rotation.program": [[0, 1]]}).rotation.phase is None
    assert phases.replace({"rotation.rpm": 5}).rotation.intervals == []
    with pytest.raises(ConfigError, match=r"rotation\.program and rotation\.phase are both given"):
        drumrs.baseline().replace({"rotation": {"program": [[0, 1]], "phase": [SPIN]}})
