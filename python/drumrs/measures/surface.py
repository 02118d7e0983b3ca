"""The free surface of a load: where one more bundle would come to lie on it, mean over a window.

Heights are taken along the line from the load's center of mass to the axis, so the surface is a function of the place
across that line, whatever its slope.
"""

import math
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError
from drumrs.measures.clearance import clearance
from drumrs.measures.frame_window import counter_clockwise, turn_back, within

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Columns across the drum, and places in a column for each diameter of a bundle.
_COLUMNS = 81
_PER_DIAMETER = 4.0
# Frames that are plenty for a mean.
_PLENTY = 100
# The parts of the surface, about the middle of its chord, that give its slope and its S-shape: its ends are rounded.
_MIDDLE, _WITHOUT_ENDS = 0.5, 0.8


@dataclass(frozen=True, eq=False)
class FreeSurface:
    """The surface of the load, as it lies in a drum that turns counter-clockwise.

    Heights are those of the center of one more bundle of mean size that just fits above the load.

    Attributes
    ----------
    along
        Places across the load [m], from the line through the axis, positive towards the shoulder, shape (k,).
    heights
        Heights above the axis along that line [m], frame by frame, shape (frames, k).
    tilt
        Angle of that line to the vertical [rad].
    times
        Times of the frames [s].
    drum_radius, bundle_radius
        Radius of the rim and mean radius of the bundles [m].
    """

    along: Array
    heights: Array
    tilt: float
    times: Array
    drum_radius: float
    bundle_radius: float

    def points(self) -> Array:
        """Return the mean surface as a line in the laboratory's frame [m], of shape (k, 2)."""
        return np.column_stack([self.along, self.heights.mean(axis=0)]) @ turn_back(-self.tilt)

    def shape(self, chosen: slice = slice(None)) -> dict[str, float]:
        """Return slope, S-shape and filling of the mean surface of some frames.

        Returns
        -------
        dict
            ``surface_slope`` [rad], of the straight line with the least squared distances from the middle half of the
            surface; ``s_shape``, the greatest distance of the middle four fifths of the surface from their chord, over
            the chord's length;
            ``filling``, the area between rim and surface over the drum's. Not a number where there is no bed.
        """
        middle = self._middle(chosen, _MIDDLE)
        if len(middle) <= 1:
            return {"surface_slope": math.nan, "s_shape": math.nan, "filling": math.nan}
        ahead = np.linalg.svd(middle - middle.mean(axis=0))[2][0]
        return {
            "surface_slope": self.tilt + math.atan(ahead[1] / ahead[0]),
            "s_shape": float(np.abs(self._above_chord(chosen)).max()),
            "filling": self._area(self.heights[chosen].mean(axis=0)) / (math.pi * self.drum_radius**2),
        }

    @property
    def sag(self) -> float:
        """How far the middle four fifths of the mean surface hang below their chord, over the chord's length."""
        return abs(float(self._above_chord().min(initial=0.0)))

    def _above_chord(self, chosen: slice = slice(None)) -> Array:
        """Return how far the places of the middle four fifths are above their chord, over its length."""
        inner = self._middle(chosen, _WITHOUT_ENDS)
        if len(inner) <= 1:
            return np.empty(0)
        chord = inner[-1] - inner[0]
        above: Array = (inner - inner[0]) @ np.array([-chord[1], chord[0]]) / (chord @ chord)
        return above

    def _middle(self, chosen: slice, share: float) -> Array:
        """Return the middle part of the mean surface of the bed as a line along the load and up."""
        height = self.heights[chosen].mean(axis=0)
        depth = height + np.sqrt((self.drum_radius - self.bundle_radius) ** 2 - self.along**2)
        line = np.column_stack([self.along, height])[_longest_run(depth > self.bundle_radius)]
        across = line[:, 0] - line[:, 0].mean() if len(line) else line[:, 0]
        middle: Array = line[
            np.abs(across) <= 0.5 * share * (across.max(initial=0.0) - across.min(initial=0.0))
        ]
        return middle

    def _area(self, height: Array) -> float:
        """Return the area between rim and surface [m²]: discs reach up to one more's center, less its radius."""
        fine = np.linspace(-self.drum_radius, self.drum_radius, 2001)
        rim = np.sqrt(self.drum_radius**2 - fine**2)
        surface = np.interp(fine, self.along, height) - self.bundle_radius
        return float(np.trapezoid(np.clip(surface + rim, 0.0, 2.0 * rim), fine))


