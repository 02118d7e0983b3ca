"""Morrell's C-model of a tumbling mill: toe, shoulder and power of the charge from filling and speed alone.

S. Morrell, Power draw of wet tumbling mills and its relationship to charge dynamics, Trans. Inst. Min. Metall. C 105
(1996) 43 and 54, for a cylindrical mill without a pool of slurry. It was fitted to wet industrial mills and holds for
them within about 10 %: a line to compare with, not a law.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Charge:
    """Where the charge of a mill lies, and how far its weight stands from the axis.

    Attributes
    ----------
    toe, shoulder
        Angles of its lower and upper end [rad], counter-clockwise from the horizontal, of a drum that turns
        counter-clockwise.
    arm
        Net power over M g R Ω: the distance of the center of mass from the vertical through the axis, over R.
    """

    toe: float
    shoulder: float
    arm: float


def charge(filling: float, speed: float) -> Charge:
    """Return what the C-model says of a mill's charge; its size and density cancel.

    Parameters
    ----------
    filling
        Share J of the mill's cross-section that the charge fills at rest, the gaps between balls included.
    speed
        Speed over the critical one, √(g/R).

    Returns
    -------
    Charge
        Toe, shoulder and arm.

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import morrell
    >>> found = morrell.charge(filling=0.3, speed=0.72)
    >>> round(math.degrees(found.toe), 1), round(math.degrees(found.shoulder), 1), round(found.arm, 3)
    (231.9, 44.5, 0.298)
    """
    fastest = max(speed, 0.35 * (3.364 - filling))
    toe = 2.5307 * (1.2796 - filling) * (1.0 - math.exp(-19.42 * (fastest - speed))) + math.pi / 2.0
    shares = 0.3386 + 0.1041 * speed + (1.54 - 2.5673 * speed) * filling
    shoulder = math.pi / 2.0 - (toe - math.pi / 2.0) * shares
    inner = _inner_radius(filling, speed, toe, shoulder)
    return Charge(toe, shoulder, _arm(filling, inner, toe, shoulder, speed))


def _inner_radius(filling: float, speed: float, toe: float, shoulder: float) -> float:
    """Return the radius of the charge's inner surface, over the mill's.

    Of the time that a ball takes to come round, it spends ``in_charge`` in the charge and the rest in free fall.
    """
    swept = 2.0 * math.pi + shoulder - toe
    middle = 0.5 * (1.0 + math.sqrt(1.0 - 2.0 * math.pi * filling / swept))
    # Times in units of √(R/g), in which the angular velocity is the speed over the critical one.
    in_charge = 2.0 * swept / speed
    falling = math.sqrt(2.0 * middle * (math.sin(shoulder) - math.sin(toe)))
    active = in_charge / (in_charge + falling)
    return math.sqrt(1.0 - 2.0 * math.pi * active * filling / swept)


def _arm(filling: float, inner: float, toe: float, shoulder: float, speed: float) -> float:
    """Return net power over M g R Ω, of a mill of unit radius, length, density and gravity."""
    slip: float = (1.0 - filling) ** 0.4532
    gap = 1.0 - slip * inner
    turns = speed / (2.0 * math.pi)
    lifting = math.pi * turns / (3.0 * gap) * (2.0 - 3.0 * slip * inner + inner**3 * (3.0 * slip - 2.0))
    lifting *= math.sin(shoulder) - math.sin(toe)
    throwing = (math.pi * turns / gap) ** 3 * (gap**4 - inner**4 * (slip - 1.0) ** 4)
    return (lifting + throwing) / (math.pi * filling * speed)
