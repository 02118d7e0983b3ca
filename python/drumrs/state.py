"""`State`: a given start, instead of a random packing."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.errors import ConfigError

_PAIRS_OF_NUMBERS = {"positions", "velocities"}


@dataclass(frozen=True, eq=False)
class State:
    """Where the bundles are and how they move; what is not given is 0, or the configuration's radius.

    Attributes
    ----------
    positions
        Centers [m], shape (n, 2). Their number takes the place of ``load.count``.
    velocities
        Velocities [m/s], shape (n, 2).
    angles, angular_velocities
        Angles [rad] and spins [rad/s], counter-clockwise, shape (n,).
    radii
        Radii [m], shape (n,).
    """

    positions: ArrayLike
    velocities: ArrayLike | None = None
    angles: ArrayLike | None = None
    angular_velocities: ArrayLike | None = None
    radii: ArrayLike | None = None

    def arrays(self) -> dict[str, NDArray[np.float64]]:
        """Return the given arrays as the core reads them.

        Raises
        ------
        ConfigError
            Where an array has another shape or holds something but numbers.
        """
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        arrays = {name: _floats(name, value) for name, value in given.items() if value is not None}
        count = len(arrays["positions"]) if arrays["positions"].ndim else 0
        for name, array in arrays.items():
            pairs = name in _PAIRS_OF_NUMBERS
            if array.shape != ((count, 2) if pairs else (count,)) or not count:
                wanted = f"{'(n, 2)' if pairs else '(n,)'} with n = {count or 'at least 1'}"
                raise ConfigError(f"state.{name} is of shape {array.shape}, but must be of shape {wanted}")
        return arrays


def _floats(name: str, value: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.ascontiguousarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ConfigError(f"state.{name} is {value!r:.60}, but must be an array of numbers") from None
