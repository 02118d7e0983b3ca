"""The shape of the charge, in the words of mills: occupancy, toe, shoulder, surface, arm and filling.

Angles are counter-clockwise from the horizontal, of a drum that turns counter-clockwise, in which the load rises on the
right; where it turns clockwise they are those of the mirror image.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array, Mean, mean_with_error, ratio_of_sums
from drumrs.errors import ConfigError
from drumrs.measures.clearance import distance_to_solids
from drumrs.measures.frame_window import FrameWindow, counter_clockwise, turn_back, with_errors, within
from drumrs.measures.surface import FreeSurface, free_surface
from drumrs.measures.toe import toe_and_shoulder

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Sampling points in a bin of the occupancy, along the shell and across a layer.
_ALONG, _ACROSS = 2, 8
# The fraction of its rotation that a drum may turn back and still be said to turn one way.
_BACKWARD = 0.02


@dataclass(frozen=True, eq=False)
class Occupancy:
    """Which part of the area near the shell is covered by discs, by angle and layer.

    Attributes
    ----------
    angles
        Middles of the bins [rad], from 0 to 2π, shape (bins,).
    layers
        Edges of the layers, as distances from the shell [m], shape (k + 1,).
    solid_fraction
        Covered part of the area that baffles leave, shape (k, bins); not a number where they leave none.
    error
        Its standard error, not a number where the window has few frames; shape (k, bins).
    """

    angles: Array
    layers: Array
    solid_fraction: Array
    error: Array


def occupancy(
    frames: "Frames", window: tuple[float, float], layers: ArrayLike = (0.0, 1.5), bins: int = 360
) -> Occupancy:
    """Return the solid fraction near the shell by angle, mean over the frames of a window.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    layers
        Edges of the layers, as distances from the shell in mean diameters; rising.
    bins
        Number of bins of angle.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, or the drum has no rim.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import occupancy
    >>> config = drumrs.baseline().replace({"run.duration": 0.4, "run.frame_every": 0.02})
    >>> found = occupancy(drumrs.run(config, progress=False).frames, window=(0.3, 0.4), bins=8)
    >>> bottom, top = found.solid_fraction[0, 5:7].mean(), found.solid_fraction[0, 1:3].mean()
    >>> bool(bottom > 0.5 > top)
    True
    """
    from scipy.spatial import KDTree

    drum_radius = _rim(frames)
    selected = counter_clockwise(within(frames, window))
    edges = np.asarray(layers, dtype=np.float64) * 2.0 * float(frames.radii.mean())
    across = np.arange(_ACROSS * (len(edges) - 1)) + 0.5
    depths = np.interp(across / _ACROSS, np.arange(len(edges)), edges)
    angles = 2.0 * math.pi * (np.arange(_ALONG * bins) + 0.5) / (_ALONG * bins)
    # Sampling points by depth and angle; each stands for an area in proportion to its distance from the axis.
    distances = (drum_radius - depths)[:, np.newaxis]
    points = np.stack([distances * np.cos(angles), distances * np.sin(angles)], axis=-1).reshape(-1, 2)
    areas = np.broadcast_to(distances, (len(depths), len(angles))).ravel()
    tree = KDTree(points)
    shape = (len(edges) - 1, _ACROSS, bins, _ALONG)
    covered, available = [], []
    for positions, angle in zip(selected.positions, selected.drum_angles, strict=True):
        uncovered = (
            distance_to_solids(selected, points @ turn_back(angle)) > 0.0
            if selected.baffles
            else np.ones(len(points))
        )
        within_disc = np.zeros(len(points))
        within_disc[np.concatenate(tree.query_ball_point(positions, selected.radii)).astype(int)] = 1.0
        covered.append((within_disc * uncovered * areas).reshape(shape).sum(axis=(1, 3)))
        available.append((uncovered * areas).reshape(shape).sum(axis=(1, 3)))
    found = np.full((2, len(edges) - 1, bins), np.nan)
    for cell in np.ndindex(len(edges) - 1, bins):
        mean = ratio_of_sums(*(np.array([each[cell] for each in sums]) for sums in (covered, available)))
        if mean is not None:
            found[:, *cell] = mean.value, math.nan if mean.error is None else mean.error
    return Occupancy(2.0 * math.pi * (np.arange(bins) + 0.5) / bins, edges, *found)


def charge(
    frames: "Frames", window: tuple[float, float], surface: FreeSurface | None = None
) -> dict[str, Mean]:
    """Return the shape of the charge in a window.

    Parameters
    ----------
    frames
        Frames of a run in a drum with a rim, of bundles of the same density.
    window
        Start and end [s], between which the drum turns one way: a mean over to and fro is of neither.
    surface
        `free_surface` of the same frames and window, where it is known already.

    Returns
    -------
    dict
        By name of the registry, with standard errors:
        ``toe_angle``, ``shoulder_angle`` [rad], where the filling of the layer within 1.5 diameters of the shell falls
        to half of the bed's median, followed both increments from the middle of the charge;
        ``surface_slope``, ``s_shape``, ``filling`` of the free surface, see `FreeSurface.shape`;
        ``center_slope`` [rad], atan2(x̄, −ȳ) of the center of mass, equal to ``surface_slope`` for a flat bed;
        ``arm``, x̄/R, which is M g's share in the torque: the power is arm · M g R Ω.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, the drum has no rim, or turns to and fro.

    Notes
    -----
    A flat bed of half-angle Θ and slope α has its toe at 270° + α − Θ, its shoulder at 270° + α + Θ, a filling of
    (Θ − sin Θ cos Θ)/π and an arm of ⅔ sin³Θ sin α/(Θ − sin Θ cos Θ).

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import charge
    >>> config = drumrs.baseline(baffles=False).replace({"run.duration": 0.4, "run.frame_every": 0.01})
    >>> found = charge(drumrs.run(config, progress=False).frames, window=(0.3, 0.4))
    >>> 0.2 < found["filling"].value < 0.4, -1.0 < found["arm"].value < 1.0
    (True, True)
    """
    selected = counter_clockwise(within(frames, window))
    drum_radius, diameter = _rim(frames), 2.0 * float(frames.radii.mean())
    every = FrameWindow.of(selected, window)
    increments = np.diff(selected.drum_angles)
    if -increments.clip(max=0.0).sum() > _BACKWARD * abs(increments).sum():
        limit = (
            "one in which the drum turns one way: the charge lies on the other side after it has turned round"
        )
        raise ConfigError("window", window, limit)
    weights = selected.radii**2 / (selected.radii**2).sum()
    centers = np.einsum("fnk,n->fk", every.positions, weights)

    def of_frames(chosen: slice) -> dict[str, float]:
        ends = toe_and_shoulder(every.piece(chosen), diameter, drum_radius)
        x, y = centers[chosen].mean(axis=0)
        return {"toe_angle": ends.toe, "shoulder_angle": ends.shoulder, "center_slope": math.atan2(x, -y)}

    surface = surface or free_surface(frames, window)
    arm = mean_with_error(centers[:, 0] / drum_radius, every.interval)
    return {**with_errors(of_frames, every.times), **with_errors(surface.shape, surface.times), "arm": arm}


def _rim(frames: "Frames") -> float:
    if frames.drum_radius is None:
        raise ConfigError("drum.rim", False, "true: toe, shoulder and filling are those at a rim")
    return frames.drum_radius
