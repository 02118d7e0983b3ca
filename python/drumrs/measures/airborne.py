"""Flight, fall and landing of the discs, from frames that count contacts.

A disc flies while it is without contact for longer than ½ √(2 d/g), half the time of a fall by its diameter d: in a
bed that is stirred, most discs touch nothing for shorter times. Frames do not show a knock between them, but what it
does to the velocity: a flight goes on from a frame to the next where the velocity has changed as gravity alone changes
it. Without that a disc that is knocked about, and in two frames happens to touch nothing, would count as flying.
Places are those of frames, so a flight is known to the way between two of them: ten frames in a flight do, and one that
is seen in a single frame is not counted. Angles are those of a drum that turns counter-clockwise, or of the mirror
image.
"""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.analysis.blocks import Array, Mean, mean_with_error, ratio_of_sums
from drumrs.measures.clearance import distance_to_solids
from drumrs.measures.frame_window import counter_clockwise, turn_back, with_errors, within

if TYPE_CHECKING:
    import polars as pl

    from drumrs.frames import Frames

Indices = NDArray[np.signedinteger[Any]]

_GRAVITY = 9.81
# Change of the velocity between frames, but for gravity's, over gravity's, up to which nothing has knocked the disc.
_UNDISTURBED = 0.1
# Frames in which a flight is seen at least: of one alone it is not known how long it lasts.
_FEWEST = 2
# A disc that lands no further from the drum than this, over its radius, lands on it.
_NEAR = 0.1
# So much of the flying mass stays below the head, and so much of the landing energy lies beyond the impact toe.
_HEAD, _TOE = 0.99, 0.05


