"""`FrameWindow`: the frames of a window, pair by pair, for measures of motion."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.frames import Frames


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
        # Frames fall on whole steps, a hair beyond the time that was asked for.
        slack = 1e-3 * (window[1] - window[0])
        inside = (frames.times >= window[0] - slack) & (frames.times <= window[1] + slack)
        if inside.sum() <= 1:
            raise ConfigError("window", window, "one that holds at least two frames of the run")
        return cls(
            frames.positions[inside].astype(np.float64), frames.times[inside], frames.drum_angles[inside]
        )

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

    def pairs(self, every: int = 1) -> Iterator[tuple[Array, Array, float]]:
        """Give the positions at two successive frames, and the angle by which the drum turned between them."""
        for k in range(0, len(self.positions) - 1, every):
            yield self.positions[k], self.positions[k + 1], float(self.angles[k + 1] - self.angles[k])

    def pairs_from_the_drum(self, every: int = 1) -> Iterator[tuple[Array, Array, float]]:
        """Give the same in the frame of the turning drum."""
        for k, (before, after, angle) in zip(count(0, every), self.pairs(every), strict=False):
            yield before @ turn_back(self.angles[k]), after @ turn_back(self.angles[k + 1]), angle


def turn_back(angle: float) -> Array:
    """Return the matrix that turns rows of points back by an angle, clockwise where it is positive."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
