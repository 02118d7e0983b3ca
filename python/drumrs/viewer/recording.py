"""What the player reads: frames as base64 of little-endian arrays, and the curves that go beside them."""

import base64
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drumrs.frames import Frames, thinned
from drumrs.viewer.curves import Panel, panels_of_frames, panels_of_series
from drumrs.viewer.forces import ContactForces, contact_forces, greatest_stiffness, resolution

if TYPE_CHECKING:
    import polars as pl

    from drumrs.config import Config

_FULL = 65535
_TURN = 65536
# Bundles times frames in one page, at 6 bytes each before base64: beyond this, frames are left out.
MOST_PLACES = 2_000_000
# Speeds beyond this share of all are shown in the last color, so that the first fall does not use up the scale.
_TYPICAL = 0.998
# Likewise forces, among which those of impacts are rare and large.
_TYPICAL_FORCE = 0.98
# Contacts whose forces one page holds, at 5 bytes each before base64, or 9 for large loads: the strongest.
MOST_FORCES = 500_000
# Forces below this share of the typical greatest are not drawn.
_FAINT = 0.03
# Discs of frames whose contacts are looked for at once.
_AT_ONCE = 20_000
# Directions that a touch at the drum is told by.
_DIRECTIONS = 256


def pack(  # noqa: PLR0913, PLR0917 - what a page shows of a run
    frames: Frames,
    series: "pl.DataFrame | None",
    title: str,
    window: tuple[float, float] | None,
    facts: str = "",
    config: "Config | None" = None,
    discs: "pl.DataFrame | None" = None,
) -> dict[str, Any]:
    """Return what a page holds of one run, ready for JSON.

    Positions are whole numbers of 16 bits: 8 µm in a drum of half a meter. Angles, drawn as a line in each bundle, and
    speeds, drawn as colors, have 8. Compressing them would save an eighth, which the wait for it in the browser is not
    worth.

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
    config
        The configuration, whose contact laws give forces; without it there are none.
    discs
        What the discs received and how often they landed, ``result.discs``, for colors.
    """
    frames = _thinned(frames)
    reach = reach_of(frames)
    fastest = float(frames.speeds.max(initial=0.0)) or 1.0
    panels = panels_of_frames(frames) if series is None else panels_of_series(series)
    return {
        "title": title,
        "facts": facts,
        "times": _base64(frames.times, "<f8"),
        "drum_angles": _base64(frames.drum_angles, "<f8"),
        "radii": _base64(frames.radii, "<f4"),
        "species": _species(frames),
        "positions": _base64(of_places(frames.positions, reach), "<u2"),
        "angles": _base64(of_angles(frames.angles, "<u1")),
        "speeds": _base64(of_speeds(frames.speeds, fastest, "<u1")),
        "reach": reach,
        "fastest": fastest,
        "speed_scale": end_of_scale(frames.speeds),
        "forces": None if config is None else _forces(config, frames),
        "discs": None if discs is None else _discs(discs),
        "drum_radius": frames.drum_radius,
        "shell": None if frames.shell is None else frames.shell.tolist(),
        "baffles": [line.tolist() for line in frames.drawn_baffles],
        "walls": [line.tolist() for line in frames.walls],
        "window": list(window) if window is not None else None,
        "panels": [packed_panel(panel) for panel in panels],
    }


def of_places(positions: NDArray[Any], reach: float) -> NDArray[Any]:
    """Return coordinates as shares of a square about the axis, from 0 to 65535; its half width is `reach` [m]."""
    shares = np.rint((positions / reach + 1.0) / 2.0 * _FULL)
    return np.clip(shares, 0, _FULL).astype("<u2")


def of_angles(angles: NDArray[Any], kind: str = "<u2") -> NDArray[Any]:
    """Return angles [rad] in whole numbers of a kind, whose range is a turn."""
    turn = np.iinfo(kind).max + 1
    return (np.rint(angles / math.tau * turn) % turn).astype(kind)


def of_speeds(speeds: NDArray[Any], fastest: float, kind: str = "<u2") -> NDArray[Any]:
    """Return speeds as shares of the fastest [m/s], in whole numbers of a kind."""
    return np.rint(speeds / fastest * np.iinfo(kind).max).astype(kind)


def _species(frames: Frames) -> dict[str, Any] | None:
    """Return the names of the species, and which of them each bundle is of."""
    if not frames.species:
        return None
    names, indices = np.unique(frames.species, return_inverse=True)
    return {"names": names.tolist(), "of": _base64(indices, "<u2")}


