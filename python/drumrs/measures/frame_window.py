"""`FrameWindow`: the frames of a window, pair by pair; and the errors of what is measured over it."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import count, pairwise
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array, Mean, mean_with_error
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.frames import Frames

# A window is cut into so many pieces, whose scatter gives the error of what is measured over all of it.
_PIECES = 16


def within(frames: "Frames", window: tuple[float, float]) -> "Frames":
    """Return the frames of a window.

    Raises
    ------
    ConfigError
        Where it holds fewer than two.
    """
    # Frames fall on whole steps, a hair beyond the time that was asked for.
    slack = 1e-3 * (window[1] - window[0])
    inside = np.flatnonzero((frames.times >= window[0] - slack) & (frames.times <= window[1] + slack))
    if len(inside) <= 1:
        raise ConfigError("window", window, "one that holds at least two frames of the run")
    return frames.picked(slice(inside[0], inside[-1] + 1))


def counter_clockwise(frames: "Frames") -> "Frames":
    """Return the frames as they are where the drum turns counter-clockwise, else their mirror image."""
    if frames.drum_angles[-1] >= frames.drum_angles[0]:
        return frames
    flip = np.array([-1.0, 1.0])
    return replace(
        frames,
        drum_angles=-frames.drum_angles,
        positions=frames.positions * flip,
        angles=-frames.angles,
        velocities=frames.velocities * flip,
        shell=None if frames.shell is None else frames.shell * flip,
        baffles=tuple(line * flip for line in frames.baffles),
        walls=tuple(line * flip for line in frames.walls),
    )


@dataclass(frozen=True, eq=False)
class FrameWindow:
    """The frames of a window; displacements between successive ones stand for velocities.

    Attributes
    ----------
    positions
        Centers of the bundles [m], shape (frames, n, 2).
    times
        Times of the frames [s].
    angles
        Angles of the drum [rad].
    """

    positions: Array
    times: Array
    angles: Array

    @classmethod
    def of(cls, frames: "Frames", window: tuple[float, float]) -> "FrameWindow":
        """Choose the frames of a window.

        Raises
        ------
        ConfigError
            Where it holds fewer than two.
        """
        inside = within(frames, window)
        return cls(inside.positions.astype(np.float64), inside.times, inside.drum_angles)

    @property
    def interval(self) -> float:
        """Mean time between frames [s]."""
        return float(self.times[-1] - self.times[0]) / (len(self.times) - 1)

    @property
    def turned(self) -> float:
        """Angle by which the drum turned from first to last [rad]."""
        return float(self.angles[-1] - self.angles[0])

    @property
    def turns(self) -> float:
        """The same as a number of turns, never negative."""
        return abs(self.turned) / (2.0 * np.pi)

    def piece(self, chosen: slice) -> "FrameWindow":
        """Return the frames with these indices."""
        return FrameWindow(self.positions[chosen], self.times[chosen], self.angles[chosen])

    def pairs(self, every: int = 1) -> Iterator[tuple[Array, Array, float]]:
        """Give the positions at two successive frames, and the angle by which the drum turned between them."""
        for k in range(0, len(self.positions) - 1, every):
            yield self.positions[k], self.positions[k + 1], float(self.angles[k + 1] - self.angles[k])

    def pairs_from_the_drum(self, every: int = 1) -> Iterator[tuple[Array, Array, float]]:
        """Give the same in the frame of the turning drum."""
        for k, (before, after, angle) in zip(count(0, every), self.pairs(every), strict=False):
            yield before @ turn_back(self.angles[k]), after @ turn_back(self.angles[k + 1]), angle


def with_errors(measure: Callable[[slice], Mapping[str, float]], times: Array) -> dict[str, Mean]:
    """Return what is measured over a window, with errors from the pieces that it is cut into.

    Parameters
    ----------
    measure
        Function from the indices of some frames to numbers by name.
    times
        Times of the frames [s].

    Returns
    -------
    dict
        The error is `None` where the window has few frames, or a piece has no such number.
    """
    whole = measure(slice(None))
    bounds = np.linspace(0, len(times) - 1, min(_PIECES, len(times) - 1) + 1).astype(int)
    pieces = [measure(slice(first, last + 1)) for first, last in pairwise(bounds)]
    interval = float(times[-1] - times[0]) / len(pieces)
    found = {}
    for name, value in whole.items():
        values = [piece[name] for piece in pieces]
        error = mean_with_error(values, interval).error if np.isfinite(values).all() else None
        found[name] = Mean(value, error)
    return found


def turn_back(angle: float) -> Array:
    """Return the matrix that turns rows of points back by an angle, clockwise where it is positive."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
