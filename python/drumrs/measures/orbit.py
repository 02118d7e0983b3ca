"""Davis's orbit: a point is held to the rim of a drum up to where its weight is the centripetal force, and flies."""

import math
from dataclasses import dataclass

from drumrs.errors import ConfigError


@dataclass(frozen=True)
class Orbit:
    """A free orbit in a drum that turns counter-clockwise; lengths over r, speeds over √(g r), r that of the orbit.

    Attributes
    ----------
    release
        Angle a between the top and where the point leaves the rim, on the rising side [rad].
    landing
        Where it meets the rim again [rad], counter-clockwise from the horizontal: 90° + 3 a.
    drop
        Height from release to landing, 4 sin²a cos a.
    rise
        Height from release to the apex, ½ sin²a cos a.
    flight
        Time of flight over the time of a turn, 2 Fr sin a / π.
    speed
        Speed at landing, √(Fr (1 + 8 sin²a)).
    normal_speed
        Its part normal to the rim, √Fr (cos a sin 3a − 3 sin a cos 3a).
    """

    release: float
    landing: float
    drop: float
    rise: float
    flight: float
    speed: float
    normal_speed: float


def davis(froude: float) -> Orbit:
    """Return the free orbit of a point in a drum, by the Froude number Ω² r/g of its orbit.

    The point leaves where cos a = Fr (E. W. Davis, Trans. AIME 61 (1919) 250). The longest drop, 1.54 r, is at Fr =
    1/√3, 76 % of the critical speed.

    Parameters
    ----------
    froude
        Ω² r/g; r is the radius of the rim less that of the disc.

    Raises
    ------
    ConfigError
        Where it is not between 0 and 1: from 1 on the point stays on the rim.

    Examples
    --------
    >>> import math
    >>> from drumrs.measures import davis
    >>> orbit = davis(0.5)
    >>> round(math.degrees(orbit.release), 6), round(math.degrees(orbit.landing), 6), round(orbit.drop, 6)
    (60.0, 270.0, 1.5)
    """
    if not 0.0 < froude < 1.0:
        raise ConfigError("froude", froude, "above 0 and below 1, where the rim lets go of the point")
    release = math.acos(froude)
    sine, speed = math.sin(release), math.sqrt(froude)
    return Orbit(
        release=release,
        landing=0.5 * math.pi + 3.0 * release,
        drop=4.0 * sine**2 * froude,
        rise=0.5 * sine**2 * froude,
        flight=2.0 * froude * sine / math.pi,
        speed=speed * math.sqrt(1.0 + 8.0 * sine**2),
        normal_speed=speed * (froude * math.sin(3.0 * release) - 3.0 * sine * math.cos(3.0 * release)),
    )
