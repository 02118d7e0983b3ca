"""How the bundles move: carried round by the drum, along its rim, and round a center."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drumrs.analysis.blocks import Array, Mean, mean_with_error, ratio_of_sums
from drumrs.measures.frame_window import FrameWindow, counter_clockwise, turn_back, within

if TYPE_CHECKING:
    from drumrs.frames import Frames

# Motion relative to the drum, over the motion of the drum, up to which a bundle goes with it.
_NEAR = 0.2
# The angle to either side of the top within which a bundle must go with the drum to be carried over it.
_EIGHTH_OF_A_TURN = np.pi / 4.0
# The layer at the rim, in diameters from the wall to a bundle's center.
_LAYER = 1.5


def carried_round(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return how often a bundle is carried over the top, in a turn of the drum.

    C = P / (N τ) with N bundles and τ turns of the drum. P counts the times that a bundle passes the line from the
    axis straight up, at any distance, while it goes with the drum: from one frame to the next, within an eighth of
    a turn before and after, |Δr'| ≤ 0.2 |r| |Δφ|, where r' is its place seen from the turning drum, |r| its distance
    from the axis and Δφ the angle by which the drum turns between the two frames.

    C is 1 for a load that rides whole with the drum, at any fill and size of bundles, ½ where half of it does, and 0
    for one that never comes over the top, slides, or falls or flies there.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn; a sixteenth or less tells flight from riding best.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import carried_round
    >>> config = drumrs.baseline().replace({"run.duration": 0.1, "run.frame_every": 0.01})
    >>> frames = drumrs.run(config, progress=False).frames
    >>> carried_round(frames, window=(0.0, 0.1)).value  # the load falls to the bottom
    0.0
    """
    seen = FrameWindow.of(frames, window)
    if seen.turned == 0.0:
        return None
    pairs = list(seen.pairs())
    rides = np.array([_goes_with_the_drum(*pair) for pair in pairs])
    tops = np.array([_passes_the_top(*pair) for pair in pairs])
    reach = max(1, round(_EIGHTH_OF_A_TURN * len(pairs) / abs(seen.turned)))
    passages = [
        (tops[k] & rides[max(k - reach, 0) : k + reach + 1].all(axis=0)).mean() for k in range(len(pairs))
    ]
    return mean_with_error(np.array(passages) * len(pairs) / seen.turns, seen.interval)


def along_the_rim(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the share of the time that a bundle rides along the rim.

    Riding is to be within one and a half diameters of the wall and at the drum's angular velocity, to 20 %.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than an eighth of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn, or has no rim.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import along_the_rim
    >>> config = drumrs.baseline().replace({"run.duration": 0.1, "run.frame_every": 0.01})
    >>> frames = drumrs.run(config, progress=False).frames
    >>> 0.0 <= along_the_rim(frames, window=(0.0, 0.1)).value <= 1.0
    True
    """
    seen = FrameWindow.of(frames, window)
    if not np.diff(seen.angles).any() or frames.drum_radius is None:
        return None
    reach = frames.drum_radius - 2.0 * _LAYER * frames.radii
    shares = [
        (
            (np.abs(_swept(before, after) - angle) <= _NEAR * abs(angle)) & (np.hypot(*before.T) >= reach)
        ).mean()
        for before, after, angle in seen.pairs()
    ]
    return mean_with_error(shares, seen.interval)


def wall_slip(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return how far the layer at the wall stays behind the drum: 1 − ⟨ω⟩/Ω, with its angular velocity about the axis.

    The layer is what lies within one and a half diameters of the wall. The slip is 0 for a load that goes with the
    drum, 1 for one that stays where it is. While the drum rests nothing is counted; to and fro count alike.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than a quarter of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn, or has no rim, or nothing is at the wall.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    found = ratio_of_sums(*_layer_at_the_wall(frames, window))
    return None if found is None else Mean(1.0 - found.value, found.error)


def sticking(frames: "Frames", window: tuple[float, float]) -> Mean | None:
    """Return the share of the time in which the layer at the wall goes with the drum, to 20 % of its angular velocity.

    The layer is that of `wall_slip`, taken as a whole. A load that surges goes with the drum and slides back in turn.

    Parameters
    ----------
    frames
        Frames of a run, no further apart than a quarter of a turn.
    window
        Start and end [s].

    Returns
    -------
    Mean or None
        `None` where the drum does not turn, or has no rim, or nothing is at the wall.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    turned, driven = _layer_at_the_wall(frames, window)
    goes = (np.abs(turned - driven) <= _NEAR * driven) & (driven > 0.0)
    return ratio_of_sums(goes, driven > 0.0)


def _layer_at_the_wall(frames: "Frames", window: tuple[float, float]) -> Array:
    """Return the angles by which its discs went the drum's way, and those of the drum, as sums from frame to frame."""
    seen = FrameWindow.of(frames, window)
    reach = (frames.drum_radius or np.inf) - 2.0 * _LAYER * frames.radii
    sums = []
    for before, after, angle in seen.pairs():
        layer = np.hypot(*before.T) >= reach
        sums.append((np.sign(angle) * _swept(before, after)[layer].sum(), abs(angle) * layer.sum()))
    return np.transpose(sums)


def _goes_with_the_drum(before: Array, after: Array, angle: float) -> NDArray[np.bool_]:
    """Tell which bundles hardly move as seen from the drum, between two frames."""
    moved = np.hypot(*(after @ turn_back(angle) - before).T)
    goes: NDArray[np.bool_] = moved <= _NEAR * abs(angle) * np.hypot(*before.T)
    return goes


def _passes_the_top(before: Array, after: Array, angle: float) -> NDArray[np.bool_]:
    """Tell which bundles pass the line from the axis straight up between two frames, in the sense of rotation."""
    ahead = np.sign(angle) * (np.pi / 2.0 - np.arctan2(before[:, 1], before[:, 0])) % (2.0 * np.pi)
    passes: NDArray[np.bool_] = ahead < np.sign(angle) * _swept(before, after)
    return passes


def circulation(frames: "Frames", window: tuple[float, float], center: ArrayLike = (0.0, 0.0)) -> Mean | None:
    """Return how often a disc goes round a center while the drum turns once.

    It is 1 for a load that rides with the drum, about the axis. A bed that turns with the drum below a thin layer goes
    round in (Θ − sin Θ cos Θ)/(π sin²Θ) of a turn on average, with half the angle Θ that it spans: twice a turn at half
    fill.

    Parameters
    ----------
    frames
        Frames of a run, so close together that no disc goes half round the center between two of them.
    window
        Start and end [s].
    center
        The center [m], such as `center_of_circulation`.

    Returns
    -------
    Mean or None
        `None` where the drum rests.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    seen = FrameWindow.of(counter_clockwise(within(frames, window)), window)
    if seen.turned == 0.0:
        return None
    apart = seen.positions - np.asarray(center)
    swept = np.array([_swept(*pair).mean() for pair in pairwise(apart)])
    return mean_with_error(swept * len(swept) / seen.turned, seen.interval)


def _swept(before: Array, after: Array) -> Array:
    """Return the angles about the axis by which bundles went, within ±π."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angles: Array = np.arctan2(cross, (before * after).sum(axis=1))
    return angles
