"""The promises kept bit for bit: scaling, mirror, restart, threads, neighbor list; and relabelling, to round-off."""

import math
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs import Config, Simulation, State
from drumrs.verification import scenes
from drumrs.verification.advance import advance
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, shared_curve
from drumrs.verification.scenes import RADIUS

Array = NDArray[np.float64]

_MOST_DRAWN = 60
_BED_STEPS = 2000
_CROWD_STEPS = 1200


def _numbers(run: Simulation) -> Array:
    """Return everything that a simulation returns: motion of every bundle, every sample."""
    state = run.state
    parts = (state.positions, state.velocities, state.angles, state.angular_velocities)
    return np.concatenate(
        [np.ravel(np.asarray(part, float)) for part in parts] + [run.series.to_numpy().ravel()]
    )


def _differing(one: Array, other: Array) -> float:
    """Return how many numbers differ in any bit."""
    if one.shape != other.shape:
        return float(max(one.size, other.size))
    return float(np.count_nonzero(one.view(np.int64) != other.view(np.int64)))


def _diagonal(runs: Mapping[str, Array], reference: Array, of_what: str) -> Panel:
    """Draw coordinates of one run against those of others by label, thinned out."""
    pick = slice(None, None, max(1, reference.size // _MOST_DRAWN))
    limits = [float(reference.min()), float(reference.max())]
    traces = [Trace(label, reference.ravel()[pick], run.ravel()[pick]) for label, run in runs.items()]
    return Panel("coordinates [m]", f"coordinates {of_what} [m]", (shared_curve(limits, limits), *traces))


def _small(baffles: bool, changes: dict[str, Any] | None = None) -> Config:
    """Return Table 1 with thrown bundles, which make contacts of every kind early."""
    thrown = {"load.start_speed": 1.0, "run.sample_every": 0.001}
    return scenes.drum({**thrown, **(changes or {})}, fill=0.3, baffles=baffles)


def _ran(config: Config, steps: int, threads: int = 1, state: State | None = None) -> Simulation:
    run = Simulation(config, seed=7, threads=threads, state=state)
    advance(run, steps)
    return run


def _scaled(config: Config, mass: float) -> Config:
    """Return lengths × 4, times × 2, masses × `mass`, gravity as it is."""
    large = config.scaled(4.0)
    contact, heavier = large.contact, mass / 16.0  # factor beyond the 16 of the areas
    return large.replace(
        {
            "load.density": large.load.density * heavier,
            "contact.drum.normal_damping": (contact.drum.normal_damping or 0.0) * heavier,
            "contact.bundle.normal_stiffness": contact.bundle.normal_stiffness * heavier,
            "contact.drum.normal_stiffness": contact.drum.normal_stiffness * heavier,
        }
    )


@case(
    "scaling",
    source="similarity",
    formula="lengths × 4, times × 2, masses × 2ᵏ: x × 4, v × 2, ω / 2",
    cost=2e7,
)
def scaling() -> Evidence:
    """A drum four times as large, with masses scaled by powers of two: the scaled trajectory.

    Every bit: powers of two scale without rounding, so one differing number betrays a hidden constant.
    """
    program = [[0.0, 54.0], [0.02, -54.0], [0.06, 27.0]]
    changes = {"rotation.program": program, "contact.drum.normal_damping": 7.74e3}
    found, runs = [], {}
    for baffles in (False, True):
        config = _small(baffles, changes)
        plain = _ran(config, 20_000)
        for mass in (1.0, 64.0):
            large = _ran(_scaled(config, mass), 20_000)
            label = f"{'3 baffles' if baffles else 'no baffles'}, masses × {mass:g}"
            found.append(Check(f"numbers that differ, {label}", "1", 0.0, _unlike(plain, large, mass), 0.0))
            if baffles:
                runs[f"masses × {mass:g}"] = large.positions / 4.0
    return Evidence(tuple(found), _diagonal(runs, plain.positions, "of the large drum / 4"))


def _unlike(plain: Simulation, large: Simulation, mass: float) -> float:
    """Return how many numbers of the large drum are not the scaled ones of the plain one."""
    pairs = (
        (plain.positions * 4.0, large.positions),
        (plain.velocities * 2.0, large.velocities),
        (plain.angular_velocities * 0.5, large.angular_velocities),
        *(
            (plain.series[name].to_numpy() * 4.0 * mass, large.series[name].to_numpy())
            for name in ("drum_work", "dissipated_normal", "dissipated_sliding", "elastic_normal")
        ),
    )
    return sum(_differing(np.ravel(one), np.ravel(other)) for one, other in pairs)


@case("mirror", source="symmetry", formula="x → −x, Ω → −Ω: x → −x, ω → −ω", cost=4e6)
def mirror() -> Evidence:
    """A bare drum reversed and mirrored gives the mirrored trajectory.

    Every bit: a change of sign does not round.
    """
    config = _small(baffles=False)
    start = Simulation(config, seed=7).state
    flip = np.array([-1.0, 1.0])
    turned = State(np.asarray(start.positions) * flip, np.asarray(start.velocities) * flip)
    plain = _ran(config, 20_000, state=State(start.positions, start.velocities))
    other = _ran(config.replace({"rotation.rpm": -54.0}), 20_000, state=turned)
    pairs = (
        ("positions", plain.positions, other.positions * flip),
        ("velocities", plain.velocities, other.velocities * flip),
        ("spins", plain.angular_velocities, -other.angular_velocities),
    )
    # Zero has two signs, which count as one here.
    found = [
        Check(f"{name} that differ", "1", 0.0, float(np.count_nonzero(one != another)), 0.0)
        for name, one, another in pairs
    ]
    return Evidence(tuple(found), _diagonal({"": other.positions * flip}, plain.positions, "mirrored back"))


@case("relabelling", source="symmetry", formula="permuted bundles: the permuted trajectory", cost=1e7)
def relabelling() -> Evidence:
    """Bundles in another order give the same trajectory, but for round-off.

    Sums run in another order then, and their round-off grows with every collision. How far is measured: the same bed
    with every coordinate moved by one unit in the last place, four times. Ten times the greatest growth is allowed,
    and that must be below 10⁻⁴ r for the comparison to mean anything.
    """
    config, bed = _bed()
    positions, velocities, spins = (
        np.asarray(a) for a in (bed.positions, bed.velocities, bed.angular_velocities)
    )

    def end_positions(at: Array, order: Any = slice(None)) -> Array:
        start = State(at[order], velocities[order], angular_velocities=spins[order])
        return np.asarray(_ran(config, _BED_STEPS, state=start).positions)

    order = (np.arange(len(positions)) * 37 + 11) % len(positions)
    plain, back = end_positions(positions), np.empty_like(positions)
    back[order] = end_positions(positions, order)
    draws = np.random.default_rng(1)
    directions = [draws.choice([-np.inf, np.inf], positions.shape) for _ in range(4)]
    growth = max(
        float(np.abs(end_positions(np.nextafter(positions, direction)) - plain).max())
        for direction in directions
    )
    apart = float(np.abs(back - plain).max())
    found = (
        Check("greatest distance", "m", 0.0, apart, 10.0 * growth),
        Check("growth of a last place, over r", "1", 0.0, growth / RADIUS, 1e-4),
    )
    return Evidence(found, _diagonal({"": back}, plain, "relabelled"))


def _bed() -> tuple[Config, State]:
    """Return a drum, and its load as a bed that has come to rest in it."""
    config = scenes.drum(fill=0.3, baffles=True)
    still = {"rotation.rpm": 0.0, "run.time_step": 1.5e-5}
    return config, _ran(config.replace(still), 20_000).state


@case("restart", source="promise", formula="the same bits", cost=2e7)
def restart() -> Evidence:
    """A run taken up again from a checkpoint at odd steps, on another number of threads, goes on bit for bit.

    Every bit: 0 numbers may differ.
    """
    found, runs = [], {}
    config = _small(baffles=True)
    straight = _ran(config, 12_000)
    with tempfile.TemporaryDirectory() as folder:
        for step in (1, 4567, 11_111):
            first = _ran(config, step)
            path = Path(folder) / f"{step}.bin"
            first.save(path)
            resumed = Simulation.load(path, threads=2)
            advance(resumed, 12_000 - step)
            differing = _differing(_numbers(straight), _numbers(resumed))
            found.append(Check(f"numbers that differ, restart at step {step}", "1", 0.0, differing, 0.0))
            runs[f"step {step}"] = resumed.positions
    return Evidence(tuple(found), _diagonal(runs, straight.positions, "after a restart"))


@case("skins", source="promise", formula="the same bits", cost=3e7)
def skins() -> Evidence:
    """Any margin of the neighbor list gives the same trajectory.

    Every bit: 0 numbers may differ.
    """
    found, runs = [], {}
    for baffles in (False, True):
        config = _small(baffles=baffles)
        reference = _ran(config, 12_000)
        for skin in (0.0, 1e-5, 0.1 * RADIUS, 2.0 * RADIUS):
            other = _ran(config.replace({"run.skin": skin}), 12_000)
            differing = _differing(_numbers(reference), _numbers(other))
            case_name = f"skin {skin / RADIUS:.2g} r, {'3 baffles' if baffles else 'no baffles'}"
            found.append(Check(f"numbers that differ, {case_name}", "1", 0.0, differing, 0.0))
            if baffles:
                runs[f"{skin / RADIUS:.2g} r"] = other.positions
    return Evidence(tuple(found), _diagonal(runs, reference.positions, "with another skin"))


@case("threads", source="promise", formula="the same bits", cost=5e7)
def threads() -> Evidence:
    """Any number of threads gives the same trajectory: 9 000 bundles round five large discs.

    Every bit: 0 numbers may differ. Each large disc touches bundles of different threads, so that an order
    of sums that depended on threads would show.
    """
    config, start = _crowd()
    reference = _ran(config, _CROWD_STEPS, state=start)
    found, runs = [], {}
    for number in (2, 3):
        other = _ran(config, _CROWD_STEPS, threads=number, state=start)
        differing = _differing(_numbers(reference), _numbers(other))
        found.append(Check(f"numbers that differ, {number} threads", "1", 0.0, differing, 0.0))
        runs[f"{number} threads"] = other.positions
    return Evidence(tuple(found), _diagonal(runs, reference.positions, "with more threads"))


def _crowd() -> tuple[Config, State]:
    """Return a drum of thrown bundles, and five large discs at rest in the place of some of them."""
    changes = {"drum.diameter": 2.95, "load.count": 10_200, "load.start_speed": 5.0}
    config = _small(baffles=False, changes=changes)
    packed = Simulation(config, seed=7).state
    positions, velocities = np.asarray(packed.positions), np.asarray(packed.velocities)
    angles, large = np.linspace(0.0, math.tau, 5, endpoint=False), 0.2
    centers = 0.8 * np.column_stack([np.cos(angles), np.sin(angles)])
    distances = np.linalg.norm(positions[:, None] - centers, axis=2).min(axis=1)
    kept = distances > large + RADIUS
    radii = np.where(np.arange(kept.sum() + len(centers)) < len(centers), large, RADIUS)
    still = np.zeros_like(centers)
    return config, State(
        np.vstack([centers, positions[kept]]), np.vstack([still, velocities[kept]]), radii=radii
    )


CASES = (scaling, mirror, relabelling, restart, threads, skins)
