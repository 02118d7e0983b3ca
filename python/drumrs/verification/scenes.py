"""Small worlds in which single laws show: free space, a floor, one drum; and many impacts in one run."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs import Config, Simulation, State, baseline
from drumrs.verification.advance import advance

Array = NDArray[np.float64]

_TABLE_1 = baseline()
TIME_STEP = _TABLE_1.derived.time_step
GRAVITY = -_TABLE_1.gravity[1]
RADIUS = _TABLE_1.load.diameter / 2.0
DRUM_RADIUS = _TABLE_1.drum.diameter / 2.0
MASS = _TABLE_1.derived.bundle_mass
PAIR_STIFFNESS, WALL_STIFFNESS = (
    table.normal_stiffness for table in (_TABLE_1.contact.bundle, _TABLE_1.contact.drum)
)
# ω₀ of a bundle against the drum and of two equal bundles [1/s].
WALL_FREQUENCY = float(np.sqrt(WALL_STIFFNESS / MASS))
PAIR_FREQUENCY = float(np.sqrt(2.0 * PAIR_STIFFNESS / MASS))
# Half the length of the floor [m].
FLOOR = 50.0
# Between bodies that must not meet others [m].
_APART = 0.1
# Longer than any run here [s].
_EVER = 20.0


def drum(changes: Mapping[str, Any] | None = None, *, fill: float = 0.25, baffles: bool = False) -> Config:
    """Return the baseline without frames, for as long as one likes, with some keys changed."""
    config = baseline(fill, baffles=baffles)
    return config.replace({"run.duration": _EVER, "run.frame_every": _EVER, **(changes or {})})


def free_space(changes: Mapping[str, Any] | None = None) -> Config:
    """Return free space without gravity: no drum, no walls."""
    still = {"drum.rim": False, "rotation.rpm": 0.0, "gravity": (0.0, 0.0), "run.sample_every": 1.0}
    return drum({**still, **(changes or {})})


def floor(changes: Mapping[str, Any] | None = None) -> Config:
    """Return a straight floor along the x axis, without gravity unless given."""
    return free_space({"drum.walls": [[[-FLOOR, 0.0], [FLOOR, 0.0]]], **(changes or {})})


def both(key: str, value: Any) -> dict[str, Any]:
    """Return a key of the contact law, for bundles and drum alike."""
    return {f"contact.{side}.{key}": value for side in ("bundle", "drum")}


def elastic(friction: float) -> dict[str, Any]:
    """Return the law of the impact tests in closed form: no damping, normal and tangential periods equal."""
    laws = {"restitution": 1.0, "stiffness_ratio": 1.0 / 3.0, "friction": friction}
    return {key: value for law in laws.items() for key, value in both(*law).items()}


def damping(ratio: float) -> dict[str, Any]:
    """Return the key of a dashpot against the drum, of a damping ratio."""
    return {"contact.drum.normal_damping": 2.0 * ratio * float(np.sqrt(WALL_STIFFNESS * MASS))}


def after(config: Config, state: State | None, seconds: float, *, samples: int = 1) -> Simulation:
    """Return a simulation that has run for a time, rounded up to whole steps, with so many samples on the way."""
    step = config.run.time_step
    length = TIME_STEP if step == "auto" else step
    every = max(1, -(-int(np.ceil(seconds / length)) // samples))
    interval = every * length
    # Memory is counted for what is simulated; the last third must have two samples, though no average is asked for.
    times = {"run.sample_every": interval, "run.duration": max(samples, 6) * interval}
    simulation = Simulation(config.replace(times), state=state)
    advance(simulation, every * samples)
    return simulation


def last(simulation: Simulation, column: str) -> float:
    """Return the last value of a recorded quantity."""
    return float(simulation.series[column][-1])


def phases(count: int) -> Array:
    """Return places within a step, in [0, 1), spread evenly."""
    return (np.arange(count) + 0.5) / count


def on_the_floor(velocities: ArrayLike, gaps: ArrayLike, spins: ArrayLike = 0.0) -> State:
    """Return discs above the floor, too far apart to meet.

    Parameters
    ----------
    velocities
        Velocities [m/s], shape (n, 2) or (2,).
    gaps
        Distances from the floor [m], shape (n,) or ().
    spins
        Spins [rad/s], shape (n,) or ().
    """
    count = max(np.atleast_2d(velocities).shape[0], np.size(gaps), np.size(spins))
    x = _APART * (np.arange(count) - count / 2.0)
    return State(
        positions=np.column_stack([x, RADIUS + np.broadcast_to(gaps, count)]),
        velocities=np.broadcast_to(velocities, (count, 2)),
        angular_velocities=np.broadcast_to(np.asarray(spins, dtype=float), count),
    )


def in_pairs(speed: float, gaps: ArrayLike) -> State:
    """Return pairs of equal bundles that approach along x, each with half the speed [m/s] and its gap [m]."""
    half = RADIUS + np.asarray(gaps, dtype=float) / 2.0
    x = _APART * (np.arange(len(half)) - len(half) / 2.0)
    ends = np.concatenate([x - half, x + half])
    speeds = np.repeat([speed / 2.0, -speed / 2.0], len(half))
    return State(
        positions=np.column_stack([ends, np.zeros_like(ends)]),
        velocities=np.column_stack([speeds, np.zeros_like(ends)]),
    )
