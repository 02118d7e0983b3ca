"""Bundles and drum as particles, for formats that hold nothing else.

The drum is beads of the type "drum" along its lines: they come after the bundles, turn with the drum, and move none of
the load. Their angles are the drum's, their velocities and numbers of contacts 0.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drumrs.frames import Frames
from drumrs.outline import Points, turned

Array = NDArray[np.float64]
# A bead's radius over that of the drum.
_BEAD = 1 / 200


class Moment(NamedTuple):
    """All particles at the time of a frame; arrays have an entry for each."""

    positions: Array
    angles: Array
    velocities: Array
    contacts: NDArray[np.int64]


class Particles:
    """The particles of a run.

    Parameters
    ----------
    frames
        Frames of the run.

    Attributes
    ----------
    kinds
        Names of the types: the species, or "bundle" where there is one only, then "drum".
    kind_radii
        Mean radius of each type [m].
    types
        Place of each particle's type among the kinds.
    radii
        Radii [m].
    half_width
        Half the width of a square round the axis that holds everything [m].
    """

    def __init__(self, frames: Frames) -> None:
        self._frames = frames
        self._beads, bead = _beads(frames)
        species = frames.species or ("bundle",) * frames.count
        self.kinds = [*sorted(set(species)), "drum"]
        self.types = np.array([*map(self.kinds.index, species), *([len(self.kinds) - 1] * len(self._beads))])
        self.radii = np.concatenate([frames.radii, np.full(len(self._beads), bead)])
        self.kind_radii = [float(self.radii[self.types == kind].mean()) for kind in range(len(self.kinds))]
        farthest = float(np.abs(frames.positions).max(initial=0.0)) + float(frames.radii.max(initial=0.0))
        self.half_width = 1.02 * max(farthest, float(np.hypot(*self._beads.T).max(initial=0.0)) + bead)

    def at(self, index: int) -> Moment:
        """Return where the particles are in a frame."""
        frames, beads, angle = self._frames, len(self._beads), float(self._frames.drum_angles[index])
        within = (angle + np.pi) % (2.0 * np.pi) - np.pi
        return Moment(
            np.concatenate([frames.positions[index], turned(self._beads, angle)]),
            np.concatenate([frames.angles[index], np.full(beads, within)]),
            np.concatenate([frames.velocities[index], np.zeros((beads, 2))]),
            np.concatenate([frames.contacts[index], np.zeros(beads)]).astype(int),
        )


def _beads(frames: Frames) -> tuple[Points, float]:
    """Return where the beads are in the drum's own frame, and their radius."""
    lines = [line.points for line in frames.outline()]
    radius = _BEAD * max((float(np.hypot(*line.T).max()) for line in lines), default=0.0)
    found = [np.empty((0, 2))]
    for line in lines:
        # Beads that touch, as nearly as their number allows; where a closed line ends one is already.
        along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        number = max(2, round(along[-1] / (2.0 * radius)))
        is_open = bool((line[0] != line[-1]).any())
        at = np.linspace(0.0, along[-1], number, endpoint=is_open)
        found.append(np.column_stack([np.interp(at, along, line[:, axis]) for axis in range(2)]))
    return np.concatenate(found), radius
