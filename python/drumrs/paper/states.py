"""What happens at 50 % fill: a load that circulates, and a ring that the drum carries round; how long either lasts.

The two differ in the angular momentum of the load. Over M Ω R² it is 1 for bundles that ride on the rim; seen from one
turn to the next it keeps to one of two levels, that of a load below half full, which circulates, and that of one above,
which rides round as a ring about the axis. Near half full a load passes from one to the other and back.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.analysis import Estimate
from drumrs.paper.cases import HALF_FULL, percent
from drumrs.paper.data import StudyData
from drumrs.paper.verdict import MissingError

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Shorter runs tell nothing of how long a state lasts [s].
_LONG = 60.0
# Before that a load still falls and gathers [s].
_SETTLED = 5.0
# Of the way from the level of the circulating load to that of the ring: above the upper a load has become a ring,
# below the lower it circulates again; in between it stays what it was.
_LOWER, _UPPER = 1.0 / 3.0, 2.0 / 3.0
# Fewest runs from whose differences an error is taken.
_FEWEST = 2


@dataclass(frozen=True)
class Turning:
    """How a load turns with the drum: one run, from when it has settled.

    Attributes
    ----------
    times
        Time [s], shape (n,).
    momentum
        Angular momentum over M Ω R², mean over a turn about each time, shape (n,).
    work, normal, tangential
        Work of the drum over the mass of the load [J/kg], and gross work along normals and tangents [J/m], shape (n,).
    """

    times: Array
    momentum: Array
    work: Array
    normal: Array
    tangential: Array

    @classmethod
    def of(cls, series: "pl.DataFrame", config: "Config") -> "Turning":
        """Take what a run has recorded, gross work among it.

        Raises
        ------
        MissingError
            Where the run is too short to tell how long a state lasts.
        """
        if config.run.duration < _LONG:
            raise MissingError(f"runs of {_LONG:g} s and more at {percent(config.fill)} fill")
        derived, radius = config.derived, config.drum.diameter / 2.0
        speed = abs(derived.angular_velocity or 1.0)
        times = series["time"].to_numpy()
        steps = round(2.0 * np.pi / speed / float(times[1] - times[0]))
        first = int(np.searchsorted(times, _SETTLED))
        scale = derived.load_mass * speed * radius**2
        whole = np.convolve(series["angular_momentum"].to_numpy(), np.ones(steps) / steps, "valid") / scale
        # The mean over a turn belongs to its middle.
        rows = slice(first, first + len(whole[first:]))
        middle = slice(rows.start + steps // 2, rows.stop + steps // 2)
        columns = {name: series[name].to_numpy()[middle] for name in series.columns}
        return cls(
            columns["time"],
            whole[rows],
            columns["drum_work"] / derived.load_mass,
            columns["gross_work_normal"],
            columns["gross_work_tangential"],
        )


def is_ring(momentum: Array, circulating: float, ring: float) -> Flags:
    """Tell where a load is a ring: from where its angular momentum comes near that of one to where it leaves it.

    Parameters
    ----------
    momentum
        Angular momentum of the load, shape (n,).
    circulating, ring
        Its levels in the two states. A load becomes a ring two thirds of the way up from the one to the other, and
        circulates again a third of the way up; in between it stays what it was. It begins as what is nearer.

    Returns
    -------
    numpy.ndarray
        Shape (n,).

    Examples
    --------
    >>> import numpy as np
    >>> from drumrs.paper.states import is_ring
    >>> is_ring(np.array([0.3, 0.5, 0.4, 0.3]), circulating=0.3, ring=0.5)
    array([False,  True,  True, False])
    """
    way = (momentum - circulating) / (ring - circulating)
    turns = np.where(way > _UPPER, 1, np.where(way < _LOWER, -1, 0))
    turns[0] = turns[0] or (1 if way[0] > (_LOWER + _UPPER) / 2.0 else -1)
    last = np.maximum.accumulate(np.where(turns != 0, np.arange(len(turns)), 0))
    flags: Flags = turns[last] > 0
    return flags


@dataclass(frozen=True)
class State:
    """A state of the load at one fill.

    Attributes
    ----------
    time
        How long the runs were in it, together [s].
    passages
        How often they left it.
    power
        Specific power of the drum while in it [W/kg].
    ratio
        N/T by gross work while in it.
    """

    time: float
    passages: int
    power: Estimate
    ratio: Estimate

    @property
    def residence(self) -> float | None:
        """How long the load stays in it on average [s], of runs that end in it as well: time over passages.

        `None` where no run left it.
        """
        return self.time / self.passages if self.passages else None


@dataclass(frozen=True)
class TwoStates:
    """The load at one fill: its runs, and what it does in each of its states.

    Attributes
    ----------
    fill
        The fill.
    runs
        Its runs, by seed.
    rings
        Where each of them is a ring.
    circulating, ring
        The states; `None` for one that no run was in.
    """

    fill: float
    runs: tuple[Turning, ...]
    rings: tuple[Flags, ...]
    circulating: State | None
    ring: State | None

    @property
    def share(self) -> float:
        """The share of the time that the load is a ring."""
        return float(np.concatenate(self.rings).mean())


@lru_cache(maxsize=1)
def two_states(data: StudyData) -> list[TwoStates]:
    """Return what the bare drum's load does at the fills about 50 %.

    The levels of the two states are the means at the least and at the greatest of these fills.

    Raises
    ------
    MissingError
        Where runs at these fills are missing, or too short.
    """
    runs = [
        [Turning.of(data.sweep.series(case, data.folder), case.config) for case in data.cases(fill)]
        for fill in HALF_FULL
    ]
    low, high = (
        float(np.concatenate([run.momentum for run in found]).mean()) for found in (runs[0], runs[-1])
    )
    return [of_runs(fill, found, low, high) for fill, found in zip(HALF_FULL, runs, strict=True)]


def of_runs(fill: float, runs: Sequence[Turning], circulating: float, ring: float) -> TwoStates:
    """Return what runs at a fill do in each state, whose levels of the angular momentum are given."""
    rings = tuple(is_ring(run.momentum, circulating, ring) for run in runs)
    states = (_state(runs, [flags == value for flags in rings]) for value in (False, True))
    return TwoStates(fill, tuple(runs), rings, *states)


def _state(runs: Sequence[Turning], inside: Sequence[Flags]) -> State | None:
    """Add up what happened in the intervals of which both ends are inside."""
    sums = []
    passages = 0
    for run, flags in zip(runs, inside, strict=True):
        both = flags[:-1] & flags[1:]
        passages += int((flags[:-1] & ~flags[1:]).sum())
        columns = (run.times, run.work, run.normal, run.tangential)
        sums.append([float(np.diff(column)[both].sum()) for column in columns])
    times, work, normal, tangential = np.array(sums).T
    if times.sum() == 0.0:
        return None
    return State(float(times.sum()), passages, _ratio(work, times), _ratio(normal, tangential))


def _ratio(above: Array, below: Array) -> Estimate:
    """Return the ratio of sums over runs; its error is that of the jackknife over those that add to it."""
    above, below = above[below > 0.0], below[below > 0.0]
    mean, count = float(above.sum() / below.sum()), len(below)
    if count < _FEWEST:
        return Estimate(mean, np.inf, 1)
    without = (above.sum() - above) / (below.sum() - below)
    error = float(np.sqrt((count - 1) / count * ((without - without.mean()) ** 2).sum()))
    return Estimate(mean, error, count - 1)
