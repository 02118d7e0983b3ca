"""How fast an index of mixing grows: the exponential curve that fits it best."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError


@dataclass(frozen=True)
class MixingRate:
    """M(n) = M∞ − (M∞ − M₀) exp(−k (n − τ)) after n turns, M₀ before τ.

    Attributes
    ----------
    start, end
        M₀ and M∞.
    rate
        k [per turn].
    delay
        τ [turns].
    """

    start: float
    end: float
    rate: float
    delay: float

    def at(self, turns: ArrayLike) -> Array:
        """Return M after some turns."""
        waited = np.maximum(np.asarray(turns, dtype=np.float64) - self.delay, 0.0)
        index: Array = self.end - (self.end - self.start) * np.exp(-self.rate * waited)
        return index


def mixing_rate(turns: ArrayLike, index: ArrayLike) -> MixingRate:
    """Return the curve M(n) = M∞ − (M∞ − M₀) exp(−k (n − τ)) that fits an index best, by least squares.

    Parameters
    ----------
    turns
        Turns of the drum, rising, shape (k,).
    index
        The index after these turns, shape (k,); its first value is M₀.

    Raises
    ------
    ConfigError
        Where there are fewer than four values.
    """
    from scipy.optimize import least_squares

    passed, values = np.asarray(turns, dtype=np.float64), np.asarray(index, dtype=np.float64)
    if len(passed) <= 3:  # noqa: PLR2004 - three numbers are fitted
        raise ConfigError("turns", passed.tolist(), "at least four, for three numbers are fitted")

    def curve(parameters: Array) -> MixingRate:
        return MixingRate(float(values[0]), *map(float, parameters))

    def misses(parameters: Array) -> Array:
        return curve(parameters).at(passed) - values

    span = float(passed[-1] - passed[0])
    fits = [
        least_squares(
            misses,
            [values[-1], rate / span, 0.0],
            bounds=([-np.inf, 0.0, 0.0], [np.inf, np.inf, span]),
            x_scale=[1.0, 1.0 / span, span],
        )
        # A fast curve and a slow one: from a wrong side the fit does not find home.
        for rate in (1.0, 10.0)
    ]
    return curve(min(fits, key=lambda fit: fit.cost).x)
