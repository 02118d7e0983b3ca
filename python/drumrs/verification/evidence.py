"""What a case of the verification leaves: numbers held against numbers, and what to draw of them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Check:
    """A measured number, held against the expected one.

    Attributes
    ----------
    quantity
        What was measured, and where.
    unit
        Its unit, "1" for a plain number.
    expected, measured
        The two numbers.
    tolerance
        How far they may be apart; 0 asks for the same number.
    """

    quantity: str
    unit: str
    expected: float
    measured: float
    tolerance: float

    @property
    def passed(self) -> bool:
        """Whether the numbers are as near as they must be; what is not finite never is."""
        return bool(abs(self.measured - self.expected) <= self.tolerance)

    @property
    def ratio(self) -> float:
        """The distance of the two numbers over the tolerance: above 1 where the check fails."""
        distance = abs(self.measured - self.expected)
        if distance == 0.0:
            return 0.0
        return distance / self.tolerance if self.tolerance and math.isfinite(distance) else math.inf


def checks(
    quantity: str, unit: str, expected: ArrayLike, measured: ArrayLike, tolerance: ArrayLike
) -> list[Check]:
    """Return a check for each of some expected and measured values.

    Parameters
    ----------
    quantity
        What was measured; a ``{}`` in it is replaced by the number of the value, from 1.
    unit
        Unit of the values.
    expected, measured, tolerance
        Values that broadcast against each other.
    """
    arrays = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (expected, measured, tolerance)))
    rows = zip(*(array.ravel().tolist() for array in arrays), strict=True)
    return [Check(quantity.format(k), unit, *row) for k, row in enumerate(rows, start=1)]


def checks_at(
    places: Sequence[str], expected: ArrayLike, measured: ArrayLike, tolerance: ArrayLike, unit: str = "1"
) -> list[Check]:
    """Return a check for each of some values, each named by a place of its own."""
    arrays = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (expected, measured, tolerance)))
    rows = zip(places, *(array.ravel().tolist() for array in arrays), strict=True)
    return [Check(place, unit, *row) for place, *row in rows]


@dataclass(frozen=True, eq=False)
class Trace:
    """Measured points, and the curve that they must lie on.

    Attributes
    ----------
    label
        Name, shown where a picture has several; it may be empty.
    x, y
        The measured points.
    curve
        The expected curve as (x, y), or `None`.
    """

    label: str
    x: ArrayLike
    y: ArrayLike
    curve: tuple[ArrayLike, ArrayLike] | None = None


def shared_curve(x: ArrayLike, y: ArrayLike) -> Trace:
    """Return a curve that several sets of points share."""
    return Trace("", (), (), (x, y))


@dataclass(frozen=True, eq=False)
class Panel:
    """What is drawn of a case.

    Attributes
    ----------
    x, y
        Labels of the axes, with units.
    traces
        Points and curves.
    logarithmic
        Whether both axes are.
    """

    x: str
    y: str
    traces: tuple[Trace, ...]
    logarithmic: bool = False


def vanishing(label: str, traces: Sequence[Trace]) -> Panel:
    """Return what is drawn of numbers that must vanish: each over its tolerance, between the bounds −1 and 1.

    Parameters
    ----------
    label
        Label of the horizontal axis.
    traces
        The numbers, over their tolerances.
    """
    x = np.concatenate([np.ravel(np.asarray(trace.x, float)) for trace in traces])
    left, right = float(x.min()), float(x.max())
    frame = Trace("allowed", (), (), ([left, right, right, left, left], [-1.0, -1.0, 1.0, 1.0, -1.0]))
    zero = shared_curve([left, right], [0.0, 0.0])
    return Panel(label, "measured / allowed", (zero, frame, *traces))


@dataclass(frozen=True, eq=False)
class Evidence:
    """All that a case found.

    Attributes
    ----------
    checks
        At least one; the case passes where all of them do.
    panel
        What is drawn.
    """

    checks: tuple[Check, ...]
    panel: Panel

    @property
    def worst(self) -> Check:
        """The check that is nearest to failing, or fails by most."""
        return max(self.checks, key=lambda check: check.ratio)

    @property
    def passed(self) -> bool:
        """Whether every check passed, and there was one."""
        return bool(self.checks) and all(check.passed for check in self.checks)
