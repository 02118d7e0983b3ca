"""Hogg and Fuerstenau's model of a tumbling mill: power of a charge with a flat surface, from filling and lift angle.

R. Hogg and D. W. Fuerstenau, Power relationships for tumbling mills, Trans. SME-AIME 252 (1972) 418. The charge is a
segment of the cross-section whose surface is inclined by the lift angle, which the model leaves open: it is fitted to
mills whose power is known. The formula in use, as in Moly-Cop Tools, is

    P = 0.238 D^3.5 (L/D) φ ρ (J − 1.065 J²) sin α

with the net power P [kW], diameter D and length L [ft], the speed φ over the critical one, the density ρ of the charge
[t/m³], voids counted, its filling J and the lift angle α.
"""

import math

from drumrs.errors import ConfigError

_FOOT = 0.3048
_STANDARD_GRAVITY = 9.80665
# Of the formula, over M g R Ω: M = 1000 ρ π R² L J, Ω = φ √(g/R), kW and feet into SI.
_SCALE: float = 238.0 / _FOOT**3.5 * 2.0**2.5 / (1000.0 * math.pi * _STANDARD_GRAVITY**1.5)
_BEND = 1.065


def arm(filling: float, lift_angle: float) -> float:
    """Return net power over M g R Ω; size, speed and density of the charge cancel.

    For fillings J from 0.15 to 0.5 it is within 2 % of the arm of a flat segment, ⅔ sin³Θ sin α / (π J) with
    J = (Θ − sin Θ cos Θ)/π, of which J − 1.065 J² is a fit. Nothing is thrown in it: it means little near the
    critical speed.

    Parameters
    ----------
    filling
        Share J of the mill's cross-section that the charge fills at rest, the gaps between balls included.
    lift_angle
        Slope α of the charge's surface [rad]; 35° to 45° are usual.

    Returns
    -------
    float
        The distance of the center of mass from the vertical through the axis, over R.

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import hogg_fuerstenau
    >>> round(hogg_fuerstenau.arm(filling=0.3, lift_angle=math.radians(35.0)), 3)
    0.348
    """
    return _level_arm(filling) * math.sin(lift_angle)


def lift_angle(filling: float, arm: float) -> float:
    """Return the lift angle that a power asks for [rad]: the inverse of `arm`.

    Parameters
    ----------
    filling
        The filling J.
    arm
        Net power over M g R Ω.

    Raises
    ------
    ConfigError
        Where no lift angle gives so much.

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import hogg_fuerstenau
    >>> round(math.degrees(hogg_fuerstenau.lift_angle(filling=0.3, arm=0.35)), 1)
    35.2
    """
    most = _level_arm(filling)
    if not abs(arm) <= most:
        raise ConfigError("arm", arm, f"at most {most:.4g}, that of a lift angle of 90° at this filling")
    return math.asin(arm / most)


def _level_arm(filling: float) -> float:
    """Return the arm at a lift angle of 90°."""
    return _SCALE * (1.0 - _BEND * filling)
