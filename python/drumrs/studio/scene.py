"""What the page draws: the drum and its load once a start, then frames of whole numbers as bytes."""

import math
import struct
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.viewer.page import Player
from drumrs.viewer.recording import (
    force_limits,
    forces_of,
    of_angles,
    of_forces,
    of_numbers,
    of_places,
    of_speeds,
)

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.frames import Frames
    from drumrs.simulation import Simulation

# Number of the start, then: time [s], angle of the drum [rad], its angular velocity [rad/s], speed of the fastest
# bundle [m/s], simulated seconds in a second; before forces, the end of their scale and what is left out below [N/m].
# `unpackFrame` of recording.js reads the same.
_HEAD, _FORCE_HEAD = struct.Struct("<d5d"), struct.Struct("<2d")


def frame_now(simulation: "Simulation", scene: "Frames") -> "Frames":
    """Return the present state as one frame, in double precision.

    Parameters
    ----------
    simulation
        The simulation.
    scene
        ``simulation.records.none()``: load and drum, which stay what they are.
    """
    arrays: dict[str, Any] = {
        "times": np.array([simulation.time]),
        "drum_angles": np.array([simulation.drum_angle]),
        "positions": simulation.positions[None],
        "angles": simulation.angles[None],
        "velocities": simulation.velocities[None],
        "contacts": np.zeros((1, simulation.count), np.uint16),
    }
    return replace(scene, **arrays)


def pack_start(now: "Frames") -> dict[str, Any]:
    """Return the drum, the load and where it starts, as `unpack` of recording.js reads them."""
    return Player(now).recording()


def pack_frame(now: "Frames", reach: float, start: int, spin: float, factor: float) -> bytes:
    """Return a frame as bytes: 8 for a bundle, behind a head of 48.

    Parameters
    ----------
    now
        The frame, alone.
    reach
        Half width of the square in which places are told [m].
    start
        Number of the start that the frame belongs to.
    spin
        Angular velocity of the drum [rad/s].
    factor
        Simulated seconds in a second.
    """
    fastest = float(now.speeds.max(initial=0.0)) or 1.0
    told = factor if math.isfinite(factor) else 0.0
    head = _HEAD.pack(start, now.times[0], now.drum_angles[0], spin, fastest, told)
    parts = of_places(now.positions, reach), of_angles(now.angles), of_speeds(now.speeds, fastest)
    return b"".join((head, *(part.tobytes() for part in parts)))


def pack_forces(config: "Config", now: "Frames", end: float | None) -> bytes:
    """Return the forces at the contacts of a frame as bytes: 5 for a contact, 9 for large loads, behind a head of 16.

    Parameters
    ----------
    config
        The configuration, whose contact laws count.
    now
        The frame, alone.
    end
        End of the scale [N/m]; that of the frame itself without one.
    """
    _, one, other, force = forces_of(config, now)
    end, least = force_limits(config, now, force, end)
    kept = force >= least
    parts = (
        of_numbers(one[kept], now.count),
        of_numbers(other[kept], now.count),
        of_forces(force[kept], end),
    )
    return b"".join((_FORCE_HEAD.pack(end, least), *(part.tobytes() for part in parts)))
