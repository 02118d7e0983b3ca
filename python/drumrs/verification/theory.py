"""Closed forms for discs (I = m r²/2) with the linear law, and what the time step leaves of them.

How far a run may be off
------------------------
With θ = ω₀ Δt, the phase by which an undamped contact advances in a step:

- The leapfrog swings with (2/Δt) asin(θ/2) instead of ω₀: too fast by θ²/24. The dashpot sees a foretold velocity,
  which lacks ⅜ Δt² of its second derivative, ⅜ θ² of itself. Sums over a contact are trapezoids, whose error is θ²/12
  of what they add. Each of these is below θ² of the speeds at hand, and a contact is of the order of one in ω₀ t: a
  formula is met within **θ²**. A dashpot alone stops a body within 1/(2 z ω₀): at damping ratios z above ½ that is
  the faster, and θ = 2 z ω₀ Δt.
- A force that jumps where bodies meet or part (the dashpot's, a stretched tangential spring's) is right to half a step:
  θ of itself in a single impact, one way or the other. The mean over n places within the step at which bodies
  may meet, spread evenly, is a midpoint sum: what is left of it is θ/n.
- The formulas let a disc keep its radius r while the contact's lever arm is r − δ: they hold within δ/r, δ the
  greatest overlap.
- Round-off is ε = 2⁻⁵² of what is rounded. Over n steps it is below n ε, if all of it went one way.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

EPSILON = float(np.finfo(float).eps)

# How far a measured order may be from 2, over three halvings. The next term is θ² of the first, and what 400 onsets
# leave, θ/400, a tenth of the smallest error. The number of steps in a contact changes with the step, and the
# coefficient with it, by half at most.
ORDER_ERROR = (math.log2(1.1) + math.log2(1.5)) / 3.0


def mean_error(frequency: float, time_step: float, onsets: int, ratio: float = 0.0) -> float:
    """Return how far a mean over onsets may be off, relatively: θ² + θ/n.

    Parameters
    ----------
    frequency
        ω₀ [1/s].
    time_step
        Δt [s].
    onsets
        Number n of places within the step at which bodies may meet.
    ratio
        Damping ratio z.
    """
    phase = max(1.0, 2.0 * ratio) * frequency * time_step
    return phase**2 + phase / onsets


def free_restitution(ratio: ArrayLike) -> Array:
    """Return e of a head-on impact whose dashpot may pull, e = exp(−π z/√(1 − z²)), at damping ratios z below 1."""
    z = np.asarray(ratio, dtype=float)
    return np.exp(-math.pi * z / np.sqrt(1.0 - z**2))


def clipped_restitution(ratio: ArrayLike) -> Array:
    """Return e where the force ends as it vanishes, e = exp(−(z/√(1 − z²)) (π − 2 asin z)), at ratios z below 1.

    Source: Schwager & Pöschel, Granular Matter 9 (2007) 465.
    """
    z = np.asarray(ratio, dtype=float)
    return np.asarray(np.exp(-z / np.sqrt(1.0 - z**2) * (math.pi - 2.0 * np.arcsin(z))))


def damping_ratio(restitution: float, *, clipped: bool = False) -> float:
    """Return the damping ratio z of a restitution e: −ln e/√(π² + ln² e) where the dashpot may pull.

    With tension clipped, e = exp(−2 φ/tan φ) with φ = acos z, and beyond critical damping e = exp(−2 φ/tanh φ) with
    φ = acosh z, which is solved by bisection. Source: Schwager & Pöschel, Granular Matter 9 (2007) 465.
    """
    decay = -math.log(restitution)
    if not clipped or decay == 0.0:
        return decay / math.hypot(math.pi, decay)
    low, high = 0.0, 1.0 + decay
    for _ in range(100):
        middle = (low + high) / 2.0
        low, high = (middle, high) if _clipped_decay(middle) < decay else (low, middle)
    return low


def _clipped_decay(ratio: float) -> float:
    if ratio < 1.0:
        return 2.0 * math.acos(ratio) / math.tan(math.acos(ratio))
    phase = math.acosh(ratio)
    return 2.0 * phase / math.tanh(phase) if phase else 2.0


def tangential_impulse(slip: ArrayLike, closing: float, friction: float) -> Array:
    """Return J/m* of an elastic impact with kₛ/kₙ = 1/3 [m/s].

    A disc's tangential mass is m*/3, so the spring swings along the tangent as fast as along the normal, and both
    forces keep their ratio: the contact sticks throughout, and J = ⅔ m* s turns the slip s round, or it slides
    throughout, and J = 2 μ m* w with the closing speed w.
    """
    s = np.asarray(slip, dtype=float)
    return np.asarray(np.copysign(np.minimum(2.0 / 3.0 * np.abs(s), 2.0 * friction * closing), s))
