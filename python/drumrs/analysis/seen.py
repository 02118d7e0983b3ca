"""What measures of motion look at: the frames of a window, pair by pair."""

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
class Seen:
    """Positions, times and the drum's angles at the frames of a window.

    Displacements between neighboring frames stand for velocities.
    """

    positions: Array
    times: Array
    angles: Array

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
        """Give positions at neighboring frames, and the angle by which the drum turned between."""
        for k in range(0, len(self.positions) - 1, every):
            yield self.positions[k], self.positions[k + 1], float(self.angles[k + 1] - self.angles[k])

    def pairs_from_the_drum(self, every: int = 1) -> Iterator[tuple[Array, Array, float]]:
        """Give the same as seen by one who turns with the drum."""
        for k, (before, after, angle) in zip(count(0, every), self.pairs(every), strict=False):
            yield before @ _turn_back(self.angles[k]), after @ _turn_back(self.angles[k + 1]), angle


def _turn_back(angle: float) -> Array:
    """Return the matrix that turns rows of points clockwise."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def within(frames: "Frames", window: tuple[float, float]) -> Seen:
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
    positions = frames.positions[inside].astype(np.float64)
    return Seen(positions, frames.times[inside], frames.drum_angles[inside])


def distances(points: Array, others: Array) -> Array:
    """Return the distance of every point from every other one, shape (points, others)."""
    apart: Array = np.hypot(
        np.subtract.outer(points[:, 0], others[:, 0]), np.subtract.outer(points[:, 1], others[:, 1])
    )
    return apart
