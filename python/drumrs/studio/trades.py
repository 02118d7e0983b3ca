"""What each trade wants to know of a load while it turns: the measures of its page that take milliseconds."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drumrs import measures
from drumrs.analysis.blocks import Mean, mean_with_error
from drumrs.errors import ConfigError
from drumrs.measures.airborne import in_flight

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.frames import Frames

_FLIGHT = ("falls_per_turn", "mean_drop", "share_in_flight")
_LANDING = ("landing_on_drum", "head_height", "impact_toe_angle")
_GOING = ("along_the_rim", "carried_round")
_LAYER = ("center_slope", "bed_depth", "layer_thickness", "surface_velocity_ratio")
_SHAPE = ("toe_angle", "shoulder_angle", "filling")

# Names of the registry, in the order of the tiles.
TRADES: Mapping[str, tuple[str, ...]] = {
    "washer": (*_FLIGHT, "wall_slip", *_GOING, "eccentricity", "mixed_in_a_turn"),
    "dryer": ("openness", "curtain", *_FLIGHT, *_GOING, "mixed_in_a_turn"),
    "mill": (*_SHAPE, "mean_drop", "share_in_flight", *_LANDING),
    "coater": ("mixed_in_a_turn", *_LAYER, "wall_slip", "share_in_flight"),
}

# Frames that are plenty where one takes long: for shapes and surfaces, and to follow neighbors from.
_FEW, _MOST_STARTS = 24, 120
# Pairs of bundles that are looked at, over all those frames; where there would be more, there is no such tile.
_MOST_PAIRS = 50_000_000
# Fewer frames tell nothing.
_FEWEST = 10


@dataclass(frozen=True, eq=False)
class Load:
    """A load in the frames of a window.

    Attributes
    ----------
    config
        The configuration.
    frames
        The frames, two at least.
    """

    config: "Config"
    frames: "Frames"

    @property
    def window(self) -> tuple[float, float]:
        """Times of the first and the last frame [s]."""
        return float(self.frames.times[0]), float(self.frames.times[-1])

    @property
    def gravity(self) -> float:
        """Gravity in the plane [m/s²]."""
        return math.hypot(*self.config.plane_gravity)

    def thinned(self, most: int) -> "Load":
        """Return it in no more frames than so many."""
        every = -(-len(self.frames) // most)
        return Load(self.config, self.frames.picked(slice(None, None, every)))


def means_of(trade: str, load: Load) -> dict[str, Mean | None]:
    """Return the measures of a trade, in its order; `None` where there is nothing to be measured.

    Raises
    ------
    KeyError
        Where there is no such trade.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.studio.trades import Load, means_of
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    >>> simulation.run(duration=0.5)
    >>> list(means_of("dryer", Load(simulation.config, simulation.frames)))[:2]
    ['openness', 'curtain']
    """
    wanted = TRADES[trade]
    found: dict[str, Mean | None] = {}
    for names, measure in _FAMILIES:
        if not names.isdisjoint(wanted):
            # What a load at rest has no measure of is not a number, and no cause for a warning.
            with np.errstate(invalid="ignore", divide="ignore"):
                try:
                    found |= measure(load)
                except ConfigError:
                    # The drum has no rim or turned to and fro: a page of a report would say so.
                    found |= dict.fromkeys(names)
    return {name: found[name] for name in wanted if name in found}


Found = Mapping[str, Mean | None]


def _flight_of(load: Load) -> Found:
    masses = measures.disc_masses(load.config, load.frames)
    return measures.flight(load.frames, load.window, masses, load.gravity)


def _going_along(load: Load) -> Found:
    of = load.frames, load.window
    return {
        "wall_slip": measures.wall_slip(*of),
        "along_the_rim": measures.along_the_rim(*of),
        "carried_round": measures.carried_round(*of),
    }


def _balance(load: Load) -> Found:
    return measures.unbalance(load.frames, load.window, measures.disc_masses(load.config, load.frames))


def _openness(load: Load) -> Found:
    few = load.thinned(_FEW).frames
    if len(few) * few.count**2 > _MOST_PAIRS:
        return {}
    reach = few.reach or load.config.drum.area_diameter / 2.0
    shares = [measures.openness(places, few.radii, reach / 2.0) for places in few.positions]
    return {"openness": mean_with_error(shares, float(np.diff(few.times).mean()))}


def _curtain(load: Load) -> Found:
    frames = load.frames
    reach = frames.reach or load.config.drum.area_diameter / 2.0
    flies = in_flight(frames, load.gravity)
    shares = [
        measures.curtain(places[aloft], frames.radii[aloft], reach)
        for places, aloft in zip(frames.positions, flies, strict=True)
    ]
    return {"curtain": mean_with_error(shares, float(np.diff(frames.times).mean()))}


def _shape_of(load: Load) -> Found:
    few = load.thinned(_FEW)
    return measures.charge(few.frames, few.window)


def _layer_of(load: Load) -> Found:
    return measures.flowing_layer(load.frames, load.window)


def _mixing(load: Load) -> Found:
    most = min(_MOST_STARTS, _MOST_PAIRS // load.frames.count**2)
    if most < _FEWEST:
        return {}
    few = load.thinned(most)
    return {"mixed_in_a_turn": measures.mixed_in_a_turn(few.frames, few.window)}


_FAMILIES: tuple[tuple[frozenset[str], Callable[[Load], Found]], ...] = (
    (frozenset({*_FLIGHT, *_LANDING}), _flight_of),
    (frozenset({"wall_slip", *_GOING}), _going_along),
    (frozenset({"eccentricity"}), _balance),
    (frozenset({"openness"}), _openness),
    (frozenset({"curtain"}), _curtain),
    (frozenset(_SHAPE), _shape_of),
    (frozenset(_LAYER), _layer_of),
    (frozenset({"mixed_in_a_turn"}), _mixing),
)
