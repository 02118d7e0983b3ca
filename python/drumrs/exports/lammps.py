"""Dump files as LAMMPS writes them, which most programs for particles read: text, one block a frame."""

from pathlib import Path

import numpy as np

from drumrs.exports.particles import Particles
from drumrs.exports.recorded import Recorded

_COLUMNS = "id type x y z vx vy vz radius quatw quati quatj quatk contacts"
_FORMAT = "%d %d" + " %.7g" * 11 + " %d"


def write(run: Recorded, path: Path) -> None:
    """Write particles with radius, velocity, and orientation about z as a quaternion."""
    particles = Particles(run.frames)
    size, wide = len(particles.types), particles.half_width
    bounds = f"{-wide:.7g} {wide:.7g}"
    zero = np.zeros(size)
    with path.open("w", encoding="ascii", newline="\n") as file:
        for index, time in enumerate(run.frames.times):
            now = particles.at(index)
            # Units stand in front of the first frame alone: with more readers take the file for one frame.
            units = "" if index else "ITEM: UNITS\nsi\n"
            file.write(f"{units}ITEM: TIME\n{time:.9g}\nITEM: TIMESTEP\n{index}\n")
            file.write(f"ITEM: NUMBER OF ATOMS\n{size}\nITEM: BOX BOUNDS ff ff ff\n{bounds}\n{bounds}\n")
            file.write(f"-0.5 0.5\nITEM: ATOMS {_COLUMNS}\n")
            half = now.angles / 2.0
            columns = (
                *(np.arange(1, size + 1), particles.types + 1, *now.positions.T, zero),
                *(*now.velocities.T, zero, particles.radii, np.cos(half), zero, zero, np.sin(half)),
            )
            np.savetxt(file, np.column_stack([*columns, now.contacts]), fmt=_FORMAT)
