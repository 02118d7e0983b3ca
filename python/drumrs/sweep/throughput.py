"""How fast cases go on this machine, to say beforehand how long they take."""

import time
from concurrent.futures import ThreadPoolExecutor

from drumrs.config import baseline
from drumrs.simulation import Simulation

# What the speed is measured on: a load that costs as much a particle-step as those of studies on average, once it has
# fallen and lies in contact.
_TRIAL_FILL = 0.5
_SETTLING = 0.3  # simulated seconds
_TRIAL = 0.25  # seconds of the wall clock


def measure_speed(jobs: int) -> float:
    """Return the particle-steps a second that so many runs at once make together, measured for a moment.

    Examples
    --------
    >>> from drumrs.sweep.throughput import measure_speed
    >>> measure_speed(1) > 1e5
    True
    """
    with ThreadPoolExecutor(jobs) as pool:
        return sum(pool.map(_speed, range(1, jobs + 1)))


def _speed(seed: int) -> float:
    simulation = Simulation(baseline(_TRIAL_FILL, baffles=True), seed=seed)
    simulation.run(duration=_SETTLING)
    first, began = simulation.step, time.perf_counter()
    simulation.run_to_step(simulation.last_step, wall_limit=_TRIAL)
    return (simulation.step - first) * simulation.count / (time.perf_counter() - began)
