"""The tables of the drum: rim, baffles, liner, walls."""

import math
from collections.abc import Iterable
from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable
from drumrs.config.config_table import key as described
from drumrs.config.messages import conflict
from drumrs.config.types import Flag, Limit, NonNegative, Positive, Real

Shape = Annotated[Literal["triangle", "trapezoid", "polygon"], Limit("'triangle', 'trapezoid' or 'polygon'")]
Units = Annotated[Literal["m", "cm", "mm", "in"], Limit("'m', 'cm', 'mm' or 'in'")]


class Baffles(ConfigTable):
    """Equal baffles, spread evenly round the rim.

    The paper's drawing of them is lost. The default shape is inferred from its text, which leaves others: docs/study.
    """

    count: types.BaffleCount = described(0, "Number of baffles; 0 is a bare drum")
    shape: Shape = described("triangle", "'triangle', 'trapezoid' or 'polygon'")
    height: Positive = described(0.04, "Distance of the tip from the rim, along the baffle's axis", "m")
    base: Positive = described(0.02, "Distance (chord) of the two base corners, which lie on the rim", "m")
    tip: NonNegative = described(
        0.01, "Distance of the two tip corners of a trapezoid; 0 for a triangle", "m"
    )
    corner_radius: NonNegative = described(
        0.0, "Radius of the corners inside of the rim; 0 leaves them sharp", "m"
    )
    points: types.Points | None = described(
        None,
        "Corners [x, y] of a polygon: x along the baffle's axis inwards from the rim, y across",
        "m",
        [[0.0, -0.01], [0.04, 0.0], [0.0, 0.01]],
    )
    phase: Real = described(
        0.0, "Angle of the first baffle's axis at t = 0, counter-clockwise from +x", "degrees"
    )

    @model_validator(mode="after")
    def _polygon_has_points(self) -> Self:
        if self.shape == "polygon" and self.points is None:
            limit = "given where {at}shape is 'polygon'"
            raise conflict("{at}points", limit=limit, problem=f"is missing, but must be {limit}")
        return self


class Rail(ConfigTable):
    """Rail bars: equal lifters with straight faces, spread evenly round the rim."""

    count: types.BaffleCount = described(0, "Number of rails; 0 for none")
    height: Positive = described(0.03, "Height of the top above the shell, along the rail's axis", "m")
    width: Positive = described(0.02, "Width of the top", "m")
    face_angle: types.FaceAngle = described(
        0.0,
        "Angle of the leading face, which lifts when the drum turns counter-clockwise, from the radial",
        "degrees",
    )
    back_angle: types.FaceAngle = described(0.0, "Angle of the other face from the radial", "degrees")
    phase: Real = described(
        0.0, "Angle of the first rail's axis at t = 0, counter-clockwise from +x", "degrees"
    )

    @property
    def base(self) -> float:
        """Width at the foot [m]: width + height (tan face_angle + tan back_angle)."""
        return math.fsum((self.width, *self._run_outs()))

    def outline(self, radius: float) -> tuple[tuple[float, float], ...]:
        """Return the first rail's corners [m] in the drum's frame, its axis along +x, in a drum of this radius [m].

        Examples
        --------
        >>> Rail(count=8, height=0.03, width=0.02, face_angle=20.0).outline(0.25)[0]
        (0.22, -0.01)
        """
        half, top = 0.5 * self.width, radius - self.height
        face, back = self._run_outs()
        return (top, -half), (radius, -(half + back)), (radius, half + face), (top, half)

    def _run_outs(self) -> tuple[float, float]:
        """Return how far each face runs out from the top to the foot [m], the leading one first."""
        face, back = (
            self.height * math.tan(math.radians(angle)) for angle in (self.face_angle, self.back_angle)
        )
        return face, back

    @model_validator(mode="after")
    def _faces_do_not_cross(self) -> Self:
        if self.base <= 0.0:
            problem = f"and {{at}}back_angle = {self.back_angle} let the two faces cross above the foot"
            raise conflict("{at}face_angle", self.face_angle, "greater", problem=problem)
        return self


class Outline(ConfigTable):
    """A closed outline of a liner, in the drum's frame."""

    name: types.PartName = described("lifter", "What the part is called in columns and messages")
    points: types.Points = described(..., "Corners [x, y] in order, the axis at the origin", "m")

    @property
    def is_round_the_axis(self) -> bool:
        """Whether the axis lies inside: then the outline is the drum itself, a shell."""
        sides = pairwise((*self.points, self.points[0]))
        crossed = [
            (x0 * y1 > x1 * y0) == (y1 > y0) for (x0, y0), (x1, y1) in sides if (y0 > 0.0) != (y1 > 0.0)
        ]
        return sum(crossed) % 2 == 1


