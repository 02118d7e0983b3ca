"""What the page says beside the drum: means since the last change, each with its error, as they build up."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis.blocks import Mean, rate_with_error
from drumrs.frames import SHAPED, Frames
from drumrs.measures import flight, mixed_in_a_turn
from drumrs.registry import quantity
from drumrs.result import Summary, with_error
from drumrs.viewer.curves import panels_of_series
from drumrs.viewer.recording import end_of_force_scale, end_of_scale, packed_panel

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config
    from drumrs.simulation import Simulation

# Frames kept for measures of motion: those of the last so many seconds, and no more bundles times frames than that.
_SECONDS = 20.0
_MOST_PLACES = 400_000
# The first part of the time since a change, while the load gets used to it, is not averaged over.
_SETTLING = 1.0 / 3.0
# Fewer samples tell nothing.
_FEWEST = 10
# Mixing follows neighbors from so many frames on, and from fewer where the load is large; none where it is very large.
_MOST_STARTS, _MOST_PAIRS = 120, 50_000_000


@dataclass
class RecentFrames:
    """The frames that a simulation has recorded lately; older ones are forgotten."""

    frames: Frames | None = None

    def take_from(self, simulation: "Simulation") -> None:
        """Take what was recorded since, out of the simulation's memory."""
        new = simulation.records.frames(keep=False)
        if not len(new):
            return
        known = new if self.frames is None else _joined(self.frames, new)
        most = max(_MOST_PLACES // known.count, 2)
        first = int(np.searchsorted(known.times, known.times[-1] - _SECONDS))
        self.frames = known.picked(slice(max(first, len(known) - most), None))


def _joined(one: Frames, other: Frames) -> Frames:
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(one, name), getattr(other, name)])
        for name in ("times", "drum_angles", *SHAPED)
    }
    return replace(one, **columns)


@dataclass(frozen=True)
class Sample:
    """What measures are made of: taken between two steps, and no longer part of the simulation.

    Attributes
    ----------
    config
        The configuration.
    series
        The series since the start.
    frames
        The latest frames, where there are any.
    window
        Interval of the means [s].
    summary
        Averages over it, where it holds enough samples for any.
    """

    config: "Config"
    series: "pl.DataFrame"
    frames: Frames | None
    window: tuple[float, float]
    summary: Summary | None

    @classmethod
    def of(cls, simulation: "Simulation", recent: RecentFrames, since: float) -> "Sample":
        """Take the sample of the time from a start, or from the end of a change of speed, to now."""
        time = simulation.time
        window = (since + _SETTLING * (time - since), time)
        enough = window[1] - window[0] >= _FEWEST * simulation.config.run.sample_every
        summary = simulation.summary(window) if enough else None
        return cls(simulation.config, simulation.series, recent.frames, window, summary)

    def measures(self) -> dict[str, Any]:
        """Return the tiles and curves of the page, ready for JSON."""
        speeds = np.zeros(0) if self.frames is None else self.frames.speeds
        return {
            "window": list(self.window),
            "tiles": [_tile(name, mean) for name, mean in self._means()],
            "panels": [packed_panel(panel) for panel in panels_of_series(self.series)],
            "speedScale": end_of_scale(speeds),
            "forceScale": None if self.frames is None else end_of_force_scale(self.config, self.frames),
        }

    def _means(self) -> Iterator[tuple[str, Mean | None]]:
        summary, window = self.summary, self.window
        if summary is None:
            return
        yield "drum_power", rate_with_error(self.series, "drum_work", window)
        yield (
            "drum_specific_power",
            Mean(summary.drum_specific_power, summary.drum_specific_power_error),
        )
        yield "energy_residual", Mean(summary.energy_residual, None)
        if self.frames is None or len(inside := _within(self.frames, window)) < _FEWEST:
            return
        seen = (float(inside.times[0]), float(inside.times[-1]))
        flown = flight(inside, seen)
        yield from ((name, flown[name]) for name in ("falls_per_turn", "mean_drop", "share_in_flight"))
        most = min(_MOST_STARTS, _MOST_PAIRS // inside.count**2)
        if most >= _FEWEST:
            few = inside.picked(slice(None, None, -(-len(inside) // most)))
            yield "mixed_in_a_turn", mixed_in_a_turn(few, (float(few.times[0]), float(few.times[-1])))


def _within(frames: Frames, window: tuple[float, float]) -> Frames:
    first, last = np.searchsorted(frames.times, window)
    return frames.picked(slice(int(first), int(last)))


def _tile(name: str, mean: Mean | None) -> dict[str, Any]:
    """Return a mean with what it is called and how it is written."""
    about = quantity(name)
    if mean is None:
        text = "–"
    elif name == "energy_residual":
        text = f"{mean.value:.1e}"
    else:
        text = with_error(mean.value, mean.error)
    value = None if mean is None else mean.value
    unit = "" if about.unit == "1" else about.unit
    return {"name": name, "value": value, "text": text, "unit": unit, "meaning": about.meaning}
