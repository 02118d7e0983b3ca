"""`Line`: a polyline of a drawing; `Frame`: the drum that it is drawn for."""

from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

# Units of drawings [m].
UNITS = MappingProxyType({"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254})


@dataclass(frozen=True)
class Line:
    """A polyline with the name of its layer; closed where its last point is its first."""

    layer: str
    points: Points


@dataclass(frozen=True)
class Frame:
    """The drum that a liner is drawn for, and how the numbers of a file become meters.

    Attributes
    ----------
    radius
        Radius of the rim [m]; `None` where there is none.
    repeat
        How often what is drawn stands round the drum.
    scale
        Factor for all lengths.
    mirror
        Whether the drawing is mirrored at its x axis.
    units
        A key of `UNITS`; `None` takes the file's own unit, or meters.
    accuracy
        What may be neglected [m]: the distance of a chord from its curve, the gap between two ends that are one point.
    """

    radius: float | None
    repeat: int
    scale: float
    mirror: bool
    units: str | None
    accuracy: float

    def meters(self, unit: float | None) -> float:
        """Return the length of 1 in the file [m], whose own unit is `unit` [m] or not said."""
        return self.scale * (UNITS[self.units] if self.units else unit or 1.0)


def in_meters(lines: list[Line], unit: float | None, frame: Frame) -> list[Line]:
    """Return lines in meters, mirrored where the frame says so."""
    factor = frame.meters(unit)
    sides = np.array([factor, -factor if frame.mirror else factor])
    return [replace(line, points=line.points * sides) for line in lines]
