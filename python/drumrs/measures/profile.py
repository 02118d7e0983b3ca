"""The velocity across a bed that flows down its surface: means along the line through the axis normal to the surface.

Heights are measured along that line, from the axis, positive towards the surface. Velocities are along the surface,
positive down the slope, so that a bed that turns with the drum as one body has the velocity Ω times height, below zero.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array, Mean
from drumrs.errors import ConfigError
from drumrs.measures.frame_window import FrameWindow, with_errors

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Half the width of the strip about the line in which bundles count, over the drum's radius.
_STRIP = 0.125
# The bed's surface is where the solid fraction falls to that share of the bed's median.
_HALF = 0.5
# The flowing layer's straight part lies between these shares of the surface velocity.
_STRAIGHT = (0.2, 0.8)
# The core is the outer part of what lies between the layer's foot and the rim.
_OUTER = 0.5


@dataclass(frozen=True, eq=False)
class Profile:
    """Means by height above the axis, in bins of one diameter.

    Attributes
    ----------
    heights
        Middles of the bins [m], rising, shape (k,).
    velocities
        Mean velocity down the slope [m/s], shape (k,); not a number where no bundle came.
    solid_fractions
        Share of the area that bundles cover, shape (k,).
    drum_radius
        Radius of the rim [m].
    angular_velocity
        Angular velocity of the drum [rad/s], without its sign.
    slope
        Angle of the surface to the horizontal [rad].
    """

    heights: Array
    velocities: Array
    solid_fractions: Array
    drum_radius: float
    angular_velocity: float
    slope: float

    @property
    def surface(self) -> float:
        """Height of the bed's surface [m]: where the solid fraction falls to half of the bed's."""
        bed = np.median(self.solid_fractions[self.solid_fractions > _HALF * self.solid_fractions.max()])
        return _last_fall(self.heights, self.solid_fractions, _HALF * float(bed))

    @property
    def depth(self) -> float:
        """Depth of the bed, from its surface to the rim [m]."""
        return self.drum_radius + self.surface

    @property
    def surface_velocity(self) -> float:
        """Velocity down the slope at the surface [m/s]."""
        known = np.isfinite(self.velocities)
        return float(np.interp(self.surface, self.heights[known], self.velocities[known]))

    @property
    def foot(self) -> float:
        """Height at which the velocity is zero, in the laboratory's frame [m]: the foot of the flowing layer."""
        below = (self.heights <= self.surface) & np.isfinite(self.velocities)
        return -_last_fall(-self.heights[below][::-1], self.velocities[below][::-1], 0.0, first=True)

    @property
    def layer(self) -> float:
        """Thickness of the flowing layer [m], from the surface down to where the velocity is zero."""
        return self.surface - self.foot

    @property
    def layer_to_solid_rotation(self) -> float:
        """Thickness [m] down to where the straight part of the layer's profile, drawn on, meets solid rotation."""
        top = self.surface_velocity
        part = (self.heights <= self.surface) & (self.velocities > _STRAIGHT[0] * top)
        part &= self.velocities < _STRAIGHT[1] * top
        if part.sum() <= 1:
            return float("nan")
        rate, offset = np.polyfit(self.heights[part], self.velocities[part], 1)
        return float(self.surface - offset / (self.angular_velocity - rate))

    @property
    def core_velocity_ratio(self) -> float:
        """Angular velocity over the drum's, mean over the outer half of what lies between the foot and the rim."""
        edge = self.foot - _OUTER * (self.foot + self.drum_radius)
        core = (self.heights < edge) & (self.solid_fractions > _HALF * self.solid_fractions.max())
        if not self.angular_velocity or not core.any():
            return float("nan")
        return float((self.velocities[core] / (self.angular_velocity * self.heights[core])).mean())


