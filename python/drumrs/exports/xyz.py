"""Extended XYZ, for OVITO and ASE: text, one block a frame, columns named in the comment."""

from pathlib import Path

from drumrs.exports.particles import Particles
from drumrs.exports.recorded import Recorded

_PROPERTIES = "species:S:1:pos:R:3:velo:R:3:radius:R:1:angle:R:1:contacts:I:1"


def write(run: Recorded, path: Path) -> None:
    """Write particles with species, velocity, radius and angle."""
    particles, frames = Particles(run.frames), run.frames
    side = 2.0 * particles.half_width
    lattice = f'Lattice="{side:.7g} 0 0 0 {side:.7g} 0 0 0 1" pbc="F F F"'
    origin = f'Origin="{-side / 2:.7g} {-side / 2:.7g} -0.5"'
    kinds = [particles.kinds[kind].replace(" ", "_") for kind in particles.types]
    with path.open("w", encoding="utf-8", newline="\n") as file:
        for index, (time, angle) in enumerate(zip(frames.times, frames.drum_angles, strict=True)):
            now = particles.at(index)
            words = f"Time={time:.9g} drum_angle={angle:.9g} digest={run.config.digest}"
            file.write(f"{len(kinds)}\n{lattice} {origin} Properties={_PROPERTIES} {words}\n")
            rows = zip(
                kinds, now.positions, now.velocities, particles.radii, now.angles, now.contacts, strict=True
            )
            file.writelines(
                f"{kind} {x:.7g} {y:.7g} 0 {u:.7g} {v:.7g} 0 {radius:.7g} {turn:.7g} {contacts}\n"
                for kind, (x, y), (u, v), radius, turn, contacts in rows
            )
