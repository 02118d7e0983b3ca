"""What the page draws: the drum and its load once a start, then frames of whole numbers as bytes."""

import math
import struct
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.viewer.page import Player
from drumrs.viewer.recording import of_angles, of_places, of_speeds, reach_of

if TYPE_CHECKING:
    from drumrs.frames import Frames
    from drumrs.simulation import Simulation

# Number of the start, then: time [s], angle of the drum [rad], its angular velocity [rad/s], speed of the fastest
# bundle [m/s], simulated seconds in a second. studio.js reads the same.
_HEAD = struct.Struct("<d5d")


def frames_now(simulation: "Simulation") -> "Frames":
    """Return the present state as one frame."""
    velocities, count = simulation.velocities, simulation.count
    return simulation.records.as_frames(
        {
            "time": np.array([simulation.time]),
            "drum_angle": np.array([simulation.drum_angle]),
            "positions": simulation.positions[None].astype(np.float32),
            "angles": simulation.angles[None].astype(np.float32),
            "velocities": velocities[None].astype(np.float32),
            "contacts": np.zeros((1, count), np.uint16),
        }
    )


def pack_start(simulation: "Simulation") -> dict[str, Any]:
    """Return the drum, the load and where it starts, as `unpack` of recording.js reads them."""
    return Player(frames_now(simulation)).recording()


def pack_frame(simulation: "Simulation", start: int, factor: float) -> bytes:
    """Return the present state as bytes: 8 for a bundle, behind a head of 48.

    Parameters
    ----------
    simulation
        What is shown.
    start
        Number of the start that the frame belongs to.
    factor
        Simulated seconds in a second.
    """
    velocities = simulation.velocities
    speeds = np.hypot(velocities[:, 0], velocities[:, 1])
    fastest = float(speeds.max(initial=0.0)) or 1.0
    head = _HEAD.pack(
        start,
        simulation.time,
        simulation.drum_angle,
        simulation.drum_angular_velocity,
        fastest,
        factor if math.isfinite(factor) else 0.0,
    )
    reach = reach_of(simulation.records.none())
    parts = (
        of_places(simulation.positions, reach),
        of_angles(simulation.angles),
        of_speeds(speeds, fastest),
    )
    return b"".join((head, *(part.tobytes() for part in parts)))
