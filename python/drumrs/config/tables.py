"""The tables of a configuration, in SI units but for rpm and angles in degrees; defaults are the paper's Table 1.

Those of the load and of the contact laws are in `load` and `contact`.
"""

import math
from itertools import pairwise
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable, key
from drumrs.config.contact import Contact
from drumrs.config.drum_tables import Drum
from drumrs.config.load import Load
from drumrs.config.messages import conflict
from drumrs.config.program import MOST_PHASES, Interval, count_phases, knots_of, unrolled
from drumrs.config.types import Flag, Limit, NonNegative, Positive, Real

TimeStep = Annotated[Literal["auto"] | Positive, Limit("'auto' or a positive finite number")]
Skin = Annotated[Literal["auto"] | NonNegative, Limit("'auto' or a finite number of at least 0")]

_GRAVITY = (0.0, -9.81)
_PHASES = Limit(
    "a list of phases: tables with name, duration, and rpm or ramp, or a group with phase and repeat"
)
_ZONES = Limit("a list of zones: tables with name, corners and, where it turns with the drum, frame = 'drum'")


class Phase(ConfigTable):
    """A phase of a program: a time at one speed or on a ramp, or a group of phases, which may be repeated."""

    choice: ClassVar[tuple[str, ...]] = ("rpm", "ramp", "phase")

    name: types.Name | None = key(None, "Name under which it is summed up; its number unless given")
    duration: Positive | None = key(None, "How long it lasts; a group lasts as long as its phases", "s")
    rpm: Real | None = key(None, "Speed", "rpm")
    ramp: types.Ramp | None = key(None, "Speeds at its start and end, between which it changes evenly", "rpm")
    phase: Annotated["tuple[Phase, ...]", Field(min_length=1), _PHASES] | None = key(
        None, "Phases of a group"
    )
    repeat: types.Repeat = key(1, "How often a group is gone through")
    reversing: Flag = key(default=False, meaning="Whether every second time it turns the other way round")

    @model_validator(mode="after")
    def _lasts_and_repeats_as_it_may(self) -> Self:
        if self.phase is None and self.duration is None:
            limit = "given: how many seconds the phase lasts"
            raise conflict("{at}duration", limit=limit, problem=f"is missing, but must be {limit}")
        if self.phase is not None and self.duration is not None:
            raise conflict(
                "{at}duration", self.duration, "left out of a group, which lasts as long as its phases"
            )
        if self.phase is None and (self.repeat > 1 or self.reversing):
            key, value = ("repeat", self.repeat) if self.repeat > 1 else ("reversing", self.reversing)
            hint = "a group is { phase = [{ … }, { … }], repeat = 10 }"
            raise conflict(f"{{at}}{key}", value, "left out of a phase that is no group", hint=hint)
        return self


class Rotation(ConfigTable):
    """How the drum turns, counter-clockwise positive: one speed, a program by knots, or a program by phases."""

    choice: ClassVar[tuple[str, ...]] = ("rpm", "program", "phase")

    rpm: Real | None = key(None, "Constant speed", "rpm", 54.0)
    program: types.Program | None = key(
        None,
        "Knots [time, speed] of a program: linear between them, constant beyond the first and last; two of one time "
        "are a jump",
        "s, rpm",
        [[0.0, 0.0], [2.0, 54.0], [20.0, 54.0], [22.0, -54.0]],
    )
    phase: Annotated[tuple[Phase, ...], Field(min_length=1), _PHASES] | None = key(
        None,
        "Phases of a program, one after the other from t = 0, each a table [[rotation.phase]]; beyond the last "
        "one the speed stays; docs/how-to/programs.md",
        example=[
            {"name": "tumble", "duration": 12.0, "rpm": 54.0},
            {"name": "stop", "duration": 3.0, "rpm": 0.0},
        ],
    )

    @property
    def given(self) -> str:
        """Name of the key that says how the drum turns."""
        return next(key for key in self.choice if getattr(self, key) is not None)

    @property
    def speeds(self) -> list[float]:
        """Speeds that the drum has, those between which it changes evenly left out [rpm]."""
        return [rpm for _, rpm in self.knots]

    @property
    def knots(self) -> types.Program:
        """Knots [s, rpm] of the speed over time."""
        return self.program or knots_of(self.intervals) or ((0.0, self.rpm or 0.0),)

    @property
    def intervals(self) -> list[Interval]:
        """The phases in the order of time, groups unrolled; none without phases."""
        return unrolled(self.phase or ())

    @model_validator(mode="after")
    def _knots_are_in_order(self) -> Self:
        times = [time for time, _ in self.program or ()]
        for index, (earlier, later) in enumerate(pairwise(times), 1):
            if later < earlier:
                limit = f"no earlier than the knot before it, which is at {earlier} s"
            elif times[:index].count(later) > 1:
                limit = "later than the two knots before it, which are a jump"
            else:
                continue
            problem = f"is at {later} s, but must be {limit}"
            raise conflict(f"{{at}}program[{index}]", (self.program or ())[index], limit, problem=problem)
        return self

    @model_validator(mode="after")
    def _phases_can_be_counted(self) -> Self:
        number = count_phases(self.phase or ())
        if number > MOST_PHASES:
            limit = f"at most {MOST_PHASES} of them"
            problem = f"has {number} phases, repeats counted, but must have {limit}"
            hint = "lower repeat, or shorten the program to the time that is simulated"
            raise conflict("{at}phase", limit=limit, problem=problem, hint=hint)
        return self


