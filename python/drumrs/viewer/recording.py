"""What the player reads: frames as base64 of little-endian arrays, and the curves that go beside them."""

import base64
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.frames import Frames, thinned
from drumrs.viewer.curves import Panel, panels_of_frames, panels_of_series

if TYPE_CHECKING:
    import polars as pl

_FULL = 65535
_TURN = 65536
# Bundles times frames in one page, at 8 bytes each before base64: beyond this, frames are left out.
MOST_PLACES = 2_000_000
# Speeds beyond this share of all are shown in the last color, so that the first fall does not use up the scale.
_TYPICAL = 0.998


def pack(
    frames: Frames,
    series: "pl.DataFrame | None",
    title: str,
    window: tuple[float, float] | None,
    facts: str = "",
) -> dict[str, Any]:
    """Return what a page holds of one run, ready for JSON.

    Positions, angles and speeds are whole numbers of 16 bits: 8 µm in a drum of half a meter.
    Compressing them would save an eighth, which the wait for it in the browser is not worth.

    Parameters
    ----------
    frames
        Frames of the run, at least one.
    series
        Table of the run, one row a sample; without it the curves come from the frames.
    title
        Written over the player.
    window
        Interval of the averages [s], shaded.
    facts
        A line below the title.
    """
    frames = _thinned(frames)
    reach = _reach(frames)
    fastest = float(frames.speeds.max(initial=0.0)) or 1.0
    panels = panels_of_frames(frames) if series is None else panels_of_series(series)
    return {
        "title": title,
        "facts": facts,
        "times": _base64(frames.times, "<f8"),
        "drum_angles": _base64(frames.drum_angles, "<f8"),
        "radii": _base64(frames.radii, "<f4"),
        "species": _species(frames),
        "positions": _base64(np.rint((frames.positions / reach + 1.0) / 2.0 * _FULL), "<u2"),
        "angles": _base64(np.rint(frames.angles / math.tau * _TURN) % _TURN, "<u2"),
        "speeds": _base64(np.rint(frames.speeds / fastest * _FULL), "<u2"),
        "reach": reach,
        "fastest": fastest,
        "speed_scale": _speed_scale(frames.speeds),
        "drum_radius": frames.drum_radius,
        "shell": None if frames.shell is None else frames.shell.tolist(),
        "baffles": [line.tolist() for line in frames.baffles],
        "walls": [line.tolist() for line in frames.walls],
        "window": list(window) if window is not None else None,
        "panels": [_panel(panel) for panel in panels],
    }


def _species(frames: Frames) -> dict[str, Any] | None:
    """Return the names of the species, and which of them each bundle is of."""
    if not frames.species:
        return None
    names, places = np.unique(frames.species, return_inverse=True)
    return {"names": names.tolist(), "of": _base64(places, "<u2")}


def _base64(values: NDArray[Any], kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def _panel(panel: Panel) -> Mapping[str, Any]:
    lines: Sequence[Mapping[str, Any]] = [
        {"name": line.name, "color": color, "values": _base64(line.values, "<f4")}
        for color, line in enumerate(panel.lines)
    ]
    return {
        "title": panel.title,
        "unit": panel.unit,
        "range": list(panel.limits),
        "logarithmic": panel.logarithmic,
        "times": _base64(panel.times, "<f4"),
        "lines": lines,
    }


def _thinned(frames: Frames) -> Frames:
    """Leave out frames, evenly, where there are more than a page can hold; the last one stays."""
    kept = thinned(len(frames), frames.count, MOST_PLACES)
    return frames if len(kept) == len(frames) else frames.picked(kept)


def _reach(frames: Frames) -> float:
    """Return the half width of a square about the axis that holds the drum and every bundle's center."""
    farthest = float(np.abs(frames.positions).max(initial=0.0))
    outlines = [float(np.abs(line).max(initial=0.0)) for line in frames.walls]
    if frames.reach is not None:
        return max(frames.reach, farthest)
    return max([farthest + float(frames.radii.max(initial=0.0)), *outlines]) or 1.0


def _speed_scale(speeds: NDArray[np.float32]) -> float:
    """Return the speed at the end of the scale [m/s], to two digits upwards."""
    typical = float(np.quantile(speeds, _TYPICAL)) if speeds.size else 0.0
    if typical <= 0.0:
        return 1.0
    unit = 10.0 ** (math.floor(math.log10(typical)) - 1)
    # A round speed is not to be raised by its last bit.
    return math.ceil(typical / unit - 1e-4) * unit
