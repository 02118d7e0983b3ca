"""Toe and shoulder of a mill's charge: where the layer at the shell begins and ends, as seen from the laboratory.

Angles are counter-clockwise from the horizontal, of a drum that turns counter-clockwise: the charge lies between the
toe, lower left, and the shoulder, on the right.
"""

from dataclasses import dataclass

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.measures.frame_window import FrameWindow

# The layer at the shell, in diameters from the shell to a bundle's center, and the bins of angle.
_LAYER = 1.5
_BINS = 120
# The charge ends where the shell's layer is filled to that share of the charge's median.
_HALF = 0.5


@dataclass(frozen=True)
class ToeAndShoulder:
    """Where the charge at the shell begins and ends [rad], within −π/2 and 3π/2; not a number where it is all round."""

    toe: float
    shoulder: float


def toe_and_shoulder(frames: FrameWindow, diameter: float, drum_radius: float) -> ToeAndShoulder:
    """Return toe and shoulder of the charge in a window.

    The layer at the shell is what lies within one and a half diameters of it. From the direction of the load's
    center of mass its filling is followed both ways to where it falls to half of the charge's median.

    Parameters
    ----------
    frames
        Frames of the window, in which lifters pass every place alike.
    diameter
        Diameter of the bundles [m].
    drum_radius
        Radius of the shell [m].

    Examples
    --------
    Discs at the shell from 225° to 315°.

    >>> import numpy as np
    >>> from drumrs.measures.frame_window import FrameWindow
    >>> from drumrs.measures.toe import toe_and_shoulder
    >>> angles = np.radians(np.arange(225.0, 315.5, 0.5))
    >>> shell = 0.95 * np.column_stack([np.cos(angles), np.sin(angles)])
    >>> frames = FrameWindow(np.array([shell, shell]), np.array([0.0, 0.01]), np.array([0.0, 0.01]))
    >>> found = toe_and_shoulder(frames, diameter=0.1, drum_radius=1.0)
    >>> bool(abs(np.degrees(found.toe) - 225.0) < 3.0), bool(abs(np.degrees(found.shoulder) + 45.0) < 3.0)
    (True, True)
    """
    x, y = frames.positions.mean(axis=(0, 1))
    middle = np.arctan2(y, x)
    points = frames.positions.reshape(-1, 2)
    shell = points[np.hypot(*points.T) > drum_radius - _LAYER * diameter]
    # Angles from the middle of the charge, within ±π, against the clock.
    around = (np.arctan2(shell[:, 1], shell[:, 0]) - middle + np.pi) % (2.0 * np.pi) - np.pi
    counts, edges = np.histogram(around, _BINS, (-np.pi, np.pi))
    places, filled = 0.5 * (edges[1:] + edges[:-1]), counts.astype(np.float64)
    half = len(filled) // 2
    # What is filled at all has some median; what is filled to half of that is the charge, whose median counts.
    level = _HALF * float(np.median(filled[filled > 0.0])) if counts.any() else 0.0
    for _ in range(2):
        behind = _falls(-places[half - 1 :: -1], filled[half - 1 :: -1], level)
        ahead = _falls(places[half:], filled[half:], level)
        charge = filled[(places > -behind) & (places < ahead)]
        level = _HALF * float(np.median(charge)) if len(charge) else level
    return ToeAndShoulder(_upright(middle - behind), _upright(middle + ahead))


def _falls(places: Array, filled: Array, level: float) -> float:
    """Return where the filling falls below a level, linear between the middles of bins; not a number where it does not.

    That is where the sum of all that is above the level is greatest. Where the filling falls steadily this is the one
    crossing. The first of several would lie the farther inside the more the filling scatters: the fewer frames there
    are, the smaller the charge.
    """
    above = np.cumsum(filled - level)
    k = int(above.argmax())
    if above[k] <= 0.0 or k == len(above) - 1:
        return float("nan")
    return float(np.interp(-level, -filled[[k, k + 1]], places[[k, k + 1]]))


def _upright(angle: float) -> float:
    """Return an angle between −π/2 and 3π/2, which is cut where no charge is: beyond the shoulder, before the toe."""
    return float((angle + np.pi / 2.0) % (2.0 * np.pi) - np.pi / 2.0)
