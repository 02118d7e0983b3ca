"""Forces at the contacts of frames, for the player to draw: those of the normal springs, from the overlaps.

A frame has positions, no forces. The run's contact laws make forces of the overlaps: k δ, or k δ^{3/2} of Hertz. What
dashpots, friction and adhesion add is not in them.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.config.laws import laws
from drumrs.config.types import DRUM

if TYPE_CHECKING:
    from drumrs.config import Config, LinearContact
    from drumrs.frames import Frames

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ContactForces:
    """Contacts of frames, those of two discs and those with the drum, in the order of the frames.

    Attributes
    ----------
    frame, drum_frame
        Which frame a contact is of, shape (k,) and (l,).
    discs
        Numbers of the two discs, shape (k, 2).
    forces
        Normal force of their springs [N/m], shape (k,).
    at_drum
        Numbers of the discs at the drum, once for each place of touch, shape (l,).
    directions
        Angle of the line from the disc's center to that place in the laboratory [rad], shape (l,).
    drum_forces
        Normal force there [N/m], shape (l,).
    """

    frame: Indices
    discs: Indices
    forces: Array
    drum_frame: Indices
    at_drum: Indices
    directions: Array
    drum_forces: Array


def contact_forces(config: "Config", frames: "Frames") -> ContactForces:
    """Return the forces of the normal springs at the contacts of frames.

    Positions in single precision leave an error of `resolution` times the stiffness: less than the weight of a bundle
    in a drum of half a meter with the stiff springs of a fabric.

    Parameters
    ----------
    config
        The run's configuration, whose contact laws count.
    frames
        Frames of the run; some dozens at a time take little memory.
    """
    from scipy.spatial import KDTree

    length, count = len(frames), frames.count
    # All frames at once, side by side and far enough apart.
    places = frames.positions.astype(np.float64).reshape(-1, 2)
    radii = np.tile(frames.radii, length)
    kinds = np.tile([config.load.names.index(name) for name in frames.species] or [0] * count, length)
    stiffness, reach = _stiffnesses(config), 2.0 * float(frames.radii.max())
    apart = float(np.ptp(places[:, 0])) + 2.0 * reach
    aside = places + np.column_stack([np.repeat(np.arange(length) * apart, count), np.zeros(len(places))])
    pairs = KDTree(aside).query_pairs(reach, output_type="ndarray")
    overlaps = radii[pairs].sum(axis=1) - np.hypot(*(places[pairs[:, 0]] - places[pairs[:, 1]]).T)
    touch = np.flatnonzero(overlaps > 0.0)
    touch = touch[np.lexsort((pairs[touch, 1], pairs[touch, 0]))]
    (one, other), overlaps = pairs[touch].T, overlaps[touch]
    reduced = radii[one] * radii[other] / (radii[one] + radii[other])
    smaller = np.minimum(radii[one], radii[other])
    forces = _springs(config, stiffness[kinds[one], kinds[other]], overlaps, reduced, smaller)
    disc, offsets = _touches(frames, places, radii)
    own = radii[disc]
    at_drum = _springs(config, stiffness[kinds[disc], -1], own - np.hypot(*offsets.T), own, own)
    angles = np.arctan2(offsets[:, 1], offsets[:, 0])
    numbers = np.column_stack([one, other]) % count
    return ContactForces(one // count, numbers, forces, disc // count, disc % count, angles, at_drum)


def resolution(frames: "Frames") -> float:
    """Return the error of an overlap [m] that positions in the frames' precision have."""
    farthest = np.abs(frames.positions).max(initial=0.0)
    return 2.0 * float(np.spacing(np.asarray(farthest, frames.positions.dtype)))


def greatest_stiffness(config: "Config") -> float:
    """Return the stiffness of the stiffest linear spring [N/m]; 0 with Hertz's law, soft at small overlaps."""
    return 0.0 if config.contact.base == "hertz" else float(_stiffnesses(config).max())


