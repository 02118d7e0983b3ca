"""Values in another unit than they are read in: one sentence that says what to write."""

import math
import warnings

import pytest

import drumrs

BASE = drumrs.baseline(baffles=True).replace({"run.time_step": "auto"})
IN_MILLIMETERS = {"drum.diameter": 475.0, "load.diameter": 23.75, "drum.baffles.count": 0}
HERTZ = {"contact.base": "hertz", "contact.bundle.young_modulus": 1e8, "contact.drum.young_modulus": 1e8}

HINTS = {
    "slow": (
        {"rotation.rpm": 1.5},
        "rotation.rpm reaches 1.5 rpm, a Froude number of 0.0006, but loads tumble between "
        "0.001 and 3: write 14.32 (Froude number 0.054) where rad/s were meant or 90 (Froude number 2.2) where "
        "revolutions per second were meant",
    ),
    "fast": (
        {"rotation.rpm": 324.0},
        "rotation.rpm reaches 324 rpm, a Froude number of 28, but loads tumble between "
        "0.001 and 3: write 54 (Froude number 0.77) where degrees per second were meant",
    ),
    "very fast": (
        {"rotation.rpm": 1e4},
        "rotation.rpm reaches 10000 rpm, a Froude number of 2.7e+04, but loads tumble between 0.001 and 3",
    ),
    "program": (
        {"rotation.program": [[0.0, 0.0], [1.0, -0.9], [2.0, 0.5]]},
        "rotation.program reaches 0.9 rpm, a Froude number of 0.00022, but loads tumble "
        "between 0.001 and 3: write 8.594 (Froude number 0.02) where rad/s were meant or 54 (Froude number 0.77) "
        "where revolutions per second were meant",
    ),
    "bundle": (
        {"drum.diameter": 19.0, "load.diameter": 2.375, "drum.baffles.count": 0},
        "load.diameter is 2.375 m, above 0.2: write 0.02375 where centimeters were meant "
        "or 0.002375 where millimeters were meant",
    ),
    "small bundle": (
        {"load.diameter": 2.375e-5, "load.count": 10},
        "load.diameter is 2.375e-05 m, below 0.0001: is it in m?",
    ),
    "walls": (
        {"drum.walls": [[[0.0, 0.1], [0.1, 0.1]], [[-0.2, 0.5], [-0.2, 0.6]]]},
        "drum.walls[1] is 0.6 m from the axis, above 0.475: write 0.006 where centimeters were meant or 0.0006 where "
        "millimeters were meant",
    ),
    "density": (
        {"load.density": 1.2},
        "load.density is 1.2 kg/m³, below 5: write 1200 where g/cm³ were meant",
    ),
    "gravity": (
        {"gravity": [0.0, -9810.0]},
        "gravity is 9810 m/s², above 100: write 98.1 where cm/s² were meant or 9.81 where mm/s² were meant",
    ),
    "modulus": (
        {**HERTZ, "contact.drum.young_modulus": 210.0},
        "contact.drum.young_modulus is 210 Pa, below 1000: write 2.1e+08 where MPa were meant or 2.1e+11 where GPa "
        "were meant",
    ),
    "phases": (
        {"rotation.phase": [{"duration": 20.0, "rpm": 54.0}] * 2},
        "rotation.phase lasts 40 s, run.duration 30 s: what comes later is not simulated; for the whole program set "
        "run.duration = 40",
    ),
    "tilt": (
        {"drum.tilt": 30.0},
        "drum.tilt is 30 degrees: 8.496 m/s² of gravity act in the plane; 4.905 m/s² along the axis are left out, and "
        "with them what the load does towards the end walls",
    ),
    "shell": (
        {
            "drum.baffles.count": 0,
            "drum.rim": False,
            "drum.liner.outlines": [{"points": [[-200, -200], [200, -200], [200, 200], [-200, 200]]}],
            "load.fill": None,
            "load.count": 10,
        },
        "drum.liner.outlines is 451.352 m, above 20: write 4.51352 where centimeters were meant or 0.451352 where "
        "millimeters were meant",
    ),
    "moisture": (
        {"load.moisture": 60.0},
        "load.moisture is 60 kg per kg, above 5: write 0.6 where per cent were meant",
    ),
    "rail": (
        {"drum.baffles.count": 0, "drum.liner.rail": {"count": 8, "face_angle": 0.61}},
        "drum.liner.rail.face_angle is 0.61 degrees: write 35 where radians were meant",
    ),
    "phase": (
        {"drum.baffles.phase": -1.047},
        "drum.baffles.phase is -1.047 degrees: write -60 where radians were meant",
    ),
}