class Zone(ConfigTable):
    """A zone whose visits are counted, such as that of a spray; no bundle feels it.

    Attributes
    ----------
    name
        Name under which its visits are counted.
    corners
        Corners of a polygon [x, y], about the axis [m].
    frame
        Whether it stands, in the "laboratory", or turns with the "drum".
    """

    name: types.Name
    corners: types.Points
    frame: types.ZoneFrame = "laboratory"


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
    frame_every: Positive = key(
        0.04, "Interval between frames (positions, angles, velocities, numbers of contacts)", "s"
    )
    checkpoint_every: Positive = key(60.0, "Interval between checkpoints, in time of the wall clock", "s")
    seed: types.Seed = key(1, "Seed of the random start")
    skin: Skin = key("auto", "Margin of the neighbor lists, which changes the speed, never a result", "m")
    record: types.Recordings = key(
        (),
        "What is recorded on request: 'gross_work', the energy that contacts exchange, loading and unloading both "
        "counted; 'contacts', every contact; 'wall_profile', impulse, losses and wear along the outline of the drum; "
        "'ledger_split', losses by species and part; 'discs', what each bundle received, and its flights; 'fields', "
        "density, velocity and stress in cells",
    )
    contact_floor: NonNegative = key(
        0.0, "Energy below which a contact is not listed by itself, but in one row with all of these", "J/m"
    )
    arc_bin: Positive | None = key(
        None, "Width of the bins of 'wall_profile'; a twentieth of the drum's radius unless given", "m", 0.01
    )
    cell: Positive | None = key(
        None, "Side of the cells of 'fields'; the mean radius of the bundles unless given", "m", 0.01
    )
    zone: Annotated[tuple[Zone, ...], Field(min_length=1), _ZONES] | None = key(
        None,
        "Zones whose visits are counted, tables [[run.zone]] with name, corners and frame; docs/reference/records.md",
        example=[{"name": "spray", "corners": [[0.0, -0.1], [0.15, 0.0], [0.1, 0.1], [-0.05, 0.0]]}],
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

    @property
    def told_until(self) -> float:
        """Time until which fields and visits count [s]: infinite where the averages go on to the end of the run."""
        end = self.averaging_window[1]
        return end if end < self.duration else math.inf


class Tables(ConfigTable):
    """All tables together, as the baseline has them."""

    drum: Drum = Field(default=Drum())
    rotation: Rotation = Field(default=Rotation(rpm=54.0))
    load: Load = Field(default=Load(fill=0.25))
    contact: Contact = Field(default=Contact())
    gravity: types.Vector = key(_GRAVITY, "Gravity [x, y]", "m/s²")
    run: Run = Field(default=Run())

    @property
    def plane_gravity(self) -> tuple[float, float]:
        """Gravity in the plane of the drum, [x, y] in m/s²: g cos τ where the axis is tilted by τ."""
        part = math.cos(math.radians(self.drum.tilt))
        return self.gravity[0] * part, self.gravity[1] * part

    @model_validator(mode="after")
    def _gravity_or_tilt(self) -> Self:
        if self.drum.tilt and self.gravity != _GRAVITY:
            hint = "drum.tilt takes its part of 9.81 m/s²; other gravity is given as gravity = [x, y] in the plane"
            raise conflict("drum.tilt", self.drum.tilt, "left out where gravity is given", hint=hint)
        return self
