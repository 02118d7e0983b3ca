"""Which contact law acts between two species, and between each and the drum: given, or mixed from those of both."""

import difflib
import math
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import TYPE_CHECKING, Any

from drumrs.config.contact import LinearContact
from drumrs.config.layers import merge
from drumrs.config.messages import conflict
from drumrs.config.types import DRUM

if TYPE_CHECKING:
    from collections.abc import Mapping

    from drumrs.config.contact import Contact, PairContact
    from drumrs.config.load import Load

_MEANS = ("friction", "rolling_friction", "tangential_damping_ratio", "adhesion", "poisson_ratio")
# What a collision loses: a law has one of them.
_LOSSES = ("restitution", "normal_damping")


@dataclass(frozen=True)
class Law:
    """What acts between two kinds of bodies.

    Attributes
    ----------
    between
        Names of two species, the same twice for two bundles of one, or of a species and the drum.
    key
        What a user writes before its keys.
    table
        The law.
    """

    between: tuple[str, str]
    key: str
    table: LinearContact


def laws(load: "Load", contact: "Contact") -> list[Law]:
    """Return the laws of a load of species: of any two of them, then of each with the drum.

    What ``contact.pair`` does not say of two species is `mixed` from their own laws. The own law of a species is
    ``contact.bundle``, and with the drum ``contact.drum``, with the keys of its table ``contact`` in their places.

    Raises
    ------
    PydanticCustomError
        Where a pair names what is not there, or nothing says what a collision of two species loses.
    """
    _check_names(load.names, contact.pair or ())
    given = {frozenset(law.between): (f"contact.pair[{k}]", law) for k, law in enumerate(contact.pair or ())}

    def law(names: tuple[str, str], key: str, values: "Mapping[str, Any]") -> Law:
        if frozenset(names) in given:
            key, pair = given[frozenset(names)]
            values = merge(LinearContact, values, pair.given())
        if all(values.get(loss) is None for loss in _LOSSES):
            one, other = names
            limit = f"given: of {one} and {other} one has restitution, the other normal_damping"
            problem = f"is missing, but must be {limit}"
            hint = f'write [[contact.pair]] with between = ["{one}", "{other}"] and restitution'
            raise conflict(f"{key}.restitution", limit=limit, problem=problem, hint=hint)
        return Law(names, key, LinearContact.model_validate(values))

    def of_species(default: str, whole: LinearContact) -> list[tuple[str, str, LinearContact]]:
        """List the name of each species, the key of the law that it has, and the law."""
        return [
            (own.name, f"load.species[{k}].contact", own.contact.over(whole))
            if own.contact
            else (own.name, default, whole)
            for k, own in enumerate(load.species or ())
        ]

    pairs = []
    own = of_species("contact.bundle", contact.bundle)
    for (one, key, table), (other, _, second) in combinations_with_replacement(own, 2):
        of_both = key if table == second else f"contact.pair[{one}, {other}]"
        pairs.append(law((one, other), of_both, mixed(table, second)))
    walls = of_species("contact.drum", contact.drum)
    return [*pairs, *(law((name, DRUM), key, table.model_dump()) for name, key, table in walls)]


def mixed(one: LinearContact, other: LinearContact) -> dict[str, Any]:
    """Return the keys of the law between two species that have these laws among themselves.

    Springs act in series: a bundle brings half of the contact with its own kind, so stiffnesses k_a and k_b make
    2 k_a k_b/(k_a + k_b); tangential stiffness and Young's modulus likewise. Friction, restitution, adhesion, rolling
    friction, damping and Poisson's ratio are geometric means. The dashpot may pull where both allow it. Equal laws give
    the same law, to the bit. Where one has a restitution and the other a damping, the result has neither.

    Examples
    --------
    >>> from drumrs.config import LinearContact
    >>> from drumrs.config.laws import mixed
    >>> steel = LinearContact(normal_stiffness=9e7, restitution=0.9, friction=0.1)
    >>> ore = LinearContact(normal_stiffness=1e7, restitution=0.4, friction=0.4)
    >>> law = mixed(steel, ore)
    >>> f"{law['normal_stiffness']:.3g} N/m, e = {law['restitution']:.3g}, mu = {law['friction']:.3g}"
    '1.8e+07 N/m, e = 0.6, mu = 0.2'
    """
    if one == other:
        return one.model_dump()
    stiffness = _in_series(one.normal_stiffness, other.normal_stiffness)
    shear = [law.normal_stiffness * law.stiffness_ratio for law in (one, other)]
    same_ratio = one.stiffness_ratio == other.stiffness_ratio
    moduli = [law.young_modulus for law in (one, other) if law.young_modulus is not None]
    values: dict[str, Any] = {
        "normal_stiffness": stiffness,
        "stiffness_ratio": one.stiffness_ratio if same_ratio else _in_series(*shear) / stiffness,
        "young_modulus": _in_series(*moduli) if len(moduli) > 1 else None,
        "tension": "allowed" if one.tension == other.tension == "allowed" else "clipped",
    }
    for name in (*_MEANS, *_LOSSES):
        first, second = getattr(one, name), getattr(other, name)
        values[name] = None if first is None or second is None else _geometric_mean(first, second)
    return values


def _in_series(one: float, other: float) -> float:
    return one if one == other else 2.0 / (1.0 / one + 1.0 / other)


def _geometric_mean(one: float, other: float) -> float:
    return one if one == other else math.sqrt(one) * math.sqrt(other)


def _check_names(names: "tuple[str, ...]", pairs: "tuple[PairContact, ...]") -> None:
    for index, law in enumerate(pairs):
        strange = next((name for name in law.between if name not in {*names, DRUM}), None)
        key, known = f"contact.pair[{index}].between", ", ".join(names)
        if strange is not None or law.between == (DRUM, DRUM):
            limit = f"two names of load.species, or one and 'drum'{f'; there are {known}' if names else ''}"
            close = difflib.get_close_matches(strange or "", [*names, DRUM], n=1)
            hint = f"did you mean {close[0]!r}?" if close else ""
            raise conflict(key, list(law.between), limit, hint=hint)
