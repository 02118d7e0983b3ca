"""The tables of contact laws: which law acts between bundles, between them and the drum, and between species."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from drumrs.config import types
from drumrs.config.config_table import ConfigTable, key
from drumrs.config.layers import merge
from drumrs.config.messages import both_given, conflict
from drumrs.config.types import Limit, NonNegative, Positive

Tension = Annotated[Literal["allowed", "clipped"], Limit("'allowed' or 'clipped'")]
Base = Annotated[Literal["linear", "hertz"], Limit("'linear' or 'hertz'")]


class LinearContact(ConfigTable):
    """A linear spring and dashpot with a tangential spring that Coulomb friction cuts off, and terms beside them."""

    choice: ClassVar[tuple[str, ...]] = ("restitution", "normal_damping")

    normal_stiffness: Positive = key(
        ..., "Stiffness of the normal spring; it does not count where contact.base is 'hertz'", "N/m"
    )
    stiffness_ratio: Positive = key(1.0, "Tangential stiffness over normal stiffness; likewise", "1")
    young_modulus: Positive | None = key(
        None, "Young's modulus of both bodies, where contact.base is 'hertz'", "Pa", 1e8
    )
    poisson_ratio: types.PoissonRatio = key(
        0.3, "Poisson's ratio of both bodies, where contact.base is 'hertz'", "1"
    )
    restitution: types.Restitution | None = key(
        None, "Coefficient of restitution; the damping follows from it", "1", 0.1
    )
    normal_damping: NonNegative | None = key(
        None, "Damping of the normal dashpot, instead of restitution", "N s/m", 5.35e3
    )
    friction: NonNegative = key(0.5, "Coefficient of friction", "1")
    tension: Tension = key("allowed", "Whether the dashpot may pull: 'allowed' (the paper) or 'clipped'")
    rolling_friction: NonNegative = key(
        0.0,
        "Coefficient of rolling friction μ_r: a rotational spring that yields where its moment is μ_r times "
        "normal force and radius; 0 for none",
        "1",
    )
    tangential_damping_ratio: NonNegative = key(
        0.0,
        "Damping ratio of a dashpot beside the tangential spring, which acts while the contact sticks; 0 for none",
        "1",
    )
    adhesion: NonNegative = key(
        0.0,
        "Constant pull while bodies touch, which friction and rolling feel as pressure; 0 for none",
        "N/m",
    )


class PartialContact(ConfigTable):
    """Those keys of a contact table that differ; the others are taken from elsewhere."""

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

    def given(self) -> dict[str, Any]:
        """Return the keys of a contact table that are set."""
        values = {key: getattr(self, key) for key in LinearContact.model_fields}
        return {key: value for key, value in values.items() if value is not None}

    def over(self, whole: LinearContact) -> LinearContact:
        """Return the whole table with these keys in place of its own."""
        return LinearContact.model_validate(merge(LinearContact, whole.model_dump(), self.given()))


class PairContact(PartialContact):
    """What acts between two species, or between a species and the drum."""

    between: types.TwoNames


class Contact(ConfigTable):
    """The contact laws: bundle against bundle, bundle against drum."""

    base: Base = key(
        "linear",
        "Base law of all contacts: 'linear', or 'hertz', Hertz–Mindlin in a layer one disc diameter thick",
    )
    bundle: LinearContact = Field(default=LinearContact(normal_stiffness=9.25e7, restitution=0.1))
    drum: LinearContact = Field(default=LinearContact(normal_stiffness=9.70e7, restitution=0.1))
    pair: Annotated[tuple[PairContact, ...], Limit("a list of tables with the key between")] | None = key(
        None,
        "What two species, or one and the drum, have in place of what follows from both (docs/how-to/loads.md)",
        example=[{"between": ["steel-ball", "drum"], "friction": 0.3}],
    )

    @model_validator(mode="after")
    def _pairs_are_different(self) -> Self:
        named = [sorted(law.between) for law in self.pair or ()]
        for index, names in enumerate(named):
            if names in named[:index]:
                limit = f"another than {{at}}pair[{named.index(names)}].between, which has its law already"
                raise conflict(f"{{at}}pair[{index}].between", names, limit)
        return self
