"""The tables of a configuration, in SI units but for rpm and degrees; defaults are the paper's Table 1."""

import math
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable
from drumrs.config.config_table import described as _key
from drumrs.config.drum_tables import Drum
from drumrs.config.layers import merge
from drumrs.config.messages import both_given, conflict
from drumrs.config.program import MOST_PHASES, Interval, count_phases, knots_of, unrolled
from drumrs.config.types import Flag, Limit, NonNegative, Positive, Real

Tension = Annotated[Literal["allowed", "clipped"], Limit("'allowed' or 'clipped'")]
Base = Annotated[Literal["linear", "hertz"], Limit("'linear' or 'hertz'")]
TimeStep = Annotated[Literal["auto"] | Positive, Limit("'auto' or a positive finite number")]
Skin = Annotated[Literal["auto"] | NonNegative, Limit("'auto' or a finite number of at least 0")]

_GRAVITY = (0.0, -9.81)
_PHASES = Limit(
    "a list of phases: tables with name, duration, and rpm or ramp, or a group with phase and repeat"
)


class Phase(ConfigTable):
    """A phase of a program: a time at one speed or on a ramp, or a group of phases, which may be repeated."""

    choice: ClassVar[tuple[str, ...]] = ("rpm", "ramp", "phase")

    name: types.Name | None = _key(None, "Name under which it is summed up; its number unless given")
    duration: Positive | None = _key(None, "How long it lasts; a group lasts as long as its phases", "s")
    rpm: Real | None = _key(None, "Speed", "rpm")
    ramp: types.Ramp | None = _key(
        None, "Speeds at its start and end, between which it changes evenly", "rpm"
    )
    phase: Annotated["tuple[Phase, ...]", Field(min_length=1), _PHASES] | None = _key(
        None, "Phases of a group"
    )
    repeat: types.Repeat = _key(1, "How often a group is gone through")
    reversing: Flag = _key(default=False, meaning="Whether every second time it turns the other way round")

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

    rpm: Real | None = _key(None, "Constant speed", "rpm", 54.0)
    program: types.Program | None = _key(
        None,
        "Knots [time, speed] of a program: linear between them, constant beyond the first and last; two of one time "
        "are a jump",
        "s, rpm",
        [[0.0, 0.0], [2.0, 54.0], [20.0, 54.0], [22.0, -54.0]],
    )
    phase: Annotated[tuple[Phase, ...], Field(min_length=1), _PHASES] | None = _key(
        None,
        "Phases of a program, one after the other from t = 0, each a table [[rotation.phase]]; beyond the last "
        "one the speed stays; docs/programs.md",
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


class Load(ConfigTable):
    """The load: equal discs that stand for bundles of fabric."""

    choice: ClassVar[tuple[str, ...]] = ("fill", "count")

    diameter: Positive = _key(0.02375, "Diameter d of a bundle", "m")
    density: Positive = _key(
        1000.0, "Density of a bundle, whose mass is density · π d²/4 per meter of depth", "kg/m³"
    )
    fill: Positive | None = _key(None, "Fill N d²/D², a fraction of the bare drum's area", "1", 0.25)
    count: types.BundleCount | None = _key(None, "Number N of bundles, instead of fill", example=100)
    start_speed: NonNegative = _key(0.0, "Speed of every bundle at t = 0, in a random direction", "m/s")
    spin_locked: Flag = _key(default=False, meaning="Whether bundles are kept from spinning")


class LinearContact(ConfigTable):
    """A linear spring and dashpot with a tangential spring that Coulomb friction cuts off, and terms beside them."""

    choice: ClassVar[tuple[str, ...]] = ("restitution", "normal_damping")

    normal_stiffness: Positive = _key(
        ..., "Stiffness of the normal spring; it does not count where contact.base is 'hertz'", "N/m"
    )
    stiffness_ratio: Positive = _key(1.0, "Tangential stiffness over normal stiffness; likewise", "1")
    young_modulus: Positive | None = _key(
        None, "Young's modulus of both bodies, where contact.base is 'hertz'", "Pa", 1e8
    )
    poisson_ratio: types.PoissonRatio = _key(
        0.3, "Poisson's ratio of both bodies, where contact.base is 'hertz'", "1"
    )
    restitution: types.Restitution | None = _key(
        None, "Coefficient of restitution; the damping follows from it", "1", 0.1
    )
    normal_damping: NonNegative | None = _key(
        None, "Damping of the normal dashpot, instead of restitution", "N s/m", 5.35e3
    )
    friction: NonNegative = _key(0.5, "Coefficient of friction", "1")
    tension: Tension = _key("allowed", "Whether the dashpot may pull: 'allowed' (the paper) or 'clipped'")
    rolling_friction: NonNegative = _key(
        0.0,
        "Coefficient of rolling friction μ_r: a rotational spring that yields where its moment is μ_r times "
        "normal force and radius; 0 for none",
        "1",
    )
    tangential_damping_ratio: NonNegative = _key(
        0.0,
        "Damping ratio of a dashpot beside the tangential spring, which acts while the contact sticks; 0 for none",
        "1",
    )
    adhesion: NonNegative = _key(
        0.0,
        "Constant pull while bodies touch, which friction and rolling feel as pressure; 0 for none",
        "N/m",
    )


class _PartialContact(ConfigTable):
    """Those keys of a contact table that differ for some species; the others are taken from the whole table."""

    normal_stiffness: Positive | None = None
    stiffness_ratio: Positive | None = None
    young_modulus: Positive | None = None
    poisson_ratio: types.PoissonRatio | None = None
    restitution: types.Restitution | None = None
    normal_damping: NonNegative | None = None
    friction: NonNegative | None = None
    tension: Tension | None = None
    rolling_friction: NonNegative | None = None
    tangential_damping_ratio: NonNegative | None = None
    adhesion: NonNegative | None = None

    @model_validator(mode="after")
    def _has_not_both_of_the_pair(self) -> Self:
        if self.restitution is not None and self.normal_damping is not None:
            values = {"restitution": self.restitution, "normal_damping": self.normal_damping}
            raise conflict(**both_given("{at}", list(values), values))
        return self

    def over(self, whole: LinearContact) -> LinearContact:
        """Return the whole table with these keys in place of its own."""
        own = {key: getattr(self, key) for key in LinearContact.model_fields}
        return LinearContact.model_validate(merge(LinearContact, whole.model_dump(), _given(own)))


class PairContact(_PartialContact):
    """What acts between two species instead of ``contact.bundle``."""

    between: types.TwoSpecies


class WallContact(_PartialContact):
    """What acts between a species and the drum instead of ``contact.drum``."""

    species: types.Species


def _given(values: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}


class Contact(ConfigTable):
    """The contact laws: bundle against bundle, bundle against drum."""

    base: Base = _key(
        "linear",
        "Base law of all contacts: 'linear', or 'hertz', Hertz–Mindlin in a layer one disc diameter thick",
    )
    species: types.SpeciesCount = _key(1, "Number of species; a state tells which bundle is of which, from 0")
    pairs: Annotated[tuple[PairContact, ...], Limit("a list of tables with the key between")] = _key(
        (), "Laws between two species: { between = [0, 1], friction = 0.3 }, the rest as in contact.bundle"
    )
    walls: Annotated[tuple[WallContact, ...], Limit("a list of tables with the key species")] = _key(
        (),
        "Laws between a species and the drum: { species = 1, friction = 0.3 }, the rest as in contact.drum",
    )
    bundle: LinearContact = Field(default=LinearContact(normal_stiffness=9.25e7, restitution=0.1))
    drum: LinearContact = Field(default=LinearContact(normal_stiffness=9.70e7, restitution=0.1))

    @model_validator(mode="after")
    def _laws_are_of_species_that_there_are(self) -> Self:
        named = [(f"pairs[{index}].between", sorted(law.between)) for index, law in enumerate(self.pairs)]
        named += [(f"walls[{index}].species", [law.species]) for index, law in enumerate(self.walls)]
        for index, (key, species) in enumerate(named):
            if species[-1] >= self.species:
                raise conflict(f"{{at}}{key}", species, f"below {{at}}species = {self.species}")
            earlier = next((other for other, its in named[:index] if its == species), None)
            if earlier is not None:
                limit = f"another than {{at}}{earlier}, which has its law already"
                raise conflict(f"{{at}}{key}", species, limit)
        return self


class Run(ConfigTable):
    """How long to run, what to record, when to give up."""

    time_step: TimeStep = _key(3.70e-6, "Time step; 'auto' is the shortest collision time / 50", "s")
    duration: Positive = _key(
        30.0, "Simulated time; the number of steps is its quotient by the step, rounded up", "s"
    )
    window: types.Interval | None = _key(
        None,
        "Start and end of the averages; the last third of the duration unless given",
        "s",
        [20.0, 30.0],
    )
    sample_every: Positive = _key(0.002, "Interval between rows of the series; means are exact for any", "s")
    frame_every: Positive = _key(0.04, "Interval between frames (positions, angles, speeds)", "s")
    checkpoint_every: Positive = _key(60.0, "Interval between checkpoints, in time of the wall clock", "s")
    seed: types.Seed = _key(1, "Seed of the random start")
    skin: Skin = _key("auto", "Margin of the neighbor lists, which changes the speed, never a result", "m")
    record: types.Recordings = _key(
        (),
        "What is recorded on request: 'gross_work', the energy that contacts exchange, loading and unloading both "
        "counted; a run is a few per cent slower with it",
    )
    overlap_limit: types.OpenFraction = _key(
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
    gravity: types.Vector = _key(_GRAVITY, "Gravity [x, y]", "m/s²")
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
