"""What the page says beside the drum: means since the last change, each with its error, as they build up."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis.blocks import Mean, rate_with_error
from drumrs.frames import SHAPED, Frames
from drumrs.registry import quantity
from drumrs.reports.content import value
from drumrs.result import Summary, with_error
from drumrs.studio.trades import Load, means_of
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
    trade
        Whose measures are wanted, a key of `TRADES`.
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
    trade: str
    series: "pl.DataFrame"
    frames: Frames | None
    window: tuple[float, float]
    summary: Summary | None

    @classmethod
    def of(cls, simulation: "Simulation", trade: str, recent: RecentFrames, since: float) -> "Sample":
        """Take the sample of the time from a start, or from the end of a change of speed, to now."""
        time = simulation.time
        window = (since + _SETTLING * (time - since), time)
        enough = window[1] - window[0] >= _FEWEST * simulation.config.run.sample_every
        summary = simulation.summary(window) if enough else None
        return cls(simulation.config, trade, simulation.series, recent.frames, window, summary)

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
        if self.frames is not None and len(inside := _within(self.frames, window)) >= _FEWEST:
            yield from means_of(self.trade, Load(self.config, inside)).items()


def _within(frames: Frames, window: tuple[float, float]) -> Frames:
    first, last = np.searchsorted(frames.times, window)
    return frames.picked(slice(int(first), int(last)))


def _tile(name: str, mean: Mean | None) -> dict[str, Any]:
    """Return a mean with what it is called and how it is written; angles are in degrees."""
    about = quantity(name)
    unit, factor = ("°", math.degrees(1.0)) if about.unit == "rad" else (about.unit, 1.0)
    number = factor * mean.value if mean and math.isfinite(mean.value) else None
    error = factor * mean.error if mean and mean.error else None
    return {
        "name": name,
        "value": number,
        # A small number with a large error is best told by the error's digits.
        "text": with_error(number, error)
        if number and error and abs(number) < 1.0
        else value(number, error, 3),
        "unit": "" if unit == "1" else unit,
        "meaning": about.meaning,
    }