def free_surface(frames: "Frames", window: tuple[float, float]) -> FreeSurface:
    """Return the free surface of the load in the frames of a window.

    Free are the places where one more bundle of mean size would fit; of those that hang together the largest part
    counts, so that pores of the bed and gaps behind baffles do not. The surface is its lower edge.

    Parameters
    ----------
    frames
        Frames of a run in a drum with a rim.
    window
        Start and end [s].

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or the drum has no rim.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import free_surface
    >>> config = drumrs.baseline(baffles=False).replace({"run.duration": 0.4, "run.frame_every": 0.01})
    >>> surface = free_surface(drumrs.run(config, progress=False).frames, window=(0.35, 0.4))
    >>> 0.2 < surface.shape()["filling"] < 0.4
    True
    """
    if frames.drum_radius is None:
        raise ConfigError("drum.rim", False, "true: the surface ends at the rim")
    seen = counter_clockwise(within(frames, window))
    seen = seen.picked(slice(None, None, max(1, len(seen) // _PLENTY)))
    radius = float(seen.radii.mean())
    x, y = np.average(seen.positions.mean(axis=0, dtype=np.float64), axis=0, weights=seen.radii**2)
    tilt = math.atan2(x, -y)
    reach = frames.drum_radius - radius
    along = np.linspace(-reach, reach, _COLUMNS + 2)[1:-1]
    up = np.arange(-reach, reach, 2.0 * radius / _PER_DIAMETER)
    places = np.stack(np.meshgrid(along, up, indexing="ij"), axis=-1) @ turn_back(-tilt)
    heights = [_heights(seen, index, places, along, up) for index in range(len(seen))]
    return FreeSurface(along, np.array(heights), tilt, seen.times, frames.drum_radius, radius)


def _heights(frames: "Frames", index: int, places: Array, along: Array, up: Array) -> Array:
    """Return the height of the surface in each column of one frame; that of the rim's top where nothing more would fit.

    `places` are those of the columns in the laboratory's frame, of shape (columns, heights, 2).
    """
    from scipy import ndimage

    radius, last = float(frames.radii.mean()), -up[0]
    inside = np.hypot(places[..., 0], places[..., 1]) <= last
    clearances = np.full(inside.shape, -radius)
    clearances[inside] = clearance(frames, index, places[inside]) - radius
    parts, _ = ndimage.label(clearances >= 0.0)
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    free = (parts == sizes.argmax()) & (parts > 0)
    column, first = np.arange(len(free)), free.argmax(axis=1)
    before = np.maximum(first - 1, 0)
    above, below = clearances[column, first], clearances[column, before]
    edge = up[first] - (up[1] - up[0]) * above / np.where(below < above, above - below, 1.0)
    rim = np.sqrt(last**2 - along**2)
    lowest: Array = np.where(inside[column, before], edge, -rim)
    lowest[~free.any(axis=1)] = rim[~free.any(axis=1)]
    return lowest


def _longest_run(chosen: NDArray[np.bool_]) -> slice:
    """Return where the longest run of chosen columns is."""
    runs, start = [slice(0, 0)], 0
    for is_chosen, group in groupby(chosen):
        length = len(list(group))
        if is_chosen:
            runs.append(slice(start, start + length))
        start += length
    return max(runs, key=lambda run: run.stop - run.start)
