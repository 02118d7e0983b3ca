"""Settled, turning beds: what every code starts from where its speed is measured."""

import math
from pathlib import Path

import numpy as np

import drumrs
from codes.case import Array, Case
from drumrs.paper.drums import BARE, TRIANGLES

# Up to here the drum is Table 1's; above, it grows with its load at this fill and one Froude number.
_TABLE_1 = 300
_FILL = 0.4
# Larger beds are made of pieces of this one.
_LARGEST_TUMBLED = 10_000
# Springs that are ten times softer while a large bed tumbles save a factor of three, and bend by 0.3 % of the radius.
_SOFTER = 10.0
# A drum tumbles for so many times the square root of its radius over gravity: four turns, or two thirds of one.
_TUMBLED = 30.0
_TUMBLED_LARGE = 4.7
_REST = 0.02


def settled(count: int, folder: Path, *, baffles: bool = False) -> Case:
    """Return a drum with a settled load of so many bundles; kept in a folder, and read back from there.

    Parameters
    ----------
    count
        Number of bundles: up to 300 in Table 1's drum, above in a bare drum that grows with them.
    folder
        Where the beds are kept.
    baffles
        Whether the drum has three baffles, triangles of 5 by 6 cm.
    """
    config = grown(count, baffles=baffles)
    path = folder / f"{config.digest}.npz"
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        tumbled = count <= _LARGEST_TUMBLED
        motion, angle = _tumbled(config) if tumbled else (_pieced(config, folder), 0.0)
        np.savez(path, motion=motion, angle=angle)
    with np.load(path) as kept:
        motion, angle = kept["motion"], float(kept["angle"])
    # The baffles are where the tumbling has left them.
    return Case(config.replace({"drum.baffles.phase": math.degrees(angle)}), _state(motion))


def grown(count: int, *, baffles: bool = False) -> drumrs.Config:
    """Return the configuration of a drum for so many bundles, with the Froude number of Table 1."""
    base = (TRIANGLES if baffles else BARE).config().replace({"load.count": count})
    if count <= _TABLE_1:
        return base
    diameter = base.load.diameter * math.sqrt(count / _FILL)
    rpm = (base.rotation.rpm or 0.0) * math.sqrt(base.drum.diameter / diameter)
    # A time whose frames fit into memory, however many bundles; it is never run to its end.
    return base.replace({"drum.diameter": diameter, "rotation.rpm": rpm, "run.duration": 2.0})


def _tumbled(config: drumrs.Config) -> tuple[Array, float]:
    """Pack a drum and let it turn until the load tumbles; return the motion and the drum's angle [rad]."""
    large = config.bundle_count > _TABLE_1
    times = _TUMBLED_LARGE if large else _TUMBLED
    duration = times * math.sqrt(config.drum.diameter / 2.0 / 9.81)
    first = config.softer(_SOFTER) if large else config
    simulation = drumrs.Simulation(first, seed=1)
    simulation.run(duration=duration)
    if large:
        # Large drums are bare: where they stand does not matter.
        simulation = drumrs.Simulation(config, state=simulation.state)
        simulation.run(duration=_REST)
    return Case(config, simulation.state).motion(), simulation.drum_angle


def _pieced(config: drumrs.Config, folder: Path) -> Array:
    """Fill a drum from below with copies of a square from within a smaller settled bed.

    Where two copies meet, one of two bundles that overlap is left out. Within a copy contacts are those of the bed, and
    so are velocities as seen from the drum.
    """
    size, piece = _piece(folder)
    radius, diameter = config.drum.diameter / 2.0, config.load.diameter
    reach = math.ceil(2.0 * radius / size)
    shifts = size * np.array([(i, j) for j in range(reach) for i in range(reach)]) - radius
    motion = np.tile(piece, (len(shifts), 1))
    motion[:, :2] += np.repeat(shifts, len(piece), axis=0)
    motion = motion[np.hypot(*motion[:, :2].T) < radius - 0.5 * diameter]
    lowest = np.argsort(motion[:, 1], kind="stable")[: config.bundle_count]
    if len(lowest) < config.bundle_count:
        raise ValueError(f"{config.bundle_count} bundles do not fit; {len(lowest)} do")
    return _turned(motion[lowest], config.derived.angular_velocity or 0.0)


def _turned(motion: Array, omega: float) -> Array:
    """Add a rotation about the axis, at an angular velocity [rad/s], to velocities and spins."""
    x, y = motion[:, 0], motion[:, 1]
    added = np.column_stack(
        [np.zeros_like(x), np.zeros_like(x), -omega * y, omega * x, np.full_like(x, omega)]
    )
    return motion + added


def _piece(folder: Path) -> tuple[float, Array]:
    """Return side [m] and bundles of a square from the middle of a settled bed; its copies tile the plane.

    Velocities are as seen from the drum.
    """
    bed = settled(_LARGEST_TUMBLED, folder)
    diameter = bed.config.load.diameter
    motion = _turned(bed.motion(), -bed.angular_velocity)
    center = motion[:, :2].mean(axis=0)
    # A square that lies within the bed: the bed is a segment about as deep as the radius.
    half = 0.3 * bed.radius
    moved = motion.copy()
    moved[:, :2] += half - center
    size = 2.0 * half
    square = moved[((moved[:, :2] >= 0.0) & (moved[:, :2] < size)).all(axis=1)]
    return size, square[_apart_across_edges(square[:, :2], size, diameter)]


def _apart_across_edges(places: Array, size: float, diameter: float) -> Array:
    """Choose bundles of which none overlaps one of the copy to the right or above, beyond what a contact does."""
    near = 0.999 * diameter
    chosen = np.ones(len(places), dtype=bool)
    for shift in ((size, 0.0), (0.0, size), (size, size), (-size, size)):
        close = np.flatnonzero(
            ((places + shift < size + diameter) & (places + shift > -diameter)).all(axis=1)
        )
        for k in close:
            gaps = np.hypot(*(places[chosen] - places[k] - shift).T)
            chosen[k] &= bool((gaps > near).all())
    return chosen


def _state(motion: Array) -> drumrs.State:
    return drumrs.State(
        positions=motion[:, :2].copy(),
        velocities=motion[:, 2:4].copy(),
        angular_velocities=motion[:, 4].copy(),
    )
