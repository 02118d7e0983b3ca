"""Reading moves nothing: the bits of a run depend neither on who looks at it nor on the pieces it is run in."""

import threading

import pytest

import drumrs

STEPS = 4000


@pytest.fixture
def config():
    changes = {"run.duration": 1.0, "run.sample_every": 0.002, "run.frame_every": 0.01}
    return drumrs.baseline(0.3, baffles=True).softer(100.0).replace(changes)


@pytest.fixture
def undisturbed(config):
    simulation = drumrs.Simulation(config)
    simulation.run(steps=STEPS)
    return simulation


def bits(simulation, path):
    simulation.save(path)
    return path.read_bytes()


def test_a_thread_that_reads_changes_nothing(config, undisturbed, tmp_path):
    simulation = drumrs.Simulation(config)
    over = threading.Event()
    looks = []

    def read():
        while not over.is_set():
            looks.append(simulation.positions.sum())
            simulation.state.arrays()
            simulation.series.height  # noqa: B018 - reading is the point

    reader = threading.Thread(target=read)
    reader.start()
    simulation.run(steps=STEPS)
    over.set()
    reader.join()
    assert looks
    assert bits(simulation, tmp_path / "read") == bits(undisturbed, tmp_path / "alone")


def test_a_progress_callback_that_reads_changes_nothing(config, undisturbed, tmp_path):
    simulation = drumrs.Simulation(config)
    seen = []

    def look(step):
        assert simulation.step == step
        seen.append(simulation.series.height + len(simulation.frames) + simulation.velocities.sum())
        simulation.save(tmp_path / "on the way")

    simulation.run(steps=STEPS, on_progress=look)
    assert seen
    assert simulation.series.equals(undisturbed.series)
    assert bits(simulation, tmp_path / "read") == bits(undisturbed, tmp_path / "alone")


@pytest.mark.parametrize("pieces", [[1] * 50, [7, 50, 51, 333], [64, 32, 31, 33, 1]])
def test_pieces_change_nothing(config, undisturbed, tmp_path, pieces):
    simulation = drumrs.Simulation(config)
    for steps in pieces:
        simulation.run(steps=steps)
    simulation.run(steps=STEPS - sum(pieces))
    assert bits(simulation, tmp_path / "pieces") == bits(undisturbed, tmp_path / "whole")


def test_a_run_is_at_the_step_that_its_progress_says_and_no_slice_is_tiny(config):
    simulation = drumrs.Simulation(config)
    steps = []
    simulation.run(steps=220, on_progress=steps.append)
    slices = [later - earlier for earlier, later in zip([0, *steps], steps, strict=False)]
    assert steps[-1] == simulation.step == 220
    assert all(size >= 50 for size in slices[:-1])
