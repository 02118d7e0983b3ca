"""What the page says beside the drum: means since the last change, each with its error, as they build up."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drumrs.analysis.blocks import Mean, rate_with_error
from drumrs.errors import ConfigError
from drumrs.frames import SHAPED, Frames
from drumrs.measures import flight, mixed_in_a_turn
from drumrs.registry import quantity
from drumrs.result import with_error
from drumrs.viewer.curves import panels_of_series
from drumrs.viewer.recording import end_of_scale, packed_panel

if TYPE_CHECKING:
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


def measure(simulation: "Simulation", recent: RecentFrames, since: float) -> dict[str, Any]:
    """Return the tiles and curves of the page, ready for JSON.

    Parameters
    ----------
    simulation
        What is measured.
    recent
        Its latest frames.
    since
        Time of the start, or of the end of the last change of speed [s].
    """
    time, series = simulation.time, simulation.series
    window = (since + _SETTLING * (time - since), time)
    tiles = []
    if (window[1] - window[0]) >= _FEWEST * simulation.config.run.sample_every:
        tiles = [_tile(name, mean) for name, mean in _means(simulation, recent, window)]
    speeds = np.zeros(0) if recent.frames is None else recent.frames.speeds
    return {
        "window": list(window),
        "tiles": tiles,
        "panels": [packed_panel(panel) for panel in panels_of_series(series)],
        "speedScale": end_of_scale(speeds),
    }


def _means(
    simulation: "Simulation", recent: RecentFrames, window: tuple[float, float]
) -> Iterator[tuple[str, Mean | None]]:
    summary, series = simulation.summary(window), simulation.series
    yield "drum_power", rate_with_error(series, "drum_work", window)
    error = summary.drum_specific_power_error
    yield "drum_specific_power", Mean(summary.drum_specific_power, error)
    yield "energy_residual", Mean(summary.energy_residual, None)
    frames = recent.frames
    if frames is None:
        return
    seen = (max(window[0], float(frames.times[0])), window[1])
    try:
        flown, mixed = flight(frames, seen), mixed_in_a_turn(frames, seen)
    except ConfigError:
        # There are not two frames since the last change.
        return
    yield from ((name, flown[name]) for name in ("falls_per_turn", "mean_drop", "share_in_flight"))
    yield "mixed_in_a_turn", mixed


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
