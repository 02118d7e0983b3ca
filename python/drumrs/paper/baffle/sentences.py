"""What the paper says of its baffles, sentence by sentence, as numbers with tolerances.

Curves were compared by eye, so powers are over the largest value that their figure shows, that of the bare drum. On
that scale "similar" is a tenth; "nearly constant" and "approximately" a twentieth of the value named; "smaller",
"decreases" and "maximum" a fiftieth, for points of one curve or of two that lie beside each other. Shares and indices
of motion, which the authors saw in pictures, are known to a tenth; "appear similar" is vaguer, a quarter.
"""

from functools import partial
from typing import Any

import numpy as np

from drumrs.paper.baffle.evidence import Array, Means, Observable, Part, Sentence

POWER, RATIO = "drum_specific_power", "gross_work_ratio"
ALONG, CARRIED, MIXED = "along_the_rim", "carried_round", "mixed_in_a_turn"
CIRCULATION = "specific_angular_momentum"
# Fills at which power and N/T are read, those at which the motion is looked at, and D/d of Figure 7 with its fill. The
# smaller bundles at its end, D/d = 37, would cost six times as much as Table 1's.
FILLS = (0.15, 0.25, 0.35, 0.45, 0.50, 0.55, 0.65, 0.75)
WATCHED_FILLS = (0.25, 0.50, 0.75)
SIZES = (10.0, 20.0, 25.0)
SIZE_FILL = 0.40
_SMALL, _BELOW_60, _LARGE = FILLS[:3], (0.15, 0.25, 0.35, 0.45, 0.55), FILLS[5:]

_SIMILAR, _NEAR, _BESIDE, _SEEN, _ALIKE = 0.10, 0.05, 0.02, 0.10, 0.25
# The value that the text gives N/T with baffles, and what "just less than one" and "just greater than two" leave open.
_RATIO = 2.2
_LOWEST_RATIO, _HIGHEST_RATIO = 0.9, 2.3
# "Most of the cycle", "similar to centrifuging": half of the time at least, and half of the load over the top.
_MOST = 0.5
# "By approximately the same amount": the bare drum's 20 %.
_SIZE_CHANGE = 0.2

_at_least = partial(Part, at_least=True)


def _percent(fill: float) -> str:
    return f"{100.0 * fill:.4g} %"


def _own(quantity: str, fill: float) -> Observable:
    return Observable(quantity, fill)


def _bare(quantity: str, fill: float) -> Observable:
    return Observable(quantity, fill, baffles=False)


# Where the figures of drum power and of specific power have their largest values. Drum power is fill times specific
# power, but for a factor that cancels.
_PEAK, _LEAST = 0.45, FILLS[0]


def _power_peaks(fill: float, other: float) -> Part:
    def value(here: Array, there: Array, highest: Array) -> Any:
        return (fill * here - other * there) / (_PEAK * highest)

    of = (_own(POWER, fill), _own(POWER, other), _bare(POWER, _PEAK))
    return _at_least(f"power at {_percent(fill)} less that at {_percent(other)}", of, value, _BESIDE, 0.0)


def _power_below_bare(fill: float) -> tuple[str, tuple[Observable, ...], Any]:
    def value(bare: Array, own: Array, highest: Array) -> Any:
        return fill * (bare - own) / (_PEAK * highest)

    of = (_bare(POWER, fill), _own(POWER, fill), _bare(POWER, _PEAK))
    return f"power at {_percent(fill)}, bare less own", of, value


def _specific_power_falls(fill: float, later: float) -> Part:
    def value(here: Array, there: Array, highest: Array) -> Any:
        return (here - there) / highest

    of = (_own(POWER, fill), _own(POWER, later), _bare(POWER, _LEAST))
    name = f"specific power at {_percent(fill)} less that at {_percent(later)}"
    return _at_least(name, of, value, _BESIDE, 0.0)


def _ratio(fill: float) -> tuple[str, tuple[Observable, ...], Any]:
    return f"N/T at {_percent(fill)}", (_own(RATIO, fill),), np.positive


def _ratio_falls(fill: float, later: float) -> Part:
    name = f"N/T at {_percent(fill)} less that at {_percent(later)}"
    return _at_least(name, (_own(RATIO, fill), _own(RATIO, later)), np.subtract, _BESIDE * _RATIO, 0.0)


def _ratio_above_bare(fill: float) -> tuple[str, tuple[Observable, ...], Any]:
    return f"N/T at {_percent(fill)}, less bare", (_own(RATIO, fill), _bare(RATIO, fill)), np.subtract


def _moves_like_bare(fill: float) -> tuple[Part, ...]:
    at = _percent(fill)
    kinds = {
        CARRIED: f"share carried over the top at {at}, less bare",
        MIXED: f"mixing in a turn at {at}, less bare",
    }
    shares = [
        Part(name, (_own(kind, fill), _bare(kind, fill)), np.subtract, _SEEN, 0.0)
        for kind, name in kinds.items()
    ]
    turning = (_own(CIRCULATION, fill), _bare(CIRCULATION, fill))
    return (Part(f"angular momentum at {at}, over bare", turning, np.divide, _SEEN, 1.0), *shares)


def _spread(*powers: Array) -> Any:
    return np.ptp(np.stack(powers), axis=0) / np.mean(powers, axis=0)