def _stiffnesses(config: "Config") -> Array:
    """Return the stiffness of each species with each, and with the drum in the last column."""
    names, contact = config.load.names, config.contact
    if not names:
        return np.array([[_stiffness(config, contact.bundle), _stiffness(config, contact.drum)]])
    found = np.zeros((len(names), len(names) + 1))
    for law in laws(config.load, contact):
        own, value = names.index(law.between[0]), _stiffness(config, law.table)
        if law.between[1] == DRUM:
            found[own, -1] = value
        else:
            other = names.index(law.between[1])
            found[own, other] = found[other, own] = value
    return found


def _stiffness(config: "Config", law: "LinearContact") -> float:
    """Return the stiffness k of a linear spring [N/m], or 4/3 E* of Hertz's law [Pa] for two bodies of one material."""
    if config.contact.base != "hertz":
        return law.normal_stiffness
    return 4.0 / 3.0 * (law.young_modulus or 0.0) / (2.0 * (1.0 - law.poisson_ratio**2))


def _springs(config: "Config", stiffness: Array, overlaps: Array, reduced: Array, smaller: Array) -> Array:
    """Return k δ, or Hertz's 4/3 E* √R* δ^{3/2} in a layer as thick as the smaller disc."""
    if config.contact.base == "hertz":
        return stiffness * np.sqrt(reduced) * overlaps**1.5 / (2.0 * smaller)
    return stiffness * overlaps


def _touches(frames: "Frames", places: Array, radii: Array) -> tuple[Indices, Array]:
    """Return which places touch the drum, and the offset from each, a disc's center, to where it does."""
    turned = np.repeat(np.exp(1j * frames.drum_angles), frames.count)
    # In the drum's own frame, as numbers of the complex plane: turning is a product.
    in_drum = (places[:, 0] + 1j * places[:, 1]) / turned
    found = []
    if frames.drum_radius is not None:
        at_rim = np.flatnonzero(np.abs(in_drum) > frames.drum_radius - radii)
        found.append((at_rim, in_drum[at_rim] * (frames.drum_radius / np.abs(in_drum[at_rim]) - 1.0)))
    closed = [*([] if frames.shell is None else [frames.shell]), *frames.baffles]
    for line in [*(np.vstack([points, points[:1]]) for points in closed), *frames.walls]:
        found += _touches_of_line(line[:, 0] + 1j * line[:, 1], in_drum, radii)
    which = np.concatenate([np.empty(0, int), *(disc for disc, _ in found)])
    order = np.argsort(which, kind="stable")
    which = which[order]
    offsets = np.concatenate([np.empty(0, complex), *(offset for _, offset in found)])[order] * turned[which]
    return which, np.column_stack([offsets.real, offsets.imag])


def _touches_of_line(line: Complex, places: Complex, radii: Array) -> list[tuple[Indices, Complex]]:
    """Return the same for the edges of a line, and for its corners: one touches only what none of its edges faces."""
    line = line[np.concatenate([[True], np.diff(line) != 0.0])]
    start, along = line[:-1], np.diff(line)
    low, high = complex(line.real.min(), line.imag.min()), complex(line.real.max(), line.imag.max())
    off = places - (
        np.clip(places.real, low.real, high.real) + 1j * np.clip(places.imag, low.imag, high.imag)
    )
    near = np.flatnonzero(np.abs(off) < radii)
    # A place along an edge, as a share of it, and how far to its left.
    share = (places[near, np.newaxis] - start) / along
    faces = (share.real > 0.0) & (share.real < 1.0)
    offsets = -1j * share.imag * along
    disc, edge = np.nonzero(faces & (np.abs(offsets) < radii[near, np.newaxis]))
    beside = np.zeros((len(near), len(line)), dtype=bool)
    beside[:, :-1] |= faces
    beside[:, 1:] |= faces
    if line[0] == line[-1]:
        beside[:, 0] |= faces[:, -1]
        beside[:, -1] = True
    to_corner = line - places[near, np.newaxis]
    lonely, corner = np.nonzero(~beside & (np.abs(to_corner) < radii[near, np.newaxis]))
    return [(near[disc], offsets[disc, edge]), (near[lonely], to_corner[lonely, corner])]
