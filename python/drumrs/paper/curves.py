"""Curves of the study: one quantity against one parameter, the others as in the paper's Table 1."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis import Estimate, combine, estimate
from drumrs.config import baseline
from drumrs.paper.cases import BASELINE_FILL, SIZE_FILL, THIRDS, percent
from drumrs.paper.drums import BAFFLED, BARE, Drum
from drumrs.paper.verdict import MissingError

if TYPE_CHECKING:
    import polars as pl

# Column of each parameter, and its value in Table 1.
AXES: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "fill": ("load.fill", BASELINE_FILL),
        "size": ("size_ratio", 20.0),
        "friction": ("contact.bundle.friction", 0.5),
        "speed": ("rotation.rpm", 54.0),
        "restitution": ("contact.bundle.restitution", 0.1),
    }
)
# Readings of N/T, the one first by which claims are judged: what normal contacts exchange over what tangential ones do,
# loading and unloading both counted; what they dissipate; and what they dissipate and store on balance.
RATIOS = ("gross_work_ratio", "dissipation_ratio", "work_ratio")
_STIFFNESS = "contact.bundle.normal_stiffness"
# Values of a parameter this near each other are the same.
_SAME = 1e-6
# Turns of the drum that a window must hold for its blocks to tell an error.
_LEAST_TURNS = 0.5


@dataclass(frozen=True)
class Point:
    """A quantity at one value of a parameter, seed by seed.

    Attributes
    ----------
    x
        The parameter.
    values, errors
        One mean a seed, and its standard error from blocks.
    drifting
        Whether one of the seeds was not steady.
    """

    x: float
    values: tuple[float, ...]
    errors: tuple[float | None, ...]
    drifting: bool = False

    @property
    def estimate(self) -> Estimate:
        """Mean over the seeds."""
        return estimate(self.values, self.errors)


@dataclass(frozen=True)
class Curve:
    """Points in the order of the parameter.

    Attributes
    ----------
    label
        What tells it from the other curves of its figure, such as ``"without baffles"``.
    points
        Its points.
    axis, column
        The parameter, a key of `AXES`, and the quantity.
    softer
        By how much springs were softer than Table 1's.
    """

    label: str
    points: tuple[Point, ...]
    axis: str = "fill"
    column: str = ""
    softer: float = 1.0

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points)

    @property
    def x(self) -> NDArray[np.float64]:
        """Values of the parameter."""
        return np.array([point.x for point in self.points])

    @property
    def estimates(self) -> list[Estimate]:
        """Means over the seeds, point by point."""
        return [point.estimate for point in self.points]

    def at(self, x: float) -> Estimate:
        """Return the mean at a value of the parameter.

        Raises
        ------
        MissingError
            Where there is no such point.
        """
        for point in self.points:
            if abs(point.x - x) < _SAME:
                return point.estimate
        raise MissingError(f"{self.label} at {x:g}")

    def between(self, low: float = -math.inf, high: float = math.inf, *, least: int = 1) -> "Curve":
        """Return the points from one value of the parameter to another, both included.

        Raises
        ------
        MissingError
            Where they are fewer than `least`.
        """
        points = tuple(point for point in self.points if low - _SAME < point.x < high + _SAME)
        if len(points) < least:
            raise MissingError(
                f"{self.label}, of which {least} points are needed where there are {len(points)}"
            )
        return replace(self, points=points)

    def below(self, limit: float) -> "Curve":
        """Return the points below a value of the parameter, which is itself left out."""
        return self.between(high=limit - 2.0 * _SAME)

    def above(self, limit: float) -> "Curve":
        """Return the points above a value of the parameter, which is itself left out."""
        return self.between(low=limit + 2.0 * _SAME)

    def against(
        self, other: "Curve", f: Callable[[Estimate, Estimate], Estimate]
    ) -> list[tuple[float, Estimate]]:
        """Return what a function makes of both curves, at the values of the parameter that both have."""
        known = other.x
        common = [point for point in self.points if (np.abs(known - point.x) < _SAME).any()]
        return [(point.x, f(point.estimate, other.at(point.x))) for point in common]


@dataclass(frozen=True, eq=False)
class Results:
    """The table of a study, read as curves.

    Attributes
    ----------
    table
        What `measure` returned.
    steady_only
        Whether runs that drift are left out.
    baffled
        The drum that stands for the one with baffles.
    ratio
        The column that stands for N/T, one of `RATIOS`.
    """

    table: "pl.DataFrame"
    steady_only: bool = False
    baffled: Drum = BAFFLED
    ratio: str = RATIOS[0]
    # Claims, figures and thumbnails ask for the same curves again and again: what `replace` makes shares them.
    _curves: dict[tuple[Any, ...], Curve] = field(default_factory=dict, repr=False)

    @property
    def drums(self) -> tuple[Drum, Drum]:
        """The bare drum, and the one with baffles."""
        return (BARE, self.baffled)

    def curve(
        self,
        axis: str,
        column: str,
        *,
        drum: Drum = BARE,
        fill: float | None = None,
        softer: float | None = None,
    ) -> Curve:
        """Return a quantity against a parameter.

        A curve is of one stiffness: that with most points, of as many the stiffest. N/T depends on it, and is taken
        from runs with Table 1's alone; without friction there is no T.

        Parameters
        ----------
        axis
            Key of `AXES`.
        column
            Column of the table; its errors are in ``…_error``, where there is one.
        drum
            The drum.
        fill
            Fill of all points; unless given 40 % for sizes, 25 % for the rest.
        softer
            By how much springs are softer than Table 1's, where another stiffness is wanted.

        Returns
        -------
        Curve
            With no points where the table has none.
        """
        wanted = (axis, column, drum, fill, softer)
        key = (self.steady_only, *wanted)
        if key not in self._curves:
            self._curves[key] = self._curve(*wanted)
        return self._curves[key]

    def _curve(self, axis: str, column: str, drum: Drum, fill: float | None, softer: float | None) -> Curve:
        label = drum.name if fill is None else f"{percent(fill)} fill"
        if column not in self.table.columns:
            return Curve(label, (), axis, column)
        stiff = baseline().contact.bundle.normal_stiffness
        at: dict[float, dict[float, list[dict[str, Any]]]] = {}
        rows = self._rows(axis, drum=drum, fill=fill).drop_nulls(column)
        if column in RATIOS:
            rows = rows.filter(rows[AXES["friction"][0]] > 0.0)
        for row in rows.iter_rows(named=True):
            alike = at.setdefault(round(stiff / row[_STIFFNESS], 9), {})
            alike.setdefault(round(float(row[AXES[axis][0]]), 9), []).append(row)
        if softer is None:
            softer = 1.0 if column in RATIOS else max(at, key=lambda one: (len(at[one]), -one), default=1.0)
        points = []
        for x, seeds in sorted(at.get(softer, {}).items()):
            steady = [row for row in seeds if not (self.steady_only and row["drifting"])]
            points += [_point(x, steady, column)] if steady else []
        return Curve(label, tuple(points), axis, column, softer)

    def shown(self, axis: str, column: str) -> list[Curve]:
        """Return the curves that the paper's figure of a quantity against a parameter shows."""
        if axis == "friction":
            return [self.curve(axis, column, fill=fill) for fill in THIRDS]
        return [self.curve(axis, column, drum=drum) for drum in self.drums]

    def largest(self, axis: str, column: str) -> float:
        """Return the largest value of the figure of a quantity against a parameter: the scale on which it is read.

        Raises
        ------
        MissingError
            Where the figure has no point.
        """
        every = replace(self, steady_only=False)
        means = [one.mean for curve in every.shown(axis, column) for one in curve.estimates]
        if not means:
            raise MissingError(f"every point of {column} against {axis}")
        return max(means)

    def usual(self, column: str, fill: float) -> float:
        """Return the mean of a quantity in Table 1's bare drum, drifting runs included: a scale for others.

        Raises
        ------
        MissingError
            Where there is no such case.
        """
        every = replace(self, steady_only=False).curve("fill", column)
        return every.at(fill).mean

    def _rows(self, axis: str, *, drum: Drum, fill: float | None) -> "pl.DataFrame":
        import polars as pl

        fixed = {name: value for name, (_, value) in AXES.items() if name != axis}
        if axis != "fill":
            fixed["fill"] = fill if fill is not None else SIZE_FILL if axis == "size" else BASELINE_FILL
        same = [(pl.col(AXES[name][0]) - value).abs() < _SAME for name, value in fixed.items()]
        return self.table.filter(drum.rows, *same).sort("seed", maintain_order=True)


