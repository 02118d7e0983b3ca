"""In which regime a load moves, by numbers: slipping, slumping, rolling, cascading, cataracting, centrifuging.

The names are Mellmann's (Powder Technol. 118 (2001) 251); the numbers that decide are our own, with limits that can be
set, for everybody draws the borders elsewhere. So the numbers come with the name.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.analysis.blocks import Array
from drumrs.errors import ConfigError
from drumrs.measures.airborne import flights
from drumrs.measures.depth import surface_energy
from drumrs.measures.frame_window import counter_clockwise, within
from drumrs.measures.motion import carried_round, circulation, wall_slip
from drumrs.measures.surface import free_surface

if TYPE_CHECKING:
    from drumrs.analysis import Mean
    from drumrs.frames import Frames

_GRAVITY = 9.81


@dataclass(frozen=True)
class RegimeLimits:
    """Where one regime ends and the next begins.

    Attributes
    ----------
    centrifuging, partly_centrifuging
        Least ``carried_round``.
    cataracting
        Least share of mass and time in falls.
    slipping, still
        Least slip of the layer at the wall, and greatest circulation, of a load that slips.
    slumping, recurring
        Least standard deviation of the energy of the surface over its mean, and least correlation with itself after
        its period, of a load that slumps.
    cascading
        Least S-shape.
    """

    centrifuging: float = 0.9
    partly_centrifuging: float = 0.05
    cataracting: float = 0.05
    slipping: float = 0.5
    still: float = 0.1
    slumping: float = 0.5
    recurring: float = 0.3
    cascading: float = 0.05


@dataclass(frozen=True)
class Regime:
    """A regime, and the numbers that decide.

    Attributes
    ----------
    name
        "centrifuging", "partly centrifuging", "cataracting", "slipping", "slumping", "cascading" or "rolling": the
        first of them that holds.
    froude_number
        Ω² R/g, at the mean speed of the window.
    inner_froude_number
        Ω² R √(1 − J)/g with the filling seen: of the innermost layer, were all of the load at the rim; from 1 on the
        whole load may centrifuge.
    carried_round
        How often a bundle is carried over the top in a turn, see `carried_round`.
    share_in_falls
        Share of mass and time in falls, see `flights`.
    wall_slip
        Slip of the layer at the wall, see `wall_slip`.
    circulation
        How often a disc goes round the mean center of mass in a turn.
    unsteadiness, recurrence
        Standard deviation over mean of the energy of the surface layer relative to the drum; greatest correlation of
        that with itself at a later time.
    s_shape
        Greatest distance of the surface from its chord, over the chord.
    """

    name: str
    froude_number: float
    inner_froude_number: float
    carried_round: float
    share_in_falls: float
    wall_slip: float
    circulation: float
    unsteadiness: float
    recurrence: float
    s_shape: float


def regime(
    frames: "Frames",
    window: tuple[float, float],
    limits: RegimeLimits | None = None,
    gravity: float = _GRAVITY,
) -> Regime:
    """Return the regime in which a load moves.

    Parameters
    ----------
    frames
        Frames of a run in a drum with a rim, no further apart than a sixteenth of a turn.
    window
        Start and end [s]; a few turns.
    limits
        Where regimes end; those of `RegimeLimits` unless given.
    gravity
        Acceleration of gravity [m/s²].

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames, the drum has no rim, or does not turn.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import regime
    >>> config = drumrs.baseline().replace({"run.duration": 1.0, "run.frame_every": 0.02})
    >>> found = regime(drumrs.run(config, progress=False).frames, window=(0.5, 1.0))
    >>> round(found.froude_number, 2)
    0.77
    """
    limits = limits or RegimeLimits()
    seen = counter_clockwise(within(frames, window))
    span = float(seen.times[-1] - seen.times[0])
    turned = float(seen.drum_angles[-1] - seen.drum_angles[0])
    if turned == 0.0:
        raise ConfigError("window", window, "one in which the drum turns: at rest there is no regime")
    surface = free_surface(frames, window)
    shape = surface.shape()
    weights = seen.radii**2 / (seen.radii**2).sum()
    center = weights @ seen.positions.mean(axis=0, dtype=np.float64)
    falls = flights(frames, window, gravity).filter("is_fall")
    aloft = (falls["end"] - falls["start"]).to_numpy()
    energy = surface_energy(frames, window)
    froude = (turned / span) ** 2 * surface.drum_radius / gravity
    filling = 0.0 if math.isnan(shape["filling"]) else shape["filling"]
    numbers = {
        "carried_round": _value(carried_round(frames, window)),
        "share_in_falls": float(weights[falls["particle"].to_numpy()] @ aloft) / span,
        "wall_slip": _value(wall_slip(frames, window)),
        "circulation": _value(circulation(frames, window, center)),
        "unsteadiness": float(energy.std() / energy.mean()) if energy.any() else 0.0,
        "recurrence": _recurrence(energy),
        "s_shape": shape["s_shape"],
    }
    return Regime(
        name=_name(numbers, limits),
        froude_number=froude,
        inner_froude_number=froude * math.sqrt(max(1.0 - filling, 0.0)),
        **numbers,
    )


def _name(numbers: dict[str, float], limits: RegimeLimits) -> str:
    """Return the name of the first regime that holds; a number that is none decides nothing."""
    slips = numbers["wall_slip"] > limits.slipping and abs(numbers["circulation"]) < limits.still
    slumps = numbers["unsteadiness"] > limits.slumping and numbers["recurrence"] > limits.recurring
    holds = {
        "centrifuging": numbers["carried_round"] > limits.centrifuging,
        "partly centrifuging": numbers["carried_round"] > limits.partly_centrifuging,
        "cataracting": numbers["share_in_falls"] > limits.cataracting,
        "slipping": slips,
        "slumping": slumps,
        "cascading": numbers["s_shape"] > limits.cascading,
        "rolling": True,
    }
    return next(name for name, is_so in holds.items() if is_so)


def _value(mean: "Mean | None") -> float:
    return math.nan if mean is None else mean.value


def _recurrence(values: Array) -> float:
    """Return the greatest correlation of a signal with itself after it has gone through 0, within half its length."""
    apart = values - values.mean()
    if not apart.any():
        return 0.0
    count = len(apart)
    lags = np.correlate(apart, apart, "full")[count - 1 :] / np.arange(count, 0, -1)
    early = lags[: count // 2 + 1] / lags[0]
    below = np.flatnonzero(early < 0.0)
    return float(early[below[0] :].max()) if len(below) else 0.0