class Liner(ConfigTable):
    """What lines the drum: rails, or the outlines of a drawing, of one pitch or all of it.

    A file is read once, when the configuration is; its outlines then stand in ``outlines`` in place of ``file``,
    ``scale``, ``mirror`` and ``units``.
    """

    file: Annotated[str | None, Limit("the path of a drawing: .dxf, .svg or .csv")] = described(
        None,
        "Drawing (.dxf, .svg, .csv) of one pitch or the whole drum, its axis at the origin; "
        "a path relative to this file",
        example="liner.dxf",
    )
    repeat: types.RepeatCount = described(1, "How often the outlines stand round the drum, evenly")
    scale: Positive = described(1.0, "Factor for all lengths of the file", "1")
    mirror: Flag = described(default=False, meaning="Whether the file is mirrored at its x axis")
    units: Units | None = described(
        None, "Unit of the file: 'm', 'cm', 'mm' or 'in'; unless given what the file says, or m", example="mm"
    )
    outlines: Annotated[tuple[Outline, ...], Limit("a list of tables with name and points")] = described(
        (),
        "Closed outlines instead of a file, each a solid: tables of a name and points [x, y]; one round the axis is "
        "the drum itself, where drum.rim is false",
        "m",
    )
    rail: Rail = Field(default=Rail())

    @model_validator(mode="after")
    def _is_given_once(self) -> Self:
        if self.rail.count and (self.file or self.outlines):
            given = "file" if self.file else "outlines"
            problem = f"and {{at}}{given} are both given, but only one of them may be"
            limit = f"left out where {{at}}{given} is given"
            raise conflict("{at}rail", limit=limit, hint="{at}rail.count = 0 is none", problem=problem)
        for key in ("scale", "mirror", "units") if self.file is None else ():
            if (value := getattr(self, key)) != type(self).model_fields[key].default:
                hint = "a drawing that has been read is in {at}outlines: give its file again to read it otherwise"
                raise conflict(f"{{at}}{key}", value, "left out where no {at}file is given", hint=hint)
        return self


class Drum(ConfigTable):
    """The drum: rim, baffles, liner and straight walls, one rigid body that turns about the origin."""

    diameter: Positive = described(0.475, "Inner diameter D", "m")
    depth: Positive | None = described(
        None, "Depth along the axis; it serves load.mass alone, all results are per meter of depth", "m", 0.35
    )
    rim: Flag = described(default=True, meaning="Whether there is a rim; false leaves liner and walls alone")
    tilt: types.Tilt = described(
        0.0,
        "Angle of the axis to the horizontal; gravity along the axis is left out. Instead of gravity",
        "degrees",
    )
    walls: Annotated[tuple[types.Polyline, ...], Limit("a list of polylines")] = described(
        (), "Further walls: open polylines of points [x, y] at t = 0, which turn with the drum", "m"
    )
    baffles: Baffles = Field(default=Baffles())
    liner: Liner = Field(default=Liner())

    @model_validator(mode="after")
    def _baffles_stand_on_a_rim(self) -> Self:
        for key, count in (("baffles", self.baffles.count), ("liner.rail", self.liner.rail.count)):
            if count and not self.rim:
                raise conflict(f"{{at}}{key}.count", count, "0 where {at}rim is false")
        rail = self.liner.rail
        if rail.count and rail.height >= self.diameter / 2.0:
            limit = f"smaller than half of {{at}}diameter = {self.diameter}, so that it ends before the axis"
            raise conflict("{at}liner.rail.height", rail.height, limit)
        if rail.count and rail.width >= self.diameter:
            limit = f"smaller than {{at}}diameter = {self.diameter}"
            raise conflict("{at}liner.rail.width", rail.width, limit)
        return self

    @model_validator(mode="after")
    def _is_bounded_once(self) -> Self:
        shells = [index for index, one in enumerate(self.liner.outlines) if one.is_round_the_axis]
        at = f"{{at}}liner.outlines[{shells[-1]}]" if shells else ""
        if shells and self.rim:
            problem = "runs round the axis, so it is the drum itself, but there is a rim, too"
            raise conflict(at, problem=problem, hint="write {at}rim = false")
        if len(shells) > 1:
            raise conflict(
                at, problem="runs round the axis, but so does another outline; a drum has one shell"
            )
        if shells and self.liner.repeat > 1:
            limit = "1 where an outline runs round the axis"
            raise conflict("{at}liner.repeat", self.liner.repeat, limit)
        return self

    @property
    def shell(self) -> Outline | None:
        """The outline that is the drum itself, where it is not round."""
        return next((outline for outline in self.liner.outlines if outline.is_round_the_axis), None)

    @property
    def area_diameter(self) -> float:
        """Diameter of the circle that has the area of the bare drum [m]: D, where it is round."""
        if self.shell is None:
            return self.diameter
        points = self.shell.points
        area = (
            abs(math.fsum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in pairwise((*points, points[0])))) / 2.0
        )
        return math.sqrt(4.0 * area / math.pi)

    def fill_of(self, radii: Iterable[float]) -> float:
        """Return the fill of discs of these radii [m]: their area over that of the bare drum."""
        return math.fsum((2.0 * radius) ** 2 for radius in radii) / self.area_diameter**2

    @property
    def fittings(self) -> str:
        """Shell, baffles, rails and lifters in words: "3 baffles", "12 sides and 8 lifters", "no baffles"."""
        lifters = self.liner.repeat * (len(self.liner.outlines) - (self.shell is not None))
        sides = len(self.shell.points) if self.shell else 0
        counts = {
            "side": sides,
            "baffle": self.baffles.count,
            "rail": self.liner.rail.count,
            "lifter": lifters,
        }
        told = [f"{count} {name}{'s' if count > 1 else ''}" for name, count in counts.items() if count]
        return " and ".join(told) or "no baffles"
