"""The cases by family, in the order in which they are shown, and how to choose among them."""

from collections.abc import Sequence
from types import MappingProxyType

from drumrs import ConfigError
from drumrs.verification import (
    adhesion,
    balance,
    balances,
    bodies,
    charge,
    contact_tables,
    fields,
    flight,
    friction,
    hertz,
    impacts,
    laundry,
    mixing,
    promises,
    regimes,
    rolling,
    rotation,
    sliding,
    sticking,
    stress,
    zones,
)
from drumrs.verification.case import Case

FAMILIES = MappingProxyType(
    {
        "Impacts of one contact": impacts.CASES + sliding.CASES,
        "The eight impact tests of Chung & Ooi": bodies.CASES,
        "Friction and rolling": friction.CASES,
        "In a turning drum": rotation.CASES,
        "Rolling resistance": rolling.CASES,
        "Tangential dashpot": sticking.CASES,
        "Adhesion": adhesion.CASES,
        "Hertz–Mindlin": hertz.CASES,
        "Balances of a whole drum": balances.CASES,
        "Promises": promises.CASES,
        "Measures: shape of the charge": charge.CASES,
        "Measures: mixing": mixing.CASES,
        "Measures: fields": fields.CASES + stress.CASES,
        "Measures: unbalance, flight and visits": balance.CASES + flight.CASES + zones.CASES,
        "Measures: collisions and walls": contact_tables.CASES,
        "Measures: washing, and torque over frequency": laundry.CASES,
        "Measures: the regime": regimes.CASES,
    }
)


def family_of(case: Case) -> str:
    """Return the family that a case belongs to."""
    return next(name for name, cases in FAMILIES.items() if case in cases)


def chosen(only: Sequence[str] | None = None) -> tuple[Case, ...]:
    """Return the cases of some names, in the catalog's order; all of them without any.

    Raises
    ------
    ConfigError
        Where a name is none of a case, or there is none.
    """
    cases = tuple(case for family in FAMILIES.values() for case in family)
    if only is None:
        return cases
    names = [case.name for case in cases]
    for name in only:
        if name not in names:
            raise ConfigError("only", name, f"one of {', '.join(names)}")
    if not only:
        raise ConfigError("only", only, "a list of at least one name")
    return tuple(case for case in cases if case.name in only)
