"""GSD, for OVITO, HOOMD-blue and freud: bundles and beads of the drum as particles, times in the log."""

import json
from pathlib import Path

import numpy as np

from drumrs.exports.particles import Particles
from drumrs.exports.recorded import Recorded


def write(run: Recorded, path: Path) -> None:
    """Write particles with type, diameter, orientation about z, and velocity."""
    import gsd.hoomd
    from gsd.version import version

    particles, frames = Particles(run.frames), run.frames
    size, side = len(particles.types), 2.0 * particles.half_width
    application = f"{run.provenance()['source']}, gsd {version}"
    # A file that is there keeps its permissions; gsd gives new ones its own.
    path.touch()
    with gsd.hoomd.open(path, "w") as file:
        file.application = application
        for index, (time, angle) in enumerate(zip(frames.times, frames.drum_angles, strict=True)):
            now = particles.at(index)
            frame = gsd.hoomd.Frame()
            frame.configuration.step = index
            frame.configuration.dimensions = 2
            frame.configuration.box = [side, side, 0, 0, 0, 0]
            frame.particles.N = size
            frame.particles.types = particles.kinds
            frame.particles.type_shapes = [
                {"type": "Sphere", "diameter": float(2.0 * radius)} for radius in particles.kind_radii
            ]
            frame.particles.typeid = particles.types
            frame.particles.diameter = 2.0 * particles.radii
            frame.particles.position = np.pad(now.positions, ((0, 0), (0, 1)))
            half = now.angles / 2.0
            frame.particles.orientation = np.column_stack([np.cos(half), *np.zeros((2, size)), np.sin(half)])
            frame.particles.velocity = np.pad(now.velocities, ((0, 0), (0, 1)))
            frame.log = {"time": np.array([time]), "drum_angle": np.array([angle])}
            frame.log["particles/contacts"] = now.contacts
            if index == 0:
                told = json.dumps(run.provenance(), ensure_ascii=False).encode()
                file.file.write_chunk("user/provenance", np.frombuffer(told, np.uint8))
            file.append(frame)
