"""The tables of the load: how much there is of it, of which species, and how large their bundles are."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable, key
from drumrs.config.contact import PartialContact
from drumrs.config.derived import GREATEST_SPECIES
from drumrs.config.messages import both_given, conflict
from drumrs.config.presets import presets, with_preset
from drumrs.config.types import Flag, Limit, NonNegative, Positive

# The keys of each size law: those that it needs, and those that it takes.
_LAWS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "mix": (("diameters", "shares"), ()),
    "table": (("diameters", "passing"), ()),
    "gaudin-schuhmann": (("top_size", "modulus"), ("smallest",)),
    "rosin-rammler": (("size_63", "modulus"), ("smallest", "largest")),
    "lognormal": (("median", "sigma"), ("smallest", "largest")),
    "normal": (("mean", "sigma"), ("smallest", "largest")),
}
_LAW_NAMES = ", ".join(map(repr, _LAWS))
Law = Annotated[
    Literal["mix", "table", "gaudin-schuhmann", "rosin-rammler", "lognormal", "normal"],
    Limit(f"one of {_LAW_NAMES}"),
]
# Solid fraction of a bed of discs at rest.
SOLID_FRACTION = 0.82


class Sizes(ConfigTable):
    """A law of diameters: which share of a species is smaller than a diameter; formulas: docs/how-to/loads.md."""

    law: Law
    by: types.Measure
    diameters: types.Numbers | None = None
    shares: types.Numbers | None = None
    passing: types.Numbers | None = None
    top_size: Positive | None = None
    size_63: Positive | None = None
    modulus: Positive | None = None
    median: Positive | None = None
    mean: Positive | None = None
    sigma: Positive | None = None
    smallest: Positive | None = None
    largest: Positive | None = None

    @model_validator(mode="after")
    def _has_the_keys_of_its_law(self) -> Self:
        needed, taken = _LAWS[self.law]
        keys = " and ".join(needed) + (f", and may have {' and '.join(taken)}" if taken else "")
        limit = f"given: the law {self.law!r} has {keys}"
        for name in needed:
            if getattr(self, name) is None:
                raise conflict(f"{{at}}{name}", limit=limit, problem=f"is missing, but must be {limit}")
        for name in type(self).model_fields:
            value = getattr(self, name)
            if value is not None and name not in {"law", "by", *needed, *taken}:
                raise conflict(f"{{at}}{name}", value, f"left out: the law {self.law!r} has {keys}")
        return self

    def to_core(self) -> dict[str, Any]:
        """Return the law as the core reads it."""
        values = {name: getattr(self, name) for name in _LAWS[self.law][0]}
        if self.law in {"mix", "table"}:
            return {self.law: {"by": self.by, **values}}
        ends = {name: getattr(self, name) for name in ("smallest", "largest")}
        return {"formula": {"by": self.by, "formula": {self.law: values}, **ends}}


class Species(ConfigTable):
    """Bundles of one material; what is not set is that of ``load``, ``contact.bundle`` and ``contact.drum``.

    Attributes
    ----------
    name
        What contact laws, tables and pictures call it.
    preset
        Name of a material whose density and contact keys it has, but for those given beside it (docs/how-to/loads.md).
        They take its place when the configuration is validated.
    share
        Its share of the load, counted by ``load.share_by``; all of it unless given.
    density
        Dry density [kg/m³].
    diameter, sizes
        Diameter of all its bundles [m], or a law of diameters.
    contact
        Those keys of a contact table that differ among its own bundles, and between them and the drum.
    """

    name: types.SpeciesName
    preset: str | None = Field(default=None, json_schema_extra={"enum": [*presets()]})
    share: Positive | None = None
    density: Positive | None = None
    diameter: Positive | None = None
    sizes: Sizes | None = None
    contact: PartialContact | None = None

    @model_validator(mode="before")
    @classmethod
    def _preset_is_filled_in(cls, values: Any) -> Any:
        return with_preset(values)

    @model_validator(mode="after")
    def _has_one_kind_of_size(self) -> Self:
        if self.diameter is not None and self.sizes is not None:
            values = {"diameter": self.diameter, "sizes": "a table"}
            raise conflict(**both_given("{at}", list(values), values))
        return self


class Load(ConfigTable):
    """The load: discs that stand for bundles of fabric, balls, grains; equal ones unless there are species."""

    choice: ClassVar[tuple[str, ...]] = ("fill", "count", "bulk_fill", "mass")

    diameter: Positive = key(0.02375, "Diameter d of a bundle", "m")
    density: Positive = key(
        1000.0, "Density of a bundle, dry; its mass is density · π d²/4 per meter of depth", "kg/m³"
    )
    species: Annotated[tuple[Species, ...], Limit("a list of tables with the key name")] | None = key(
        None,
        "What the load is made of: tables with name, share, density, diameter or sizes, contact (docs/how-to/loads.md)",
        example=[{"name": "steel-ball", "share": 1.0, "density": 7800.0, "diameter": 0.02}],
    )
    share_by: types.Measure | None = key(
        None, "What the shares of species are counted by: 'mass', 'area' or 'number'", example="mass"
    )
    moisture: NonNegative | None = key(
        None, "Water that the load holds, over its dry mass; all densities grow by it", "1", 0.6
    )
    fill: Positive | None = key(
        None, "Area of all bundles over that of the bare drum; N d²/D² of equal ones", "1", 0.25
    )
    bulk_fill: Positive | None = key(
        None, "Area of the bed at rest, voids counted, over that of the bare drum (J of mills)", "1", 0.3
    )
    solid_fraction: types.OpenFraction | None = key(
        None, f"Solid fraction of that bed, by area; {SOLID_FRACTION} unless given", "1", SOLID_FRACTION
    )
    count: types.BundleCount | None = key(None, "Number N of bundles, instead of fill", example=100)
    mass: Positive | None = key(
        None, "Dry mass of the load of a drum as deep as drum.depth, instead of fill", "kg", 7.0
    )
    start_speed: NonNegative = key(0.0, "Speed of every bundle at t = 0, in a random direction", "m/s")
    spin_locked: Flag = key(default=False, meaning="Whether bundles are kept from spinning")

    @model_validator(mode="after")
    def _species_are_told_apart(self) -> Self:
        names = self.names
        if len(names) > GREATEST_SPECIES:
            limit = f"a list of at most {GREATEST_SPECIES} species"
            raise conflict("{at}species", f"{len(names)} tables", limit)
        for index, name in enumerate(names):
            if name in names[:index]:
                limit = f"another name than that of {{at}}species[{names.index(name)}]"
                raise conflict(f"{{at}}species[{index}].name", name, limit)
        lacking = next((k for k, own in enumerate(self.species or ()) if own.share is None), None)
        if len(names) > 1 and lacking is not None:
            limit = "given where there are several species"
            at = f"{{at}}species[{lacking}].share"
            raise conflict(at, limit=limit, problem=f"is missing, but must be {limit}")
        if len(names) > 1 and self.share_by is None:
            limit = (
                "'mass', 'area' or 'number' where there are several species: their shares are counted by it"
            )
            raise conflict("{at}share_by", limit=limit, problem=f"is missing, but must be {limit}")
        return self

    @model_validator(mode="after")
    def _solid_fraction_is_of_a_bulk_fill(self) -> Self:
        if self.solid_fraction is not None and self.bulk_fill is None:
            limit = "left out: it goes with {at}bulk_fill"
            raise conflict("{at}solid_fraction", self.solid_fraction, limit)
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the species; none where the bundles are equal."""
        return tuple(own.name for own in self.species or ())

    def solid_area(self, drum_area: float) -> float | None:
        """Return the area of all bundles [m²] that a fill asks for, `None` where another key says how much."""
        if self.bulk_fill is not None:
            return self.bulk_fill * (self.solid_fraction or SOLID_FRACTION) * drum_area
        return None if self.fill is None else self.fill * drum_area

    def species_to_core(self) -> list[dict[str, Any]]:
        """Return the species as the core reads them: complete, and with the water that they hold."""
        return [
            {
                "share": 1.0 if own.share is None else own.share,
                "density": self.wet(own.density or self.density),
                "sizes": (own.sizes or _equal(own.diameter or self.diameter)).to_core(),
            }
            for own in self.species or ()
        ]

    def wet(self, density: float) -> float:
        """Return a density with the water that the load holds [kg/m³]."""
        return density * (1.0 + (self.moisture or 0.0))


def _equal(diameter: float) -> Sizes:
    return Sizes(law="mix", by="number", diameters=(diameter,), shares=(1.0,))
