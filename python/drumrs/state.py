"""`State`: a given initial state, instead of a random packing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.config.derived import GREATEST_SPECIES
from drumrs.errors import ConfigError

_FLOATS = ("positions", "velocities", "angles", "angular_velocities", "radii")
_PAIRS_OF_NUMBERS = {"positions", "velocities"}
# The arrays of a table of contacts, as the core's `ContactRecord` has them.
_CONTACT: dict[str, type] = {
    "particle": np.uint32,
    "other": np.uint32,
    "overlap": np.float64,
    "separation_rate": np.float64,
    "force": np.float64,
    "moments": np.float64,
    "history": np.float64,
}


@dataclass(frozen=True, eq=False)
class State:
    """Initial positions and velocities of the bundles; what is not given is 0, or the configuration's radius.

    Attributes
    ----------
    positions
        Centers [m], shape (n, 2). Their number takes the place of ``load.count``.
    velocities
        Velocities [m/s], shape (n, 2).
    angles, angular_velocities
        Angles [rad] and spins [rad/s], counter-clockwise, shape (n,).
    radii
        Radii [m], shape (n,); those of ``load.diameter`` or of the species unless given.
    species
        Names of ``load.species``, or their places in that list, from 0, shape (n,).
    drum_angle
        Angle of the drum at t = 0 [rad].
    contacts
        The contacts with their histories, as `Simulation.state` has them: tables "pairs" and "walls" of arrays, in
        the order in which the contacts opened. A contact whose bodies do not overlap by its overlap is left out.

    Notes
    -----
    Bodies may overlap at the start by at most 10 % of the smaller radius, by more where their contact is in `contacts`.
    """

    positions: ArrayLike
    velocities: ArrayLike | None = None
    angles: ArrayLike | None = None
    angular_velocities: ArrayLike | None = None
    radii: ArrayLike | None = None
    species: ArrayLike | None = None
    drum_angle: float = 0.0
    contacts: Mapping[str, Mapping[str, ArrayLike]] | None = None

    def arrays(self, names: Sequence[str] = ()) -> dict[str, Any]:
        """Return the fields that are given, as the core reads them.

        Parameters
        ----------
        names
            Names of the configuration's species.

        Raises
        ------
        ConfigError
            Where an array has another shape or does not hold numbers.
        """
        given = {name: getattr(self, name) for name in (*_FLOATS, "species")}
        arrays = {
            name: _floats(f"state.{name}", value) if name != "species" else _species(value, names)
            for name, value in given.items()
            if value is not None
        }
        count = len(arrays["positions"]) if arrays["positions"].ndim else 0
        for name, array in arrays.items():
            pairs = name in _PAIRS_OF_NUMBERS
            if array.shape != ((count, 2) if pairs else (count,)) or not count:
                length = "" if name == "positions" else f" with n = {count}"
                limit = f"of shape {'(n, 2)' if pairs else '(n,)'}{length or ', n at least 1'}"
                problem = f"is of shape {array.shape}, but must be {limit}"
                raise ConfigError(f"state.{name}", array.shape, limit, problem=problem)
        fields: dict[str, Any] = {**arrays, "drum_angle": _angle(self.drum_angle)}
        return fields if self.contacts is None else {**fields, "contacts": _contacts(self.contacts)}


def _species(value: ArrayLike, names: Sequence[str]) -> NDArray[np.uint16]:
    given = np.asarray(value)
    if given.dtype.kind in "OU":
        named = given.ravel().tolist()
        strange = next((k for k, name in enumerate(named) if name not in names), None)
        if strange is not None:
            limit = (
                f"a name of load.species: {', '.join(names)}"
                if names
                else "a name of load.species, which has none"
            )
            raise ConfigError(f"state.species[{strange}]", named[strange], limit)
        value = np.reshape([names.index(name) for name in named], given.shape)
    whole = _floats("state.species", value)
    if not ((whole >= 0) & (whole < GREATEST_SPECIES) & (whole == np.floor(whole))).all():
        limit = f"of whole numbers from 0 to {GREATEST_SPECIES - 1}"
        raise ConfigError("state.species", whole.tolist(), limit)
    return whole.astype(np.uint16)


def _floats(key: str, value: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.ascontiguousarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ConfigError(key, value, "an array of numbers") from None


def _angle(value: float) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ConfigError("state.drum_angle", value, "a number") from None


def _contacts(contacts: Mapping[str, Mapping[str, ArrayLike]]) -> dict[str, dict[str, NDArray[Any]]]:
    try:
        return {
            kind: {name: np.ascontiguousarray(contacts[kind][name], kept) for name, kept in _CONTACT.items()}
            for kind in ("pairs", "walls")
        }
    except (TypeError, ValueError, KeyError, IndexError, OverflowError):
        raise ConfigError("state.contacts", contacts, "the contacts of a simulation's state") from None