@pytest.mark.parametrize("name", HINTS)
def test_a_value_in_another_unit_is_told_with_what_to_write(name):
    changes, hint = HINTS[name]
    assert BASE.replace(changes).hints == [hint]


def test_lengths_in_millimeters_are_told_once_each_and_nothing_of_what_follows():
    assert BASE.replace(IN_MILLIMETERS).hints == [
        "load.diameter is 23.75 m, above 0.2: write 0.02375 where millimeters were meant",
        "drum.diameter is 475 m, above 20: write 4.75 where centimeters were meant "
        "or 0.475 where millimeters were meant",
    ]


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"rotation.rpm": 0.0},
        {"rotation.rpm": -2.0},
        {"rotation.rpm": math.sqrt(1e-3 * 9.81 / 0.2375) * 30.0 / math.pi},
        {"rotation.rpm": 105.0},
        {"rotation.program": [[0.0, 0.0], [5.0, 54.0], [10.0, 800.0]]},
        {"load.diameter": 0.1, "load.count": 2},
        {"drum.baffles.phase": 1.0},
        {"rotation.phase": [{"duration": 0.1, "rpm": 54.0}] * 300},
        {"drum.baffles.phase": 30.0},
        {"drum.baffles.count": 0, "drum.baffles.phase": 1.57},
        {"gravity": [0.0, 0.0]},
        {"drum.walls": [[[0.0, 0.1], [0.1, 0.1]]]},
        {"drum.rim": False, "drum.baffles.count": 0, "drum.walls": [[[-5.0, 0.0], [5.0, 0.0]]]},
        HERTZ,
    ],
)
def test_ordinary_values_are_not_told(changes):
    assert BASE.replace(changes).hints == []


def test_a_tilt_in_radians():
    assert (
        BASE.replace({"drum.tilt": 0.26}).hints[0]
        == "drum.tilt is 0.26 degrees: write 15 where radians were meant"
    )


def test_radians_to_the_last_digit_and_to_two():
    for phase in (0.52, 0.5236, 3.141592653589793 / 6.0):
        (hint,) = BASE.replace({"drum.baffles.phase": phase}).hints
        assert hint.endswith("write 30 where radians were meant")


def test_a_simulation_warns_and_runs():
    with pytest.warns(drumrs.DrumrsWarning, match="load.density is 1 kg/m³, below 5: write 1000") as told:
        simulation = drumrs.Simulation(BASE.replace({"load.density": 1.0, "load.count": 3}))
    assert [str(one.message) for one in told] == simulation.warnings
    simulation.run(steps=3)


def test_a_given_load_is_not_judged_by_the_configured_size():
    state = drumrs.State([[0.0, 0.0]], radii=[0.05])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        config = BASE.replace(
            {"load.diameter": 0.0002, "load.count": 1, "run.time_step": 1e-5, "drum.baffles.count": 0}
        )
        assert drumrs.Simulation(config, state=state).warnings == []


def test_the_command_line_places_the_case_first(drum):
    words = ["--set=load.count=2", "--set=run.duration=1e-5", "--set=run.sample_every=1e-6", "--json"]
    _, _, told = drum("run", *words)
    assert told.splitlines()[0] == (
        "drumrs: Froude number 0.774, 85.8 % of the critical speed, load 0.886 kg per m of depth, "
        "51.5 steps per collision"
    )
    _, _, told = drum("run", *words, "--set=load.density=1", "--set=run.time_step=auto")
    assert "drumrs: note that load.density is 1 kg/m³" in told
