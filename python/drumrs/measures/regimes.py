"""In which regime a load moves, by numbers: slipping, surging, slumping, rolling, cascading, cataracting, centrifuging.

The names are Mellmann's (Powder Technol. 118 (2001) 251); the numbers that decide are our own, with limits that can be
set, for everybody draws the borders elsewhere. So the numbers come with the name.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs.errors import ConfigError
from drumrs.measures.airborne import flights
from drumrs.measures.depth import surface_energy
from drumrs.measures.frame_window import counter_clockwise, within
from drumrs.measures.motion import carried_round, circulation, sticking, wall_slip
from drumrs.measures.surface import FreeSurface, free_surface

if TYPE_CHECKING:
    from drumrs.analysis import Mean
    from drumrs.frames import Frames

_GRAVITY = 9.81
# A disc is thrown where it falls by more than this, over the drum's radius, and lands with that share of the energy of
# its fall: on a bed that rolls, discs hop as well, between frames, and lose it on their way.
_THROW, _KEPT = 0.5, 0.5


@dataclass(frozen=True)
class RegimeLimits:
    """Where one regime ends and the next begins.

    Attributes
    ----------
    centrifuging, partly_centrifuging
        Least ``carried_round``.
    cataracting
        Least share of mass and time in throws.
    slipping, still
        Least slip of the layer at the wall, and greatest circulation, of a load that slips.
    surging
        Least share of the time in which the layer at the wall of a load that slips goes with the drum all the same.
    slumping
        Greatest steadiness of a load that slumps.
    cascading
        Least sag of the surface.
    """

    centrifuging: float = 0.9
    partly_centrifuging: float = 0.05
    cataracting: float = 0.025
    slipping: float = 0.5
    still: float = 0.1
    surging: float = 0.25
    slumping: float = 0.5
    cascading: float = 0.03


@dataclass(frozen=True)
class Regime:
    """A regime, and the numbers that decide.

    Attributes
    ----------
    name
        "centrifuging", "partly centrifuging", "cataracting", "surging", "slipping", "slumping", "cascading" or
        "rolling": the first of them that holds.
    froude_number
        Ω² R/g, at the mean speed of the window.
    inner_froude_number
        Ω² R √(1 − J)/g with the filling seen: of the innermost layer, were all of the load at the rim; from 1 on the
        whole load may centrifuge.
    carried_round
        How often a bundle is carried over the top in a turn, see `carried_round`.
    share_in_throws
        Share of mass and time in flights that drop by more than half of the drum's radius and land with half of the
        energy of that fall or more, see `flights`.
    wall_slip
        Slip of the layer at the wall, see `wall_slip`.
    sticking
        Share of the time in which that layer goes with the drum, see `sticking`.
    circulation
        How often a disc goes round the mean center of mass in a turn.
    steadiness
        Median over mean of the energy of the surface layer relative to the drum: about 1 where it flows all the time,
        small where it rests between avalanches.
    sag
        How far the surface, without its ends, hangs below its chord, over the chord: a kidney's shape.
    """

    name: str
    froude_number: float
    inner_froude_number: float
    carried_round: float
    share_in_throws: float
    wall_slip: float
    sticking: float
    circulation: float
    steadiness: float
    sag: float


def regime(
    frames: "Frames",
    window: tuple[float, float],
    limits: RegimeLimits | None = None,
    gravity: float = _GRAVITY,
    surface: FreeSurface | None = None,
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
    surface
        `free_surface` of the same frames and window, where it is known already.

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
    surface = surface or free_surface(frames, window)
    filling = surface.shape()["filling"]
    weights = seen.radii**2 / (seen.radii**2).sum()
    center = weights @ seen.positions.mean(axis=0, dtype=np.float64)
    found = flights(frames, window, gravity)
    falls_freely = found["speed"] ** 2 >= _KEPT * 2.0 * gravity * found["drop"]
    throws = found.filter((found["drop"] > _THROW * surface.drum_radius) & falls_freely)
    aloft = (throws["end"] - throws["start"]).to_numpy()
    energy = surface_energy(frames, window)
    froude = (turned / span) ** 2 * surface.drum_radius / gravity
    filling = 0.0 if math.isnan(filling) else filling
    numbers = {
        "carried_round": _value(carried_round(frames, window)),
        "share_in_throws": float(weights[throws["particle"].to_numpy()] @ aloft) / span,
        "wall_slip": _value(wall_slip(frames, window)),
        "sticking": _value(sticking(frames, window)),
        "circulation": _value(circulation(frames, window, center)),
        "steadiness": float(np.median(energy) / energy.mean()) if energy.any() else 1.0,
        "sag": surface.sag,
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
    holds = {
        "centrifuging": numbers["carried_round"] > limits.centrifuging,
        "partly centrifuging": numbers["carried_round"] > limits.partly_centrifuging,
        "cataracting": numbers["share_in_throws"] > limits.cataracting,
        "surging": slips and numbers["sticking"] > limits.surging,
        "slipping": slips,
        "slumping": numbers["steadiness"] < limits.slumping,
        "cascading": numbers["sag"] > limits.cascading,
        "rolling": True,
    }
    return next(name for name, is_so in holds.items() if is_so)


def _value(mean: "Mean | None") -> float:
    return math.nan if mean is None else mean.value
