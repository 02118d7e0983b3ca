"""The tables of a configuration, in SI units but for rpm and the baffles' phase; defaults are the paper's Table 1.

Those of the load and of the contact laws are in `load` and `contact`.
"""

from itertools import pairwise
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable, key
from drumrs.config.contact import Contact
from drumrs.config.load import Load
from drumrs.config.messages import conflict
from drumrs.config.types import Flag, Limit, NonNegative, Positive, Real

Shape = Annotated[Literal["triangle", "trapezoid", "polygon"], Limit("'triangle', 'trapezoid' or 'polygon'")]
TimeStep = Annotated[Literal["auto"] | Positive, Limit("'auto' or a positive finite number")]
Skin = Annotated[Literal["auto"] | NonNegative, Limit("'auto' or a finite number of at least 0")]


class Baffles(ConfigTable):
    """Equal baffles, spread evenly round the rim.

    The paper's drawing of them is lost. The default shape is inferred from its text, which leaves others: docs/study.
    """

    count: types.BaffleCount = key(0, "Number of baffles; 0 is a bare drum")
    shape: Shape = key("triangle", "'triangle', 'trapezoid' or 'polygon'")
    height: Positive = key(0.04, "Distance of the tip from the rim, along the baffle's axis", "m")
    base: Positive = key(0.02, "Distance (chord) of the two base corners, which lie on the rim", "m")
    tip: Positive = key(0.01, "Distance of the two tip corners of a trapezoid", "m")
    points: types.Points | None = key(
        None,
        "Corners [x, y] of a polygon: x along the baffle's axis inwards from the rim, y across",
        "m",
        [[0.0, -0.01], [0.04, 0.0], [0.0, 0.01]],
    )
    phase: Real = key(0.0, "Angle of the first baffle's axis at t = 0, counter-clockwise from +x", "degrees")

    @model_validator(mode="after")
    def _polygon_has_points(self) -> Self:
        if self.shape == "polygon" and self.points is None:
            limit = "given where {at}shape is 'polygon'"
            raise conflict("{at}points", limit=limit, problem=f"is missing, but must be {limit}")
        return self


class Drum(ConfigTable):
    """The drum: rim, baffles and straight walls, one rigid body that turns about the origin."""

    diameter: Positive = key(0.475, "Inner diameter D", "m")
    depth: Positive | None = key(
        None, "Depth along the axis; it serves load.mass alone, all results are per meter of depth", "m", 0.35
    )
    rim: Flag = key(default=True, meaning="Whether there is a rim; false leaves the walls alone")
    walls: Annotated[tuple[types.Polyline, ...], Limit("a list of polylines")] = key(
        (), "Further walls: open polylines of points [x, y] at t = 0, which turn with the drum", "m"
    )
    baffles: Baffles = Field(default=Baffles())

    @model_validator(mode="after")
    def _baffles_stand_on_a_rim(self) -> Self:
        if self.baffles.count and not self.rim:
            raise conflict("{at}baffles.count", self.baffles.count, "0 where {at}rim is false")
        return self


class Rotation(ConfigTable):
    """How the drum turns, counter-clockwise positive: one speed, or a program."""

    choice: ClassVar[tuple[str, ...]] = ("rpm", "program")

    rpm: Real | None = key(None, "Constant speed", "rpm", 54.0)
    program: types.Program | None = key(
        None,
        "Knots [time, speed] of a program: linear between them, constant beyond the first and last",
        "s, rpm",
        [[0.0, 0.0], [2.0, 54.0], [20.0, 54.0], [22.0, -54.0]],
    )

    @model_validator(mode="after")
    def _knots_are_in_order(self) -> Self:
        for index, ((earlier, before), (later, after)) in enumerate(pairwise(self.program or ()), 1):
            if later > earlier:
                continue
            limit = f"later than the knot before it, which is at {earlier} s"
            hint = ""
            if later == earlier and before != after:
                limit += f": the speed cannot jump from {before} to {after} rpm"
                hint = f"to change it within a millisecond, write [{later + 1e-3:.12g}, {after}]"
            problem = f"is at {later} s, but must be {limit}"
            raise conflict(f"{{at}}program[{index}]", (later, after), limit, hint=hint, problem=problem)
        return self


class Run(ConfigTable):
    """How long to run, what to record, when to give up."""

    time_step: TimeStep = key(3.70e-6, "Time step; 'auto' is the shortest collision time / 50", "s")
    duration: Positive = key(
        30.0, "Simulated time; the number of steps is its quotient by the step, rounded up", "s"
    )
    window: types.Interval | None = key(
        None,
        "Start and end of the averages; the last third of the duration unless given",
        "s",
        [20.0, 30.0],
    )
    sample_every: Positive = key(0.002, "Interval between rows of the series; means are exact for any", "s")
    frame_every: Positive = key(0.04, "Interval between frames (positions, angles, speeds)", "s")
    checkpoint_every: Positive = key(60.0, "Interval between checkpoints, in time of the wall clock", "s")
    seed: types.Seed = key(1, "Seed of the random start")
    skin: Skin = key("auto", "Margin of the neighbor lists, which changes the speed, never a result", "m")
    record: types.Recordings = key(
        (),
        "What is recorded on request: 'gross_work', the energy that contacts exchange, loading and unloading both "
        "counted; a run is a few per cent slower with it",
    )
    overlap_limit: types.OpenFraction = key(
        0.5, "Greatest overlap, over the smaller radius, before the run is given up as unstable", "1"
    )

    @model_validator(mode="after")
    def _window_lies_in_the_duration(self) -> Self:
        start, end = self.averaging_window
        if not start < end <= self.duration:
            limit = f"a pair [start, end] with 0 <= start < end <= {{at}}duration = {self.duration}"
            raise conflict("{at}window", self.window, limit)
        return self

    @property
    def averaging_window(self) -> tuple[float, float]:
        """Interval of the averages [s]: `window`, or the last third of the duration."""
        return self.window or (self.duration * 2.0 / 3.0, self.duration)


class Tables(ConfigTable):
    """All tables together, as the baseline has them."""

    drum: Drum = Field(default=Drum())
    rotation: Rotation = Field(default=Rotation(rpm=54.0))
    load: Load = Field(default=Load(fill=0.25))
    contact: Contact = Field(default=Contact())
    gravity: types.Vector = key((0.0, -9.81), "Gravity [x, y]", "m/s²")
    run: Run = Field(default=Run())
