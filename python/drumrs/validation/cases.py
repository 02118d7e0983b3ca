"""How published drums are set up: sizes and seeds of a study, stiffness by a stated rule, teeth, times in turns."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from drumrs.analysis import Estimate, combine

if TYPE_CHECKING:
    from drumrs.config import Config

GRAVITY = 9.81
# Share of a bed's area that discs cover, near that of random close packing in two dimensions.
BED = 0.84
# Greatest overlaps, over the radius: at the foot of a bed at rest, and in the hardest impact.
_AT_REST, _IN_IMPACT = 0.01, 0.05


@dataclass(frozen=True)
class Scale:
    """How large the study is.

    Attributes
    ----------
    seeds
        Seeds of the random starts.
    fineness
        What every D/d of the study is multiplied with.
    duration
        What every duration is multiplied with.
    """

    seeds: tuple[int, ...] = (1, 2, 3, 4)
    fineness: float = 1.0
    duration: float = 1.0

    @property
    def few(self) -> tuple[int, ...]:
        """Half of the seeds, for points that need fewer starts."""
        return self.seeds[: (len(self.seeds) + 1) // 2]


def stiffness(density: float, depth: float, fall: float = 0.0) -> float:
    """Return the normal stiffness with which discs overlap little, whatever their size [N/m].

    At the foot of a bed at rest, discs of diameter d carry p d each, p = ρ_b g h, and overlap by 2 p / k of their
    radius: 1 % at the most. Two discs that meet head-on with the speed of a fall, v² = 2 g H, overlap by v √(m*/k),
    with m* half of a disc's mass: by 5 % of the radius where k = π ρ g H / 0.05².

    Parameters
    ----------
    density
        Density of the discs [kg/m³].
    depth
        Depth h of the bed [m].
    fall
        Height H of the deepest fall [m].

    Examples
    --------
    >>> from drumrs.validation.cases import stiffness
    >>> round(stiffness(2500.0, 0.09)), round(stiffness(4000.0, 2.0, fall=2.5) / 1e8, 2)
    (370818, 1.23)
    """
    at_rest = 2.0 * density * BED * GRAVITY * depth / _AT_REST
    return max(at_rest, math.pi * density * GRAVITY * fall / _IN_IMPACT**2)


def contacts(stiff: float, friction: float, restitution: float) -> dict[str, float]:
    """Return the keys of contacts that are the same among bundles and with the drum."""
    values = {"normal_stiffness": stiff, "friction": friction, "restitution": restitution}
    return {f"contact.{side}.{key}": value for side in ("bundle", "drum") for key, value in values.items()}


def teeth(diameter: float, height: float) -> dict[str, Any]:
    """Return teeth of a rim, some four heights apart, that keep a bed of discs from slipping along it as a whole.

    Parameters
    ----------
    diameter
        Diameter of the drum [m].
    height
        Height of the teeth [m]: a diameter of the discs.
    """
    count = round(0.75 * diameter / height)
    return {"count": count, "shape": "triangle", "height": height, "base": 4.0 / 3.0 * height}


def turning(rpm: float, window: tuple[float, float], frames: int) -> dict[str, Any]:
    """Return the keys of a run of some turns.

    Parameters
    ----------
    rpm
        Speed of the drum.
    window
        Start and end of the averages, in turns; the run ends with them.
    frames
        Frames in a turn; 0 for none.
    """
    turn = 60.0 / rpm
    start, end = (turn * one for one in window)
    every = turn / frames if frames else end
    run = {"duration": end, "window": (start, end), "frame_every": every, "sample_every": turn / 200.0}
    return {"rotation.rpm": rpm, "gravity": (0.0, -GRAVITY), "run": {**run, "time_step": "auto"}}


def with_seeds(points: "Sequence[Config]", seeds: Sequence[int]) -> "list[Config]":
    """Return every configuration with every seed."""
    return [point.replace({"run.seed": seed}) for point in points for seed in seeds]


def times(estimate: Estimate, factor: float, less: float = 0.0) -> Estimate:
    """Return an estimate times a factor, less a number that is exact.

    Examples
    --------
    >>> from drumrs.analysis import Estimate
    >>> from drumrs.validation.cases import times
    >>> times(Estimate(0.4, 0.1, 8), 10.0, less=3.0)
    Estimate(mean=1.0, error=1.0, freedom=8)
    """
    return combine(factor * estimate.mean - less, [(factor, estimate)])
