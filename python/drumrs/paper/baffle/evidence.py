"""What the paper says of its baffles, sentence by sentence, as residuals with tolerances.

A sentence has parts, each a number made of what is observed in our runs. "Equals": it should be a target, give or take
the tolerance. "At least": it should not be below a limit; the tolerance is what an eye tells apart on the figure. A
tolerance is one standard deviation.

Curves were compared by eye, so powers are over the largest value that their figure shows, that of the bare drum. On
that scale "similar" is a tenth; "nearly constant" and "approximately" a twentieth of the value named; "smaller",
"decreases" and "maximum" a fiftieth, for points of one curve or of two that lie beside each other. Shares and indices
of motion, which the authors saw in pictures, are known to a tenth; "appear similar" is vaguer, a quarter.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

POWER, RATIO = "drum_specific_power", "gross_work_ratio"
ALONG, CARRIED, MIXED, CIRCULATION = (
    "along_the_rim",
    "carried_round",
    "mixed_in_a_turn",
    "specific_angular_momentum",
)
# Fills at which power and N/T are read, those at which the motion is looked at; D/d of Table 1, and Figure 7's with its
# fill; the smaller bundles of its end, D/d = 37, cost six times as much.
FILLS = (0.15, 0.25, 0.35, 0.45, 0.50, 0.55, 0.65, 0.75)
WATCHED_FILLS = (0.25, 0.50, 0.75)
TABLE_1 = 20.0
SIZES = (10.0, 20.0, 25.0)
SIZE_FILL = 0.40
_SMALL, _LARGE = (0.15, 0.25, 0.35), (0.55, 0.65, 0.75)

_SIMILAR, _NEAR, _BESIDE, _SEEN, _ALIKE = 0.10, 0.05, 0.02, 0.10, 0.25
# The value that the text gives N/T with baffles, and what "just less than one" and "just greater than two" leave open.
_RATIO = 2.2
_LOWEST_RATIO, _HIGHEST_RATIO = 0.9, 2.3
# "Most of the cycle", "similar to centrifuging": half of the time at least, and half of the load over the top.
_MOST = 0.5
# "By approximately the same amount": the bare drum's 20 %.
_SIZE_CHANGE = 0.2


class Observable(NamedTuple):
    """A mean of our runs: which quantity, at which fill and D/d, with baffles or without."""

    quantity: str
    fill: float
    size: float = TABLE_1
    baffles: bool = True


Known = Mapping[Observable, tuple[Array, Array]]
"""Means and their errors, each an array over shapes, or one number for the bare drum."""


@dataclass(frozen=True)
class Part:
    """One number of a sentence.

    Attributes
    ----------
    name
        What it is, in words.
    of
        What it is made of.
    value
        Function of the means of `of`.
    tolerance
        Standard deviation of the reading, in the unit of the value.
    expected
        What it should equal, or be at least.
    at_least
        Whether more is as good.
    """

    name: str
    of: tuple[Observable, ...]
    value: Callable[..., Any]
    tolerance: float
    expected: float
    at_least: bool = False

    def estimate(self, known: Known) -> tuple[Array, Array]:
        """Return the number and its standard error, from independent errors of what it is made of."""
        means, errors = zip(*(known[one] for one in self.of), strict=True)
        center = np.asarray(self.value(*means))
        steps = [
            np.asarray(self.value(*means[:k], means[k] + errors[k], *means[k + 1 :])) - center
            for k in range(len(means))
        ]
        return center, np.sqrt(sum(step**2 for step in steps))

    def residual(self, known: Known) -> tuple[Array, Array]:
        """Return the number less what is expected over the tolerance, and its standard error."""
        value, error = self.estimate(known)
        return (value - self.expected) / self.tolerance, error / self.tolerance

    def log_likelihood(self, known: Known, factor: float = 1.0) -> Array:
        """Return the logarithm of the likelihood, with the tolerance times a factor."""
        from scipy import special

        residual, error = self.residual(known)
        scatter = np.sqrt(factor**2 + error**2)
        if self.at_least:
            below: Array = special.log_ndtr(residual / scatter)
            return below
        gauss: Array = -0.5 * (residual / scatter) ** 2 - np.log(scatter / factor)
        return gauss


@dataclass(frozen=True)
class Sentence:
    """A sentence of the paper, which counts once: by the part that fits it worst.

    Attributes
    ----------
    name
        What it says, in a few words.
    quote
        What the paper says.
    parts
        Its numbers.
    """

    name: str
    quote: str
    parts: tuple[Part, ...]

    def log_likelihood(self, known: Known, factor: float = 1.0) -> Array:
        """Return the logarithm of the likelihood, with all tolerances times a factor."""
        parts = [part.log_likelihood(known, factor) for part in self.parts]
        worst: Array = np.min(np.broadcast_arrays(*parts), axis=0)
        return worst

    def worst(self, known: Known) -> tuple[Part, float]:
        """Return the part that fits worst, and its residual, where each mean is one number."""
        part = min(self.parts, key=lambda part: float(np.max(part.log_likelihood(known))))
        return part, float(np.max(part.residual(known)[0]))


def _percent(fill: float) -> str:
    return f"{100.0 * fill:.4g} %"


def _bare(quantity: str, fill: float) -> Observable:
    return Observable(quantity, fill, baffles=False)


# Drum power is fill times specific power, but for a factor that figures do not show.
_HIGHEST_POWER = _bare(POWER, 0.45)
_HIGHEST_SPECIFIC = _bare(POWER, 0.15)


def _power_above(fill: float, other: float) -> Part:
    def value(here: Array, there: Array, highest: Array) -> Array:
        return (fill * here - other * there) / (0.45 * highest)

    name = f"power at {_percent(fill)} less that at {_percent(other)}"
    return Part(
        name,
        (Observable(POWER, fill), Observable(POWER, other), _HIGHEST_POWER),
        value,
        _BESIDE,
        expected=0.0,
        at_least=True,
    )


def _power_below_bare(fill: float, tolerance: float, **expected: Any) -> Part:
    def value(bare: Array, own: Array, highest: Array) -> Array:
        return fill * (bare - own) / (0.45 * highest)

    of = (_bare(POWER, fill), Observable(POWER, fill), _HIGHEST_POWER)
    return Part(f"bare less own power at {_percent(fill)}", of, value, tolerance, **expected)


def _specific_power_falls(fill: float, later: float) -> Part:
    of = (Observable(POWER, fill), Observable(POWER, later), _HIGHEST_SPECIFIC)
    name = f"specific power at {_percent(fill)} less that at {_percent(later)}"
    return Part(
        name, of, lambda here, there, highest: (here - there) / highest, _BESIDE, expected=0.0, at_least=True
    )


def _ratio(fill: float, tolerance: float, sign: int = 1, **expected: Any) -> Part:
    name = f"{'−' if sign < 0 else ''}N/T at {_percent(fill)}"
    return Part(name, (Observable(RATIO, fill),), lambda own: sign * own, tolerance, **expected)


def _difference(name: str, first: Observable, second: Observable, tolerance: float, **expected: Any) -> Part:
    return Part(name, (first, second), np.subtract, tolerance, **expected)


def _like_bare(quantity: str, words: str, fill: float) -> Part:
    own, bare = Observable(quantity, fill), _bare(quantity, fill)
    return _difference(f"{words} at {_percent(fill)}, less bare", own, bare, _SEEN, expected=0.0)


def _circulates_like_bare(fill: float) -> Part:
    own, bare = Observable(CIRCULATION, fill), _bare(CIRCULATION, fill)
    name = f"angular momentum over bare at {_percent(fill)}"
    return Part(name, (own, bare), np.divide, _SEEN, expected=1.0)


def _spread_over_sizes(*powers: Array) -> Array:
    stacked = np.stack(powers)
    spread: Array = np.ptp(stacked, axis=0) / stacked.mean(axis=0)
    return spread


_about = partial(_ratio, tolerance=_NEAR * _RATIO)
SENTENCES = (
    Sentence(
        "power peaks between 40 and 50 %",
        "A maximum in the power occurs at a fill percentage between 40% and 50% for both cases.",
        # A parabola through 35, 45 and 55 % has its vertex between 40 and 50 % where the middle is highest.
        (_power_above(0.45, 0.35), _power_above(0.45, 0.55)),
    ),
    Sentence(
        "less power than bare at small fills",
        "At smaller fill percentages the with-baffle case has a smaller drum power.",
        tuple(_power_below_bare(fill, _BESIDE, expected=0.0, at_least=True) for fill in _SMALL),
    ),
    Sentence(
        "similar power at larger fills",
        "The with-baffle and without-baffle cases have similar drum powers at the larger fill percentages. Drum "
        "baffles have only a minor effect on the power dissipation and kinematics for fill percentages greater than 50%.",
        tuple(_power_below_bare(fill, _SIMILAR, expected=0.0) for fill in _LARGE),
    ),
    Sentence(
        "specific power falls with fill",
        "The specific power decreases with increasing fill percentage.",
        tuple(
            _specific_power_falls(*pair)
            for pair in ((0.15, 0.25), (0.25, 0.35), (0.35, 0.45), (0.45, 0.55), (0.55, 0.65), (0.65, 0.75))
        ),
    ),
    Sentence(
        "N/T about 2.2 below 60 %",
        "The simulations including baffles give a nearly constant ratio of approximately 2.2 for fill percentages less "
        "than 60%.",
        tuple(_about(fill, expected=_RATIO) for fill in (0.15, 0.25, 0.35, 0.45, 0.55)),
    ),
    Sentence(
        "N/T falls from 60 % on",
        "For larger fill percentages the ratio decreases monotonically.",
        tuple(
            _difference(
                f"N/T at {_percent(fill)} less that at {_percent(later)}",
                Observable(RATIO, fill),
                Observable(RATIO, later),
                _BESIDE * _RATIO,
                expected=0.0,
                at_least=True,
            )
            for fill, later in ((0.55, 0.65), (0.65, 0.75))
        ),
    ),
    Sentence(
        "N/T from just below 1 to just above 2",
        "The ratio ranges between just less than one to just greater than two.",
        (
            *(
                _about(fill, sign=-1, expected=-_HIGHEST_RATIO, at_least=True)
                for fill in (0.15, 0.25, 0.35, 0.45, 0.55)
            ),
            *(_about(fill, expected=_LOWEST_RATIO, at_least=True) for fill in (0.65, 0.75)),
        ),
    ),
    Sentence(
        "N/T above bare at small fills",
        "The normal-to-tangential power ratio for the with-baffle case at small fill percentages is expected to be "
        "larger than the corresponding without-baffle case.",
        tuple(
            _difference(
                f"N/T at {_percent(fill)}, less bare",
                Observable(RATIO, fill),
                _bare(RATIO, fill),
                _BESIDE * _RATIO,
                expected=0.0,
                at_least=True,
            )
            for fill in _SMALL
        ),
    ),
    Sentence(
        "N/T like bare at larger fills",
        "For larger values of the fill percentage the without-baffle case is similar to the with baffle case.",
        tuple(
            _difference(
                f"N/T at {_percent(fill)}, less bare",
                Observable(RATIO, fill),
                _bare(RATIO, fill),
                _SIMILAR * _RATIO,
                expected=0.0,
            )
            for fill in _LARGE
        ),
    ),
    Sentence(
        "against the rim most of the cycle at 25 %",
        "At this fill percentage, the baffles carry bundles against the drum circumference for most of the drum "
        "rotation cycle.",
        (
            Part(
                "share of the time along the rim",
                (Observable(ALONG, 0.25),),
                np.positive,
                _SEEN,
                expected=_MOST,
                at_least=True,
            ),
        ),
    ),
    Sentence(
        "as if centrifuging at 25 %",
        "Giving trajectories that appear similar to what would be expected if the drum speed was sufficient to cause "
        "centrifuging.",
        (
            Part(
                "share carried over the top",
                (Observable(CARRIED, 0.25),),
                np.positive,
                _ALIKE,
                expected=_MOST,
                at_least=True,
            ),
        ),
    ),
    Sentence(
        "less mixing than bare at 25 %",
        "Less bundle mixing occurs for the 25% with-baffle case compared to the 25% without-baffle case.",
        (
            _difference(
                "mixing in a turn, bare less own",
                _bare(MIXED, 0.25),
                Observable(MIXED, 0.25),
                _SEEN,
                expected=0.0,
                at_least=True,
            ),
        ),
    ),
    Sentence(
        "moves like bare at 50 and 75 %",
        "The bundle load kinematics for the with-baffle cases are nearly the same as the without-baffle cases for the "
        "50% and 75% fill percentages.",
        tuple(
            part
            for fill in (0.50, 0.75)
            for part in (
                _circulates_like_bare(fill),
                _like_bare(CARRIED, "share carried over the top", fill),
                _like_bare(MIXED, "mixing in a turn", fill),
            )
        ),
    ),
    Sentence(
        "changes with D/d by about 20 %",
        "The specific drum power for the with-baffles case changes by approximately the same amount [20%] over the "
        "same range of D/d.",
        (
            Part(
                "greatest less least specific power over the mean",
                tuple(Observable(POWER, SIZE_FILL, size) for size in SIZES),
                _spread_over_sizes,
                _SEEN,
                expected=_SIZE_CHANGE,
            ),
        ),
    ),
)
# Sentences that contradict the others or themselves: shown, not weighed.
UNWEIGHTED = (
    Sentence(
        "N/T below bare at small fills",
        "Baffles decrease the specific power and normal-to-tangential power ratio at small fill percentages.",
        tuple(
            _difference(
                f"N/T at {_percent(fill)}, bare less own",
                _bare(RATIO, fill),
                Observable(RATIO, fill),
                _BESIDE * _RATIO,
                expected=0.0,
                at_least=True,
            )
            for fill in _SMALL
        ),
    ),
    Sentence(
        "specific power greatest near 50 %",
        "However, a maximum occurs at a fill percentage near 50% [said of specific power over D/d].",
        tuple(
            Part(
                f"specific power at 50 % less that at {_percent(fill)}",
                (Observable(POWER, 0.50), Observable(POWER, fill), _HIGHEST_SPECIFIC),
                lambda here, there, highest: (here - there) / highest,
                _BESIDE,
                expected=0.0,
                at_least=True,
            )
            for fill in (0.25, 0.75)
        ),
    ),
)
# Everything that a sentence is about.
OBSERVABLES = tuple(
    sorted(
        {one for sentence in (*SENTENCES, *UNWEIGHTED) for part in sentence.parts for one in part.of},
    )
)


def log_likelihood(known: Known, factor: float = 1.0, without: Sentence | None = None) -> Array:
    """Return the logarithm of the likelihood of all sentences, shape by shape.

    Parameters
    ----------
    known
        Means and errors of all observables.
    factor
        Multiplies all tolerances.
    without
        A sentence that is left out.
    """
    total: Array = np.sum(
        [one.log_likelihood(known, factor) for one in SENTENCES if one is not without], axis=0
    )
    return total
