"""Measures of the shape of the charge, on a load that fills a segment of the drum."""

import math

import numpy as np

from drumrs import measures
from drumrs.verification import made_up
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace

_RADIUS = 0.025
_HALF_ANGLES, _SLOPE = (1.2, 1.6), 0.5
# The bins of angle of toe and shoulder.
_BIN = math.radians(3.0)


@case(
    "charge",
    source="geometry of a circular segment",
    formula="toe 270° + α − Θ, shoulder 270° + α + Θ, J = (Θ − sin Θ cos Θ)/π, arm = ⅔ sin³Θ sin α/(π J)",
    cost=1e6,
)
def charge() -> Evidence:
    """Toe, shoulder, slopes, S-shape, filling and arm of a packing in a tilted segment.

    Toe and shoulder: a bin of 3°. Slopes and the bulge of the surface: a radius over the half chord. Filling: half a
    radius all along the chord. Arm: half a radius, for discs keep off the rim.
    """
    found, traces = [], []
    for half_angle in _HALF_ANGLES:
        seen = measures.charge(made_up.segment(half_angle, _SLOPE, _RADIUS), (0.0, 1.0))
        area = half_angle - math.sin(half_angle) * math.cos(half_angle)
        chord = 2.0 * math.sin(half_angle)
        slope = _RADIUS / (0.5 * chord)
        rows = [
            ("toe_angle", "rad", 1.5 * math.pi + _SLOPE - half_angle, _BIN),
            ("shoulder_angle", "rad", -0.5 * math.pi + _SLOPE + half_angle, _BIN),
            ("surface_slope", "rad", _SLOPE, slope),
            ("center_slope", "rad", _SLOPE, slope),
            ("s_shape", "1", 0.0, slope),
            ("filling", "1", area / math.pi, 0.5 * _RADIUS * chord / math.pi),
            ("arm", "1", 2.0 / 3.0 * math.sin(half_angle) ** 3 * math.sin(_SLOPE) / area, 0.5 * _RADIUS),
        ]
        values = [seen[name].value for name, *_ in rows]
        found += [
            Check(f"{name}, Θ = {half_angle:g}", unit, expected, value, tolerance)
            for (name, unit, expected, tolerance), value in zip(rows, values, strict=True)
        ]
        traces.append(Trace(f"Θ = {half_angle:g}", [row[2] for row in rows], values))
    line = np.array([-1.0, 5.0])
    return Evidence(tuple(found), Panel("expected", "measured", (Trace("", (), (), (line, line)), *traces)))


@case(
    "occupancy",
    source="geometry of a hexagonal packing",
    formula="π/(2√3) in the bed, 0 outside of it",
    cost=1e6,
)
def occupancy() -> Evidence:
    """Solid fraction two to six diameters below the shell, inside the segment and outside of it.

    Half a diameter's share of the layer, for places are sampled on a grid; outside, none may be covered.
    """
    half_angle, layers = 1.5, (2.0, 6.0)
    seen = measures.occupancy(made_up.segment(half_angle, 0.0, _RADIUS), (0.0, 1.0), layers, bins=72)
    away = np.abs((seen.angles + 0.5 * math.pi + math.pi) % math.tau - math.pi)
    inside, outside = away < half_angle - 0.3, away > half_angle + 0.1
    fraction = seen.solid_fraction[0]
    expected = math.pi / (2.0 * math.sqrt(3.0))
    found = (
        Check("solid fraction in the bed", "1", expected, float(fraction[inside].mean()), 0.01),
        Check("solid fraction outside", "1", 0.0, float(fraction[outside].max()), 0.0),
    )
    step = np.where(np.sort(away) < half_angle, expected, 0.0)
    trace = Trace("", away, fraction, (np.sort(away), step))
    return Evidence(found, Panel("angle from the bottom [rad]", "solid fraction", (trace,)))


CASES = (charge, occupancy)