SENTENCES = (
    Sentence(
        "power peaks between 40 and 50 %",
        "A maximum in the power occurs at a fill percentage between 40% and 50% for both cases.",
        # A parabola through 35, 45 and 55 % has its vertex between 40 and 50 % where the middle is highest.
        (_power_peaks(0.45, 0.35), _power_peaks(0.45, 0.55)),
    ),
    Sentence(
        "less power than bare at small fills",
        "At smaller fill percentages the with-baffle case has a smaller drum power.",
        tuple(_at_least(*_power_below_bare(fill), _BESIDE, 0.0) for fill in _SMALL),
    ),
    Sentence(
        "similar power at larger fills",
        "The with-baffle and without-baffle cases have similar drum powers at the larger fill percentages. […] Drum "
        "baffles have only a minor effect on the power dissipation and kinematics for fill percentages greater than "
        "50%.",
        tuple(Part(*_power_below_bare(fill), _SIMILAR, 0.0) for fill in _LARGE),
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
        tuple(Part(*_ratio(fill), _NEAR * _RATIO, _RATIO) for fill in _BELOW_60),
    ),
    Sentence(
        "N/T falls from 60 % on",
        "For larger fill percentages the ratio decreases monotonically.",
        (_ratio_falls(0.55, 0.65), _ratio_falls(0.65, 0.75)),
    ),
    Sentence(
        "N/T from just below 1 to just above 2",
        "The ratio ranges between just less than one to just greater than two.",
        (
            *(
                _at_least(f"−{name}", of, np.negative, _NEAR * _RATIO, -_HIGHEST_RATIO)
                for name, of, _ in map(_ratio, _BELOW_60)
            ),
            *(_at_least(*_ratio(fill), _NEAR * _RATIO, _LOWEST_RATIO) for fill in _LARGE),
        ),
    ),
    Sentence(
        "N/T above bare at small fills",
        "The normal-to-tangential power ratio for the with-baffle case at small fill percentages is expected to be "
        "larger than the corresponding without-baffle case.",
        tuple(_at_least(*_ratio_above_bare(fill), _BESIDE * _RATIO, 0.0) for fill in _SMALL),
    ),
    Sentence(
        "N/T like bare at larger fills",
        "For larger values of the fill percentage the without-baffle case is similar to the with baffle case.",
        tuple(Part(*_ratio_above_bare(fill), _SIMILAR * _RATIO, 0.0) for fill in _LARGE),
    ),
    Sentence(
        "against the rim most of the cycle at 25 %",
        "At this fill percentage, the baffles carry bundles against the drum circumference for most of the drum "
        "rotation cycle […]",
        (_at_least("share of the time along the rim", (_own(ALONG, 0.25),), np.positive, _SEEN, _MOST),),
    ),
    Sentence(
        "as if centrifuging at 25 %",
        "[…] giving trajectories that appear similar to what would be expected if the drum speed was sufficient to "
        "cause centrifuging.",
        (_at_least("share carried over the top", (_own(CARRIED, 0.25),), np.positive, _ALIKE, _MOST),),
    ),
    Sentence(
        "less mixing than bare at 25 %",
        "Less bundle mixing occurs for the 25% with-baffle case compared to the 25% without-baffle case.",
        (
            _at_least(
                "mixing in a turn, bare less own",
                (_bare(MIXED, 0.25), _own(MIXED, 0.25)),
                np.subtract,
                _SEEN,
                0.0,
            ),
        ),
    ),
    Sentence(
        "moves like bare at 50 and 75 %",
        "The bundle load kinematics for the with-baffle cases are nearly the same as the without-baffle cases for the "
        "50% and 75% fill percentages.",
        (*_moves_like_bare(0.50), *_moves_like_bare(0.75)),
    ),
    Sentence(
        "changes with D/d by about 20 %",
        "The specific drum power for the with-baffles case changes by approximately the same amount [20%] over the "
        "same range of D/d.",
        (
            Part(
                "greatest less least specific power over the mean",
                tuple(Observable(POWER, SIZE_FILL, size) for size in SIZES),
                _spread,
                _SEEN,
                _SIZE_CHANGE,
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
            _at_least(
                f"N/T at {_percent(fill)}, bare less own",
                (_bare(RATIO, fill), _own(RATIO, fill)),
                np.subtract,
                _BESIDE * _RATIO,
                0.0,
            )
            for fill in _SMALL
        ),
    ),
    Sentence(
        "specific power greatest near 50 %",
        "However, a maximum occurs at a fill percentage near 50% [said of specific power over D/d].",
        (_specific_power_falls(0.50, 0.25), _specific_power_falls(0.50, 0.75)),
    ),
)
# Everything that a sentence is about.
OBSERVABLES = tuple(
    sorted({one for sentence in (*SENTENCES, *UNWEIGHTED) for part in sentence.parts for one in part.of})
)


def log_likelihood(known: Means, factor: float = 1.0) -> Array:
    """Return the logarithm of the likelihood of all sentences, shape by shape.

    Parameters
    ----------
    known
        Means and errors of all observables.
    factor
        Multiplies all tolerances.
    """
    logarithms = [one.log_likelihood(known, factor) for one in SENTENCES]
    total: Array = np.sum(np.broadcast_arrays(*logarithms), axis=0)
    return total