def flights(frames: "Frames", window: tuple[float, float], gravity: float = _GRAVITY) -> "pl.DataFrame":
    """Return the flights that begin and end within a window, disc by disc: no contact for ½ √(2 d/g) or more.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    gravity
        Acceleration of gravity, downwards [m/s²].

    Returns
    -------
    polars.DataFrame
        One row a flight: ``particle``; ``start``, ``end`` [s], ``start_x``, ``start_y``, ``end_x``, ``end_y`` [m] of
        the last frame with a contact before it and the first one after it; ``apex`` [m], the greatest y between;
        ``drop`` [m], start_y − end_y; ``speed`` [m/s] in the last frame of the flight; ``onto``, "drum" or "load";
        ``is_fall``, whether it drops by more than the diameter d.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    import polars as pl

    seen = counter_clockwise(within(frames, window))
    places = seen.positions.astype(np.float64)
    disc, first, end = _spells(seen, gravity)
    whole = (first > 0) & (end < len(seen))
    disc, start, end = disc[whole], first[whole] - 1, end[whole]
    before, after = places[start, disc], places[end, disc]
    apex = np.array([places[a : b + 1, k, 1].max() for k, a, b in zip(disc, start, end, strict=True)])
    diameter, drop = 2.0 * seen.radii[disc], before[:, 1] - after[:, 1]
    return pl.DataFrame(
        {
            "particle": disc,
            "start": seen.times[start],
            "end": seen.times[end],
            "start_x": before[:, 0],
            "start_y": before[:, 1],
            "end_x": after[:, 0],
            "end_y": after[:, 1],
            "apex": apex.astype(np.float64),
            "drop": drop,
            "speed": seen.speeds[end - 1, disc].astype(np.float64),
            "onto": np.where(_at_the_drum(seen, end, disc), "drum", "load"),
            "is_fall": drop > diameter,
        },
        schema_overrides={"particle": pl.UInt32, "onto": pl.String},
    )


def in_flight(frames: "Frames", gravity: float) -> NDArray[np.bool_]:
    """Tell which discs fly, frame by frame, shape (frames, n); those whose flight is cut at either end, too."""
    flies = np.zeros(frames.contacts.shape, dtype=bool)
    for disc, first, end in zip(*_spells(frames, gravity), strict=True):
        flies[first:end, disc] = True
    return flies


def _spells(frames: "Frames", gravity: float) -> tuple[Indices, Indices, Indices]:
    """Return disc, first frame and frame after the last of every flight, by disc and time, cut ones included."""
    lonely = np.zeros((frames.count, len(frames) + 2), dtype=bool)
    lonely[:, 1:-1] = (frames.contacts == 0).T
    goes_on = np.zeros((frames.count, len(frames) + 1), dtype=bool)
    goes_on[:, 1:-1] = _undisturbed(frames, gravity).T & lonely[:, 1:-2] & lonely[:, 2:-1]
    # By disc, then by time: the k-th beginning belongs to the k-th end.
    disc, first = np.nonzero(lonely[:, 1:] & ~goes_on)
    _, end = np.nonzero(lonely[:, :-1] & ~goes_on)
    interval = float(frames.times[-1] - frames.times[0]) / (len(frames) - 1)
    seen = end - first
    flies = (seen >= _FEWEST) & (seen * interval > 0.5 * np.sqrt(4.0 * frames.radii[disc] / gravity))
    return disc[flies], first[flies], end[flies]


def _undisturbed(frames: "Frames", gravity: float) -> NDArray[np.bool_]:
    """Tell which discs nothing but gravity has moved from each frame to the next, shape (frames - 1, n)."""
    gained = gravity * np.diff(frames.times)[:, np.newaxis]
    across, upwards = np.moveaxis(np.diff(frames.velocities.astype(np.float64), axis=0), -1, 0)
    undisturbed: NDArray[np.bool_] = np.hypot(across, upwards + gained) <= _UNDISTURBED * gained
    return undisturbed


def _at_the_drum(frames: "Frames", index: Indices, disc: Indices) -> NDArray[np.bool_]:
    """Tell which discs touch, or all but touch, the rim, a baffle or a wall, each in a frame of its own."""
    places = frames.positions.astype(np.float64)[index, disc]
    clearances = np.full(len(places), np.inf)
    if frames.drum_radius is not None:
        clearances = frames.drum_radius - np.hypot(*places.T)
    angles = frames.drum_angles[index]
    if len(places):
        in_the_drum = np.einsum("nj,njk->nk", places, np.array([turn_back(angle) for angle in angles]))
        clearances = np.minimum(clearances, distance_to_solids(frames, in_the_drum))
    near: NDArray[np.bool_] = clearances <= (1.0 + _NEAR) * frames.radii[disc]
    return near


def flight(
    frames: "Frames",
    window: tuple[float, float],
    masses: ArrayLike | None = None,
    gravity: float = _GRAVITY,
) -> dict[str, Mean | None]:
    """Return how much of the load flies, how often and how far it falls, and where it lands.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    masses
        Masses of the discs [kg/m]; proportional to their areas unless given.
    gravity
        Acceleration of gravity, downwards [m/s²].

    Returns
    -------
    dict
        By name of the registry, with standard errors:
        ``share_in_flight``, of mass and time, see `flights`; ``falls_per_turn``, falls of a disc in a turn of the drum,
        to or fro; ``mean_drop`` of a fall [m]; ``landing_on_drum``, the share of the energy of landing falls that meets
        rim, baffles and walls, not the load; ``head_height`` [m], above the axis, which 99 % of the flying mass stays
        below;
        ``impact_toe_angle`` [rad], which 5 % of the energy of landing falls lies beyond, as seen from the top.
        `None` where there is no fall, or the drum rests.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import flight
    >>> config = drumrs.baseline().replace({"run.duration": 0.6, "run.frame_every": 0.01})
    >>> found = flight(drumrs.run(config, progress=False).frames, window=(0.2, 0.6))
    >>> 0.0 < found["share_in_flight"].value < 1.0
    True
    """
    seen = counter_clockwise(within(frames, window))
    weights = seen.radii**2 if masses is None else np.asarray(masses, dtype=np.float64)
    weights = weights / weights.sum()
    flies, height = in_flight(seen, gravity), seen.positions[..., 1].astype(np.float64)
    interval = float(seen.times[-1] - seen.times[0]) / (len(seen) - 1)
    turns = float(np.abs(np.diff(seen.drum_angles)).sum()) / (2.0 * math.pi)
    falls = flights(frames, window, gravity).filter("is_fall")
    # By the frame of landing.
    frame = np.searchsorted(seen.times, falls["end"].to_numpy())
    drop = falls["drop"].to_numpy()
    energy = 0.5 * weights[falls["particle"].to_numpy()] * falls["speed"].to_numpy() ** 2
    angle = np.arctan2(falls["end_y"].to_numpy(), falls["end_x"].to_numpy())
    # From the top on, the way of the drum: that is where falling discs come from.
    beyond = (angle - 0.5 * math.pi) % (2.0 * math.pi)

    def by_frame(values: ArrayLike) -> Array:
        return np.bincount(frame, np.broadcast_to(values, frame.shape), len(seen)).astype(np.float64)

    def of_frames(chosen: slice) -> dict[str, float]:
        ahead, is_chosen = flies[chosen], np.isin(frame, np.arange(len(seen))[chosen])
        shares = np.broadcast_to(weights, ahead.shape)[ahead]
        return {
            "head_height": _quantile(height[chosen][ahead], shares, _HEAD),
            "impact_toe_angle": 0.5 * math.pi + _quantile(beyond[is_chosen], energy[is_chosen], _TOE),
        }

    places = {
        name: mean if math.isfinite(mean.value) else None
        for name, mean in with_errors(of_frames, seen.times).items()
    }
    on_drum = energy * (falls["onto"] == "drum").to_numpy()
    rate = by_frame(len(seen) / (turns * seen.count)) if turns else None
    return {
        "share_in_flight": mean_with_error(flies @ weights, interval),
        "falls_per_turn": mean_with_error(rate, interval) if rate is not None else None,
        "mean_drop": ratio_of_sums(by_frame(drop), by_frame(1.0)),
        "landing_on_drum": ratio_of_sums(by_frame(on_drum), by_frame(energy)),
        **places,
    }


def _quantile(values: Array, weights: Array, share: float) -> float:
    """Return the value that a share of the weights stays below; not a number without any."""
    if not len(values):
        return math.nan
    order = np.argsort(values, kind="stable")
    reached = np.cumsum(weights[order]) >= share * weights.sum()
    return float(values[order][reached.argmax()])
