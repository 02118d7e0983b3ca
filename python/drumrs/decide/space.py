"""`Space`: the keys that may vary, each within a range or among choices, and points in it as rows from 0 to 1."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs.config import Config
from drumrs.errors import ConfigError

Array = NDArray[np.float64]

MOST_KEYS = 6
# A range has at least so many steps, of 1, 0.1, 0.01 …: values read well, and so close is close enough.
_LEAST_STEPS = 500


@dataclass(frozen=True)
class Parameter:
    """A key that may vary.

    Attributes
    ----------
    key
        Dotted key of a case file.
    low, high
        Ends of its range; of choices, their first and last place.
    step
        What values are rounded to: 1 for whole numbers.
    choices
        The values, where it is one of a list.
    is_whole
        Whether values are whole numbers.
    """

    key: str
    low: float
    high: float
    step: float
    choices: tuple[Any, ...] = ()
    is_whole: bool = False

    @classmethod
    def within(cls, key: str, ends: Any) -> "Parameter":
        """Make a parameter of a range.

        Raises
        ------
        ConfigError
            Where the range is no pair of finite numbers, the lower one first.
        """
        from drumrs.sweep.columns import schema

        pair = list(ends) if isinstance(ends, (list, tuple)) else []
        numbers = [
            x for x in pair if isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x)
        ]
        if len(pair) != 2 or len(numbers) != 2 or not numbers[0] < numbers[1]:  # noqa: PLR2004
            hint = "values to choose from go into [axes]"
            raise ConfigError(f"ranges.{key}", ends, "[low, high], two numbers with low < high", hint=hint)
        is_whole = key in schema() and schema()[key].is_integer()
        step = 1.0 if is_whole else 10.0 ** math.floor(math.log10((pair[1] - pair[0]) / _LEAST_STEPS))
        return cls(key, float(pair[0]), float(pair[1]), step, is_whole=is_whole)

    @classmethod
    def among(cls, key: str, choices: Any) -> "Parameter":
        """Make a parameter of choices.

        Raises
        ------
        ConfigError
            Where there are fewer than two.
        """
        listed = tuple(choices) if isinstance(choices, (list, tuple)) else ()
        if len(listed) < 2:  # noqa: PLR2004
            raise ConfigError(f"axes.{key}", choices, "a list of at least two values to choose from")
        return cls(key, 0.0, len(listed) - 1.0, 1.0, listed)

    @property
    def is_ordered(self) -> bool:
        """Whether neighbors are alike: numbers are, other choices not."""
        return all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in self.choices)

    def value(self, place: float) -> Any:
        """Return the value at a place from 0 to 1, rounded."""
        steps = (self.high - self.low) * place / self.step
        if self.choices:
            return self.choices[round(steps)]
        rounded = round(self.low / self.step + steps) * self.step
        clipped = min(max(rounded, self.low), self.high)
        return round(clipped) if self.is_whole else float(f"{clipped:.10g}")

    def place(self, value: Any) -> float:
        """Return the place of a value, from 0 to 1."""
        found = self.choices.index(value) if self.choices else value
        return (found - self.low) / (self.high - self.low)


@dataclass(frozen=True)
class Space:
    """The keys that may vary together.

    Attributes
    ----------
    parameters
        One a key.

    Examples
    --------
    >>> from drumrs.decide.space import Space
    >>> space = Space.read({"rotation.rpm": [30, 60]}, {"drum.baffles.count": [3, 4, 6]})
    >>> space.values(space.spread(4)[1])
    {'rotation.rpm': 47.45, 'drum.baffles.count': 6}
    """

    parameters: tuple[Parameter, ...]

    @classmethod
    def read(
        cls, ranges: Mapping[str, Any], choices: Mapping[str, Any] | None = None, most: int = MOST_KEYS
    ) -> "Space":
        """Make a space of ranges, and of choices where there may be some, by dotted key; of at most so many keys.

        Raises
        ------
        ConfigError
            Where a range or a list of choices is not accepted, a key has both, or there are none or too many keys.
        """
        where = "keys with [low, high]" + ("" if choices is None else ", or in [axes] with choices")
        choices = choices or {}
        for key in ranges:
            if key in choices:
                raise ConfigError(key, problem="has a range and choices, but may have one of them only")
        found = [Parameter.within(key, ends) for key, ends in ranges.items()]
        found += [Parameter.among(key, listed) for key, listed in choices.items()]
        if not 1 <= len(found) <= most:
            raise ConfigError("ranges", [one.key for one in found], f"1 to {most} {where}", bound=most)
        return cls(tuple(found))

    def __len__(self) -> int:
        """Return the number of keys."""
        return len(self.parameters)

    @property
    def keys(self) -> list[str]:
        """The keys, in the order of the columns of points."""
        return [one.key for one in self.parameters]

    def spread(self, count: int, seed: int = 1) -> Array:
        """Return points spread evenly, rounded: a Sobol sequence, of which fewer are the first of more."""
        from scipy.stats import qmc

        return self.even(
            qmc.Sobol(len(self), rng=seed).random_base2(max(0, math.ceil(math.log2(count))))[:count]
        )

    def even(self, points: Array) -> Array:
        """Return points spread over 0 … 1 as points of this space: rounded, whole numbers and choices equally often."""
        points = points.copy()
        for column, one in enumerate(self.parameters):
            if one.is_whole or one.choices:
                # Whole numbers and choices all come equally often, those at the ends as well.
                steps = one.high - one.low
                points[:, column] = np.minimum(np.floor(points[:, column] * (steps + 1.0)), steps) / steps
        return self.rounded(points)

    def rounded(self, points: Array) -> Array:
        """Return the nearest points whose values are round, whole, or choices."""
        clipped = np.clip(points, 0.0, 1.0)
        for column, one in enumerate(self.parameters):
            width = one.high - one.low
            origin = one.low % one.step
            steps = np.rint((clipped[:, column] * width + origin) / one.step) * one.step - origin
            clipped[:, column] = np.clip(steps / width, 0.0, 1.0)
        return clipped

    def features(self, points: Array) -> Array:
        """Return what an emulator is told of points: the places, and of choices without order a 0 or 1 for each."""
        columns = []
        for column, one in enumerate(self.parameters):
            place = points[:, [column]]
            if one.choices and not one.is_ordered:
                columns.append(np.rint(place * one.high) == np.arange(len(one.choices)))
            elif one.choices:
                numbers = np.array(one.choices, float)
                scaled = (numbers - numbers.min()) / (np.ptp(numbers) or 1.0)
                columns.append(scaled[np.rint(place * one.high).astype(int)])
            else:
                columns.append(place)
        return np.hstack(columns).astype(float)

    @cached_property
    def feature_ranges(self) -> list[tuple[float, float]]:
        """Ends of each feature."""
        return [(0.0, 1.0)] * self.features(np.zeros((1, len(self)))).shape[1]

    def values(self, point: Array) -> dict[str, Any]:
        """Return the values of a point by key."""
        return {one.key: one.value(float(place)) for one, place in zip(self.parameters, point, strict=True)}

    def place(self, values: Mapping[str, Any]) -> Array:
        """Return the point with these values by key."""
        return np.array([one.place(values[one.key]) for one in self.parameters])

    def exact(self, points: Array) -> Array:
        """Return points exactly as their values give them: what is kept as values comes back the same, to the bit."""
        return np.array([self.place(self.values(point)) for point in points])

    def config(self, base: Config, point: Array) -> Config | None:
        """Return the configuration of a point, `None` where its values do not go together."""
        try:
            return base.replace(self.values(point))
        except ConfigError:
            return None

    def check(self, base: Config) -> None:
        """Refuse keys that a configuration does not have, and values that are not of their kind.

        Raises
        ------
        ConfigError
            The configuration's own sentence.
        """
        tried = self.spread(16)
        if not any(self.config(base, point) for point in tried):
            base.replace(self.values(tried[0]))
