"""A change of speed under way: the run is that of the configuration with the change in it, bit for bit."""

import pytest

import drumrs
from drumrs.config.program import with_speed
from drumrs.errors import ConfigError, DrumrsError

SPEED = {"run.duration": 0.4, "run.sample_every": 0.001, "run.frame_every": 0.05, "run.time_step": "auto"}
PROGRAMS = {
    "one speed": {"rotation.rpm": 54.0},
    "knots": {"rotation.program": [[0.02, 0.0], [0.09, 50.0], [0.12, 50.0], [0.12, -20.0]]},
    "phases": {"rotation.phase": [{"duration": 0.07, "rpm": 30.0}, {"duration": 0.3, "ramp": [30.0, 60.0]}]},
}


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_changed_run_is_the_run_of_its_configuration(program):
    config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0).replace({**SPEED, **PROGRAMS[program]})
    simulation = drumrs.Simulation(config)
    for time, rpm in ((0.033, 70.0), (0.06, -40.0), (0.21, 0.0)):
        simulation.run(time)
        simulation.set_speed(rpm)
    simulation.run()
    again = drumrs.Simulation(drumrs.Config.from_toml(simulation.config.to_toml()))
    again.run()
    assert again.step == simulation.step
    assert again.series.equals(simulation.series)
    assert (again.positions == simulation.positions).all()
    assert (again.frames.positions == simulation.frames.positions).all()
    untouched = drumrs.Simulation(config)
    untouched.run()
    assert not untouched.series.equals(simulation.series)


def test_a_speed_that_cannot_be_leaves_the_simulation_as_it_was(short):
    simulation = drumrs.Simulation(short)
    simulation.run(steps=50)
    for rpm, ramp in ((float("nan"), 0.1), (float("inf"), 0.1), (60.0, 0.0), (60.0, -1.0)):
        with pytest.raises(ConfigError):
            simulation.set_speed(rpm, ramp)
    assert simulation.config == short
    with pytest.raises(DrumrsError, match="is being run"):
        simulation.run(steps=50, on_progress=lambda _: simulation.set_speed(60.0))
    simulation.run(steps=50)


def test_a_change_begins_where_its_ramp_ends_or_at_a_jump():
    jump = [(0.0, 0.0), (2.0, 0.0), (2.0, 54.0)]
    assert with_speed(jump, 9.0, 2.0, 0.1) == (*jump, (2.1, 9.0))
    assert with_speed([(1.0, 5.0), (2.0, 6.0)], 9.0, 0.5, 0.1) == ((0.5, 5.0), (0.6, 9.0))
    assert with_speed([(1.0, 5.0), (2.0, 6.0)], 9.0, 1.5, 0.1) == ((1.0, 5.0), (2.0, 6.0), (2.1, 9.0))
