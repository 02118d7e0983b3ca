"""One process's simulations on many threads, in forked and spawned children, copied and pickled."""

import copy
import multiprocessing
import os
import pickle
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

import drumrs
from drumrs.errors import DrumrsError, UnstableError

LONG = {"run.duration": 60.0}
# Enough bundles that their steps are shared by threads.
LARGE = drumrs.baseline().replace(
    {"load.diameter": 0.004, "load.fill": 0.6, "run.time_step": "auto", "run.frame_every": 30.0}
)


def bits(simulation: drumrs.Simulation) -> tuple[int, bytes, bytes]:
    return simulation.step, simulation.positions.tobytes(), simulation.velocities.tobytes()


def after(config: drumrs.Config, steps: int) -> tuple[int, bytes, bytes]:
    """Also what a child process does; must be found by name."""
    simulation = drumrs.Simulation(config)
    simulation.run(steps=steps)
    return bits(simulation)


def test_a_running_simulation_is_not_run_by_a_second_thread(short):
    simulation = drumrs.Simulation(short.replace(LONG))
    thread = threading.Thread(target=simulation.run)
    thread.start()
    while simulation.step == 0:
        time.sleep(0.01)
    with pytest.raises(DrumrsError, match="is being run already"):
        simulation.run(steps=10)
    # It can be looked at, copied and saved meanwhile.
    assert copy.copy(simulation).step <= simulation.step
    simulation.stop()
    thread.join()
    step = simulation.step
    simulation.run(steps=10)
    assert simulation.step == step + 10


def test_a_callback_does_not_run_its_own_simulation(short):
    simulation = drumrs.Simulation(short)
    with pytest.raises(DrumrsError, match="is being run already"):
        simulation.run(steps=100, on_progress=lambda _: simulation.run(steps=1))
    simulation.run(steps=1)


def test_simulations_on_threads_do_not_disturb_each_other(short):
    configs = [short.replace({"run.seed": seed}) for seed in range(6)]
    with ThreadPoolExecutor(6) as pool:
        together = list(pool.map(after, configs, [3000] * 6))
    assert together == [after(config, 3000) for config in configs]


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_a_copy_goes_on_by_itself_with_the_same_bits(short, again):
    one = drumrs.Simulation(short, seed=4, threads=2)
    one.run(steps=2500)
    other = again(one)
    assert (other.config, other.seed, other.threads) == (one.config, 4, 2)
    one.run(steps=1000)
    assert other.step == 2500
    other.run(steps=1000)
    assert bits(one) == bits(other)
    assert one.series.equals(other.series)


def test_a_copy_of_an_unstable_simulation_is_refused(short):
    state = drumrs.State(positions=[[0.0, 0.0], [0.1, 0.0]], velocities=[[1e4, 0.0], [-1e4, 0.0]])
    simulation = drumrs.Simulation(short, state=state)
    with pytest.raises(UnstableError):
        simulation.run()
    with pytest.raises(UnstableError):
        copy.copy(simulation)


def test_results_configurations_and_states_pickle(short):
    result = drumrs.run(short, progress=False)
    for again in (copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))):
        other = again(result)
        assert (other.config, other.summary) == (result.config, result.summary)
        assert other.series.equals(result.series)
        assert np.array_equal(other.frames.positions, result.frames.positions)
        assert again(short) == short
        assert again(short).digest == short.digest
    state = pickle.loads(pickle.dumps(drumrs.Simulation(short).state))
    assert np.array_equal(state.positions, drumrs.Simulation(short).positions)


def test_a_spawned_process_gives_the_same_bits(short):
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(after, short, 1000).result(timeout=60) == after(short, 1000)


def in_a_fork(work) -> bytes:
    """Do `work` in a forked child and return its words; a child that hangs is ended and fails."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(write, work())
        finally:
            os._exit(0)
    os.close(write)
    end = time.monotonic() + 30.0
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        if time.monotonic() > end:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            os.close(read)
            pytest.fail("the forked child hangs")
        time.sleep(0.01)
    with os.fdopen(read, "rb") as pipe:
        return pipe.read()


def hashed(simulation: drumrs.Simulation) -> bytes:
    return repr((simulation.step, hash(simulation.positions.tobytes()))).encode()


def test_a_forked_child_goes_on_without_the_threads_it_has_lost():
    held = [drumrs.Simulation(LARGE, threads=2)]
    held[0].run(steps=3)

    def work() -> bytes:
        held[0].run(steps=5)
        told = hashed(held[0])
        # Nobody may be waited for when it is dropped.
        held.clear()
        return told

    in_child = in_a_fork(work)
    held[0].run(steps=5)
    assert in_child == hashed(held[0])


def test_a_child_forked_in_the_middle_of_a_run_is_not_locked_out(short):
    simulation = drumrs.Simulation(short.replace(LONG))
    thread = threading.Thread(target=simulation.run)
    thread.start()
    while simulation.step == 0:
        time.sleep(0.01)

    def work() -> bytes:
        other = copy.copy(simulation)
        other.run(steps=10)
        try:
            simulation.run(steps=1)
        except DrumrsError as error:
            return f"{other.step - simulation.step} {error}".encode()
        return b"ran"

    for _ in range(20):
        assert in_a_fork(work).startswith(b"10 this simulation is being run already")
    simulation.stop()
    thread.join()
