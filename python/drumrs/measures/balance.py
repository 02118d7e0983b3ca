"""Unbalance of the load in a drum on a fixed axis: how far off the axis it is, and what bearings feel of it.

A plane knows unbalance of forces only: the couple of two unbalances, front and rear, is beyond it.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from drumrs.analysis.blocks import Array, Mean, SeriesWindow, mean_with_error
from drumrs.errors import ConfigError
from drumrs.measures.frame_window import FrameWindow, turn_back, with_errors

if TYPE_CHECKING:
    import polars as pl

    from drumrs.frames import Frames


def unbalance_vectors(frames: "Frames", window: tuple[float, float], masses: ArrayLike) -> Array:
    """Return the unbalance U = R(−θ) Σ m r in the frame of the drum, frame by frame.

    Parameters
    ----------
    frames
        Frames of a run.
    window
        Start and end [s].
    masses
        Masses of the discs [kg/m], see `disc_masses`.

    Returns
    -------
    array
        U [kg m per m of depth], shape (frames, 2). Times the depth over the drum's radius it is the mass at the rim, as
        the trade has it.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.
    """
    seen = FrameWindow.of(frames, window)
    moments = np.einsum("fnk,n->fk", seen.positions, np.asarray(masses, dtype=np.float64))
    vectors = [moment @ turn_back(angle) for moment, angle in zip(moments, seen.angles, strict=True)]
    return np.array(vectors)


def unbalance(frames: "Frames", window: tuple[float, float], masses: ArrayLike) -> dict[str, Mean]:
    """Return how far the load is from balance in a window.

    Parameters
    ----------
    frames, window, masses
        As for `unbalance_vectors`.

    Returns
    -------
    dict
        By name of the registry, with standard errors: ``unbalance``, the mean of |U| [kg]; ``turning_unbalance``, the
        length of the mean of U, which turns with the drum: the bearings feel it as a force of that times Ω² [kg];
        ``eccentricity``, the mean of |U| over the mass of the load [m]. The first two are equal for a load that rides
        with the drum as one body, the second vanishes for one that tumbles.

    Raises
    ------
    ConfigError
        Where the window holds fewer than two frames.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.measures import disc_masses, unbalance
    >>> result = drumrs.run(drumrs.baseline().replace({"run.duration": 0.2}), progress=False)
    >>> masses = disc_masses(result.config, result.frames)
    >>> found = unbalance(result.frames, (0.0, 0.2), masses)
    >>> 0.0 < found["eccentricity"].value < result.frames.drum_radius
    True
    """
    vectors, seen = unbalance_vectors(frames, window, masses), FrameWindow.of(frames, window)
    lengths, mass = np.hypot(*vectors.T), float(np.sum(masses))
    turning = with_errors(
        lambda chosen: {"turning_unbalance": float(np.hypot(*vectors[chosen].mean(axis=0)))}, seen.times
    )
    return {
        "unbalance": mean_with_error(lengths, seen.interval),
        **turning,
        "eccentricity": mean_with_error(lengths / mass, seen.interval),
    }


def turning_force(series: "pl.DataFrame", window: tuple[float, float]) -> Array:
    """Return the part of the load's force on the drum that turns with it: what bearings feel of the unbalance.

    The recorded forces, means between samples, are fitted by F₀ + R(θ) f, least squares, with the means of the rotation
    over the same times: exact for a load that rides with a drum of constant speed, whose weight is in F₀ and whose f is
    Ω² U. It is a second route to the unbalance, by contact forces instead of places.

    Parameters
    ----------
    series
        Table of a run, one row a sample.
    window
        Start and end [s]; several samples a turn, a turn at least.

    Returns
    -------
    array
        f in the frame of the drum [N/m], shape (2,).

    Raises
    ------
    ConfigError
        Where the window holds fewer than two samples, or the drum rests.
    """
    rows = SeriesWindow.of(series, window)
    angles = rows.column("drum_angle")
    swept, middle = np.diff(angles), 0.5 * (angles[1:] + angles[:-1])
    if not swept.all():
        raise ConfigError("window", window, "one in which the drum turns all the time")
    forces = np.zeros(len(swept), dtype=np.complex128)
    for name in series.columns:
        if name.endswith(("_force_x", "_force_y")):
            forces += rows.column(name)[1:] * (1.0 if name.endswith("x") else 1.0j)
    # Mean of exp(iθ) while the drum sweeps an angle about its middle.
    rotation = np.exp(1.0j * middle) * np.sinc(swept / (2.0 * np.pi))
    columns = np.column_stack([np.ones_like(rotation), rotation])
    _, turning = np.linalg.lstsq(columns, forces, rcond=None)[0]
    return np.array([turning.real, turning.imag])


@dataclass(frozen=True)
class Exceedance:
    """How often a limit is exceeded, in independent tries.

    Attributes
    ----------
    share
        Share of the tries above the limit.
    low, high
        Ends of the exact confidence interval of the chance.
    tries
        Tries that it takes on average until one keeps the limit; infinite where none did.
    """

    share: float
    low: float
    high: float
    tries: float


def exceedance(values: ArrayLike, limit: float, level: float = 0.95) -> Exceedance:
    """Return the chance that a value exceeds a limit: of the unbalance after distribution, seed by seed.

    Parameters
    ----------
    values
        One for each independent run.
    limit
        The limit, in their unit.
    level
        Probability that the interval holds the chance (Clopper & Pearson, Biometrika 26 (1934) 404).

    Examples
    --------
    >>> from drumrs.measures import exceedance
    >>> found = exceedance([0.1, 0.3, 0.2, 0.5], limit=0.25)
    >>> found.share, round(found.low, 4), round(found.high, 4), found.tries
    (0.5, 0.0676, 0.9324, 2.0)
    """
    from scipy.special import betaincinv

    above, count = int(np.sum(np.asarray(values) > limit)), np.size(values)
    tail = 0.5 * (1.0 - level)
    low = float(betaincinv(above, count - above + 1, tail)) if above else 0.0
    high = float(betaincinv(above + 1, count - above, 1.0 - tail)) if above < count else 1.0
    tries = count / (count - above) if above < count else float("inf")
    return Exceedance(above / count, low, high, tries)


@dataclass(frozen=True)
class Suspension:
    """A tub on springs and dashpots, alike along x and y, that shakes with the unbalance of its drum.

    Its motion is that of a linear system that the drum's speed is forced upon, after all transients; the load is taken
    not to notice. So it holds below and above the resonance, not on the way through it.

    Attributes
    ----------
    tub_mass
        Mass of the tub with the empty drum [kg].
    stiffness
        Stiffness of the springs, along one axis [N/m].
    damping
        Constant of the dashpots, along one axis [N s/m].

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import Suspension
    >>> tub = Suspension(tub_mass=30.0, stiffness=2e4, damping=150.0)
    >>> stroke = tub.stroke(0.8, 4.0, 800.0 * math.pi / 30.0)
    >>> round(1000.0 * stroke, 2)  # mm
    25.64
    """

    tub_mass: float
    stiffness: float
    damping: float

    def resonance(self, load_mass: float) -> float:
        """Return the natural angular velocity √(k/M) with a load of that mass [kg], undamped [rad/s]."""
        return float(np.sqrt(self.stiffness / (self.tub_mass + load_mass)))

    def stroke(self, unbalance: float, load_mass: float, angular_velocity: float) -> float:
        """Return the amplitude of the tub's circle [m], (U/M) η²/√((1 − η²)² + (2 ζ η)²) with η = Ω/√(k/M).

        Parameters
        ----------
        unbalance
            U of the whole drum [kg m]: that per meter times the depth.
        load_mass
            Mass of the load [kg].
        angular_velocity
            Ω [rad/s].
        """
        mass = self.tub_mass + load_mass
        push = unbalance * angular_velocity**2
        return float(
            push / np.hypot(self.stiffness - mass * angular_velocity**2, self.damping * angular_velocity)
        )

    def floor_force(self, unbalance: float, load_mass: float, angular_velocity: float) -> float:
        """Return the amplitude of the force that springs and dashpots hand on, along one axis [N]: X √(k² + c² Ω²)."""
        force = np.hypot(self.stiffness, self.damping * angular_velocity)
        return self.stroke(unbalance, load_mass, angular_velocity) * float(force)

    def loss(self, unbalance: float, load_mass: float, angular_velocity: float) -> float:
        """Return the power that the dashpots of both axes take, and the motor gives [W]: c Ω² X²."""
        stroke = self.stroke(unbalance, load_mass, angular_velocity)
        return self.damping * (angular_velocity * stroke) ** 2
