"""Hints at what can be simulated, but may not be what was meant, a sentence each.

Values that were probably meant in another unit; phases that do not fit into the duration; gravity along a tilted axis.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drumrs.config.derived import Facts
    from drumrs.config.tables import Tables


@dataclass(frozen=True)
class _Range:
    """What a key holds in any machine, and what its value may have been given in instead: units and their factors."""

    key: str
    least: float
    most: float
    unit: str
    meant: tuple[tuple[str, float], ...]

    def hint(self, value: float) -> Iterator[str]:
        """Give a hint at a value outside, but for 0, which is no matter of units."""
        if value == 0.0 or self.least <= value <= self.most:
            return
        where = f"below {self.least:g}" if value < self.least else f"above {self.most:g}"
        units = [(unit, value * factor) for unit, factor in self.meant]
        meant = [(unit, number) for unit, number in units if self.least <= number <= self.most]
        readings = " or ".join(f"{number:.6g} where {unit} were meant" for unit, number in meant)
        way_out = f"write {readings}" if meant else f"is it in {self.unit}?"
        yield f"{self.key} is {value:g} {self.unit}, {where}: {way_out}"


_SHORTER = (("centimeters", 1e-2), ("millimeters", 1e-3))
_BUNDLE = _Range("load.diameter", 1e-4, 0.2, "m", _SHORTER)
_DRUM = _Range("drum.diameter", 5e-3, 20.0, "m", _SHORTER)
# Half the length of a floor that is long for any purpose [m].
_FARTHEST = 100.0
_GRAVITY = _Range("gravity", 1e-3, 100.0, "m/s²", (("cm/s²", 1e-2), ("mm/s²", 1e-3)))
_DENSITY = _Range("load.density", 5.0, 25e3, "kg/m³", (("g/cm³", 1e3), ("g/m³", 1e-3)))
_MOISTURE = _Range("load.moisture", 0.0, 5.0, "kg per kg", (("per cent", 1e-2),))
_MODULUS = _Range("young_modulus", 1e3, 1e13, "Pa", (("MPa", 1e6), ("GPa", 1e9)))
# Froude numbers between which loads roll, tumble and begin to centrifuge.
_LEAST_FROUDE, _MOST_FROUDE = 1e-3, 3.0
# What a speed may have been given in, and how many rpm that is.
_SPEEDS = (("rad/s", 30.0 / math.pi), ("revolutions per second", 60.0), ("degrees per second", 1.0 / 6.0))
# Angles in radians are such parts of a turn, with so many decimals.
_PARTS_OF_A_TURN = 24
_DECIMALS = range(2, 16)


def hints(config: "Tables", facts: "Facts") -> list[str]:
    """Return what the author of a configuration may not have meant, a sentence each."""
    first = [*_lengths(config), *_GRAVITY.hint(math.hypot(*config.gravity))]
    # Where a length or gravity is wrong, the Froude number is wrong with it.
    return [*first, *([] if first else _speeds(config, facts)), *_others(config)]


def _lengths(config: "Tables") -> Iterator[str]:
    drum = config.drum
    yield from _BUNDLE.hint(config.load.diameter)
    for index, species in enumerate(config.load.species or ()):
        if species.diameter is not None:
            yield from replace(_BUNDLE, key=f"load.species[{index}].diameter").hint(species.diameter)
    if drum.rim:
        yield from _DRUM.hint(drum.diameter)
    elif drum.shell is not None:
        yield from replace(_DRUM, key="drum.liner.outlines").hint(drum.area_diameter)
    # Walls stand within the rim, or are a machine of their own.
    reach = drum.diameter if drum.rim else _FARTHEST
    for index, line in enumerate(drum.walls):
        farthest = max(abs(part) for point in line for part in point)
        yield from _Range(f"drum.walls[{index}]", 0.0, reach, "m from the axis", _SHORTER).hint(farthest)


def _speeds(config: "Tables", facts: "Facts") -> Iterator[str]:
    greatest, speeds = facts.froude_number, [abs(speed) for speed in config.rotation.speeds]
    if not greatest or any(_tumbles(greatest * (speed / max(speeds)) ** 2) for speed in speeds):
        return
    units = [(unit, max(speeds) * factor, greatest * factor**2) for unit, factor in _SPEEDS]
    meant = " or ".join(
        f"{speed:.4g} (Froude number {froude:.2g}) where {unit} were meant"
        for unit, speed, froude in units
        if _tumbles(froude)
    )
    way_out = f": write {meant}" if meant else ""
    yield (
        f"rotation.{config.rotation.given} reaches {max(speeds):g} rpm, a Froude number of {greatest:.2g}, but loads "
        f"tumble between {_LEAST_FROUDE:g} and {_MOST_FROUDE:g}{way_out}"
    )


def _tumbles(froude: float) -> bool:
    # A speed that was calculated for the least Froude number may miss it by round-off.
    return 0.999 * _LEAST_FROUDE < froude < _MOST_FROUDE


def _others(config: "Tables") -> Iterator[str]:
    yield from _DENSITY.hint(config.load.density)
    yield from _MOISTURE.hint(config.load.moisture or 0.0)
    for index, species in enumerate(config.load.species or ()):
        if species.density is not None:
            yield from replace(_DENSITY, key=f"load.species[{index}].density").hint(species.density)
    if config.contact.base == "hertz":
        for table in ("bundle", "drum"):
            modulus = getattr(config.contact, table).young_modulus
            yield from replace(_MODULUS, key=f"contact.{table}.{_MODULUS.key}").hint(modulus)
    if config.drum.baffles.count:
        yield from _degrees("drum.baffles.phase", config.drum.baffles.phase)
    rail = config.drum.liner.rail
    for key in ("face_angle", "back_angle") if rail.count else ():
        angle = getattr(rail, key)
        # Liners have faces along the radial, or leaning by more than that.
        if 0.0 < abs(angle) < math.pi / 2.0:
            meant = math.degrees(angle)
            yield f"drum.liner.rail.{key} is {angle:g} degrees: write {meant:.3g} where radians were meant"
    yield from _degrees("drum.tilt", config.drum.tilt)
    if config.drum.tilt:
        angle = math.radians(config.drum.tilt)
        within, along = (
            abs(math.hypot(*config.gravity) * part) for part in (math.cos(angle), math.sin(angle))
        )
        yield (
            f"drum.tilt is {config.drum.tilt:g} degrees: {within:.4g} m/s² of gravity act in the plane; {along:.4g} "
            "m/s² along the axis are left out, and with them what the load does towards the end walls"
        )
    end, duration = max((each.end for each in config.rotation.intervals), default=0.0), config.run.duration
    if end > duration * (1.0 + 1e-9):
        yield (
            f"rotation.phase lasts {end:.6g} s, run.duration {duration:g} s: what comes later is not simulated; for "
            f"the whole program set run.duration = {end:.6g}"
        )


def _degrees(key: str, value: float) -> Iterator[str]:
    """Give a hint at an angle in degrees that is a fraction of π, as angles in radians are."""
    part = round(min(abs(value) / math.tau, 2.0) * _PARTS_OF_A_TURN)
    written = {round(part * math.tau / _PARTS_OF_A_TURN, decimals) for decimals in _DECIMALS}
    if 0 < part <= _PARTS_OF_A_TURN and round(abs(value), _DECIMALS[-1]) in written:
        meant = math.copysign(360.0 * part / _PARTS_OF_A_TURN, value)
        yield f"{key} is {value:g} degrees: write {meant:g} where radians were meant"