def profile(frames: FrameWindow, diameter: float, drum_radius: float) -> Profile:
    """Return the velocity profile of a window.

    A bundle's displacement between two frames gives its velocity, half-way between them. The surface is taken to be
    normal to the line from the axis to the load's center of mass, as it is for a flat bed.

    Parameters
    ----------
    frames
        Frames of the window; between two of them the fastest bundles should not move by more than a diameter or so.
    diameter
        Diameter of the bundles [m].
    drum_radius
        Radius of the rim [m].

    Examples
    --------
    A heap of discs that turns with the drum.

    >>> import numpy as np
    >>> from drumrs.measures.frame_window import FrameWindow
    >>> from drumrs.measures.profile import profile
    >>> before = np.array([[0.0, -0.05 - 0.1 * k] for k in range(10)])
    >>> after = before + 0.001 * np.column_stack([-before[:, 1], before[:, 0]])
    >>> seen = FrameWindow(np.array([before, after]), np.array([0.0, 0.001]), np.array([0.0, 0.001]))
    >>> found = profile(seen, diameter=0.1, drum_radius=1.0)
    >>> round(found.angular_velocity, 3), bool(np.allclose(found.velocities[:10], found.heights[:10], atol=1e-3))
    (1.0, True)
    """
    center = frames.positions.mean(axis=(0, 1))
    normal = -center / np.hypot(*center)
    sense = np.sign(frames.turned)
    down = sense * np.array([-normal[1], normal[0]])
    middles = 0.5 * (frames.positions[1:] + frames.positions[:-1])
    velocities = np.diff(frames.positions, axis=0) / np.diff(frames.times)[:, np.newaxis, np.newaxis]
    inside = np.abs(middles @ down) < _STRIP * drum_radius
    heights, speeds = (middles @ normal)[inside], (velocities @ down)[inside]
    edges = np.arange(-drum_radius, drum_radius + diameter, diameter)
    counts = np.histogram(heights, edges)[0]
    sums = np.histogram(heights, edges, weights=speeds)[0]
    with np.errstate(invalid="ignore"):
        means = sums / counts
    area = 2.0 * _STRIP * drum_radius * diameter * len(middles)
    return Profile(
        heights=0.5 * (edges[1:] + edges[:-1]),
        velocities=means,
        solid_fractions=counts * (np.pi * diameter**2 / 4.0) / area,
        drum_radius=drum_radius,
        angular_velocity=float(abs(frames.turned) / (frames.times[-1] - frames.times[0])),
        slope=float(abs(np.arctan2(center[0], -center[1]))),
    )


def flowing_layer(frames: "Frames", window: tuple[float, float]) -> dict[str, Mean]:
    """Return how thick the layer that flows down the bed is, and how fast, on the line through the axis normal to it.

    Parameters
    ----------
    frames
        Frames of a run in a drum with a rim; the fastest bundles should not move by more than a diameter between two.
    window
        Start and end [s].

    Returns
    -------
    dict
        By name of the registry, with standard errors:
        ``center_slope`` [rad], by the center of mass; ``bed_depth`` [m], from the surface to the rim;
        ``surface_velocity_ratio``, velocity down the slope at the surface over Ω R; ``layer_thickness`` [m], down to
        where the velocity vanishes in the laboratory; ``layer_to_solid_rotation`` [m], down to where the straight part
        of its profile, drawn on, meets solid rotation; ``core_velocity_ratio``, angular velocity below it over Ω.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or the drum has no rim.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import flowing_layer
    >>> config = drumrs.baseline(baffles=False).replace({"run.duration": 0.4, "run.frame_every": 0.005})
    >>> found = flowing_layer(drumrs.run(config, progress=False).frames, window=(0.3, 0.4))
    >>> 0.05 < found["bed_depth"].value < 0.25
    True
    """
    if frames.drum_radius is None:
        raise ConfigError("drum.rim", False, "true: the depth of the bed is that above a rim")
    return layer_in(FrameWindow.of(frames, window), 2.0 * float(frames.radii.mean()), frames.drum_radius)


def layer_in(seen: FrameWindow, diameter: float, drum_radius: float) -> dict[str, Mean]:
    """Return what `flowing_layer` does, of the frames of a window."""

    def of(chosen: slice) -> dict[str, float]:
        found = profile(seen.piece(chosen), diameter, drum_radius)
        speed_of_rim = found.angular_velocity * found.drum_radius
        return {
            "surface_velocity_ratio": found.surface_velocity / speed_of_rim if speed_of_rim else float("nan"),
            "bed_depth": found.depth,
            "layer_thickness": found.layer,
            "layer_to_solid_rotation": found.layer_to_solid_rotation,
            "core_velocity_ratio": found.core_velocity_ratio,
            "center_slope": found.slope,
        }

    return with_errors(of, seen.times)


def _last_fall(places: Array, values: Array, level: float, *, first: bool = False) -> float:
    """Return where values fall below a level for the last time, or the first; not a number where they do not."""
    falls = np.flatnonzero((values[:-1] >= level) & (values[1:] < level))
    if not len(falls):
        return float("nan")
    k = falls[0] if first else falls[-1]
    share = (values[k] - level) / (values[k] - values[k + 1])
    return float(places[k] + share * (places[k + 1] - places[k]))