def _point(x: float, rows: Sequence[Mapping[str, Any]], column: str) -> Point:
    values = tuple(float(row[column]) for row in rows)
    errors = tuple(None if _is_thin(row) else row.get(f"{column}_error") for row in rows)
    return Point(x, values, errors, any(bool(row["drifting"]) for row in rows))


def _is_thin(row: Mapping[str, Any]) -> bool:
    """Tell a window too short for an error of its own: in half a turn nothing comes round."""
    turns = (row["window_end"] - row["window_start"]) * abs(row["rotation.rpm"] or 0.0) / 60.0
    return bool(turns < _LEAST_TURNS)


def slope(curve: Curve) -> Estimate:
    """Return the slope of the straight line through a curve, least squares.

    Raises
    ------
    MissingError
        Where there are fewer than two points.
    """
    curve = curve.between(least=2)
    apart = curve.x - curve.x.mean()
    weights = apart / (apart @ apart)
    means = np.array([one.mean for one in curve.estimates])
    return combine(float(weights @ means), list(zip(weights.tolist(), curve.estimates, strict=True)))


@dataclass(frozen=True)
class Peak:
    """Where a curve is highest, and how it bends there."""

    place: Estimate
    bend: Estimate


# Points as far as this from the highest, in fill, take part in the parabola.
_REACH = 0.15
# A parabola through fewer points has no say of its own.
_PARABOLA = 4


def peak(curve: Curve) -> Peak:
    """Return the vertex of the parabola through the points near the highest, with its error.

    Raises
    ------
    MissingError
        Where fewer than four points are near.
    """
    curve = curve.between()
    highest = curve.x[int(np.argmax([one.mean for one in curve.estimates]))]
    near = curve.between(highest - _REACH, highest + _REACH, least=_PARABOLA)
    x, estimates = near.x - highest, near.estimates
    means = np.array([one.mean for one in estimates])
    # Rows of the pseudoinverse give the parabola's coefficients as sums over the means.
    _, linear, square = np.linalg.pinv(np.stack([np.ones_like(x), x, x**2], axis=1))
    b, c = float(linear @ means), float(square @ means)
    bend = combine(c, list(zip(square.tolist(), estimates, strict=True)))
    if c == 0.0:
        return Peak(Estimate(float(highest), np.inf, 1), bend)
    derivative = (-linear * c + b * square) / (2.0 * c * c)
    place = combine(float(highest - b / (2.0 * c)), list(zip(derivative.tolist(), estimates, strict=True)))
    return Peak(place, bend)