def _base64(values: NDArray[Any], kind: str | None = None) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def packed_panel(panel: Panel) -> Mapping[str, Any]:
    """Return curves ready for JSON, as `unpackPanel` of recording.js reads them."""
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


def reach_of(frames: Frames) -> float:
    """Return the half width of a square about the axis that holds the drum and every bundle's center."""
    farthest = float(np.abs(frames.positions).max(initial=0.0))
    outlines = [float(np.abs(line).max(initial=0.0)) for line in frames.walls]
    if frames.reach is not None:
        return max(frames.reach, farthest)
    return max([farthest + float(frames.radii.max(initial=0.0)), *outlines]) or 1.0


def end_of_scale(values: NDArray[Any], share: float = _TYPICAL) -> float:
    """Return what a share of the values stays below, to two digits upwards."""
    typical = float(np.quantile(values, share)) if values.size else 0.0
    if typical <= 0.0:
        return 1.0
    unit = 10.0 ** (math.floor(math.log10(typical)) - 1)
    # A round number is not to be raised by its last bit.
    return math.ceil(typical / unit - 1e-4) * unit


def _discs(discs: "pl.DataFrame") -> dict[str, str]:
    """Return the energy that each disc received in the whole run, and how often it landed."""
    received = discs.select("received_normal", "received_tangential", "received_rolling").sum_horizontal()
    landings = discs.select("drum_landings", "load_landings").sum_horizontal()
    return {"received": _base64(received.to_numpy(), "<f4"), "landings": _base64(landings.to_numpy(), "<f4")}


def _forces(config: "Config", frames: Frames) -> dict[str, Any]:
    """Return the forces at the contacts of all frames, as shares of the end of their scale."""
    frame, one, other, force = forces_of(config, frames)
    scale, least = force_limits(config, frames, force)
    kept = force >= least
    return {
        "scale": scale,
        "least": least,
        "counts": _base64(np.bincount(frame[kept], minlength=len(frames)), "<u4"),
        "one": _base64(of_numbers(one[kept], frames.count)),
        "other": _base64(of_numbers(other[kept], frames.count)),
        "shares": _base64(of_forces(force[kept], scale)),
    }


def forces_of(config: "Config", frames: Frames) -> tuple[NDArray[Any], ...]:
    """Return the contacts of all frames as arrays: frame, two numbers, force [N/m].

    The second number, from the number of discs on, is a direction to the drum: one of 256 in a turn.
    """
    every = max(1, _AT_ONCE // frames.count)
    chunks = [
        _one_list(contact_forces(config, frames.picked(slice(first, first + every))), first, frames.count)
        for first in range(0, len(frames), every)
    ]
    return tuple(np.concatenate(parts) for parts in zip(*chunks, strict=True))


def end_of_force_scale(config: "Config", frames: Frames) -> float:
    """Return the end of the scale of forces [N/m] from some of the frames, so few that it takes milliseconds."""
    few = frames.picked(thinned(len(frames), frames.count, _AT_ONCE))
    return force_limits(config, few, forces_of(config, few)[-1])[0]


def force_limits(
    config: "Config", frames: Frames, force: NDArray[Any], end: float | None = None
) -> tuple[float, float]:
    """Return the end of the scale of forces, unless it is given, and the least force that is shown [N/m]."""
    scale = end_of_scale(force, _TYPICAL_FORCE) if end is None else end
    least = max(_FAINT * scale, greatest_stiffness(config) * resolution(frames))
    if len(force) > MOST_FORCES:
        least = max(least, float(np.quantile(force, 1.0 - MOST_FORCES / len(force))))
    return scale, least


def of_numbers(numbers: NDArray[Any], count: int) -> NDArray[Any]:
    """Return numbers of discs and of directions in 16 bits, or in 32 where there are too many discs."""
    return numbers.astype("<u2" if count + _DIRECTIONS <= _TURN else "<u4")


def of_forces(force: NDArray[Any], end: float) -> NDArray[Any]:
    """Return forces as shares of the end of their scale, from 0 to 255."""
    return np.rint(255.0 * np.minimum(force / end, 1.0)).astype("<u1")


def _one_list(found: ContactForces, first: int, count: int) -> tuple[NDArray[Any], ...]:
    """Return frame, two numbers and force of contacts, those at the drum among them, frame by frame."""
    directions = count + np.rint(found.directions / math.tau * _DIRECTIONS).astype(int) % _DIRECTIONS
    frame = np.concatenate([found.frame, found.drum_frame])
    order = np.argsort(frame, kind="stable")
    one, other = np.concatenate([found.discs, np.column_stack([found.at_drum, directions])])[order].T
    return first + frame[order], one, other, np.concatenate([found.forces, found.drum_forces])[order]
