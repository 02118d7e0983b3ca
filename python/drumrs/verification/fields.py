"""Measures of fields: a load that turns as one body, a load that only trembles, and a layer that flows over a bed."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs import Frames, measures
from drumrs.verification import made_up
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at

Array = NDArray[np.float64]

_RADIUS, _MASS, _SPEED, _TREMBLE = 0.04, 2.0, 2.0, 0.5
_CENTER = np.array([0.2, -0.3])
# Nodes so near to the axis see no edge of the load.
_INNER = 0.6


@case(
    "fields",
    source="identities of coarse graining; Goldhirsch 2010",
    formula="∫ρ = M, u = Ω × (r − c), T = 0 for a load that turns; T = σ², stress ρ σ² δ for one that trembles",
    cost=1e6,
)
def fields() -> Evidence:
    """Fields of a hexagonal packing that turns about a center as one body, and of one whose velocities are drawn.

    Integrals: the sum over nodes two to a width, exp(−8 π²) but for the cut at three widths, 10⁻³. The cut leaves lumps
    of 10⁻² of a diameter's velocity, their square of Ω² w² for T, and that of a width for the center. Drawn velocities:
    what a node sees of 16 frames of 7 discs each, over some 40 independent places, five standard errors, 10 %.
    """
    turning, masses = _load(_CENTER)
    seen = measures.fields(turning, (0.0, 1.0), masses)
    x, y = np.meshgrid(seen.x, seen.y, indexing="ij")
    inner, cell = np.hypot(x, y) < _INNER, (seen.x[1] - seen.x[0]) ** 2
    lump = 1e-2 * _SPEED * seen.width
    exact = _SPEED * np.stack([_CENTER[1] - y, x - _CENTER[0]], axis=-1)
    center = measures.center_of_circulation(seen)
    packed = math.pi / (2.0 * math.sqrt(3.0))
    found = checks_at(
        ["∫ρ / M", "∫φ / ΣA", "solid fraction", "u, greatest error", "T / Ω²w²", "center, x", "center, y"],
        [1.0, 1.0, packed, 0.0, 0.0, *_CENTER],
        [
            seen.density.sum() * cell / masses.sum(),
            seen.solid_fraction.sum() * cell / (math.pi * _RADIUS**2 * len(masses)),
            seen.solid_fraction[inner].mean(),
            np.abs(seen.velocity - exact)[inner].max(),
            seen.fluctuation[inner].max() / (_SPEED * seen.width) ** 2,
            *center,
        ],
        [1e-3, 1e-3, 1e-3, lump, 1e-2, 1e-2 * seen.width, 1e-2 * seen.width],
    )
    found += _of_riders()
    draws = np.random.default_rng(4)
    velocities = draws.normal(0.0, _TREMBLE, turning.positions.shape)
    trembling, _ = _load(np.zeros(2), velocities=velocities)
    warm = measures.fields(trembling, (0.0, 1.0), masses)
    stress = (warm.kinetic_stress / _positive(warm.density)[..., np.newaxis, np.newaxis])[inner].mean(axis=0)
    expected = _TREMBLE**2 * np.eye(2)
    names = [f"σ_{a}{b}/ρ of drawn velocities" for a in "xy" for b in "xy"]
    found += checks_at(names, expected.ravel(), stress.ravel(), 0.1 * _TREMBLE**2, "m²/s²")
    warmth = float(warm.fluctuation[inner].mean())
    found.append(Check("T of drawn velocities", "m²/s²", _TREMBLE**2, warmth, 0.1 * _TREMBLE**2))
    row = len(seen.x) // 2
    line = inner[:, row]
    trace = Trace("", seen.x[line], seen.velocity[line, row, 1], (seen.x[line], exact[line, row, 1]))
    return Evidence(tuple(found), Panel("x [m]", "u_y [m/s]", (trace,)))


def _of_riders() -> list[Check]:
    """Return checks of a load that rides with the drum, two turns long."""
    angles = np.linspace(0.0, 2.0 * math.tau, 41)
    load = made_up.lattice(_RADIUS)
    places = np.array([load @ made_up.turned(angle) for angle in angles])
    speed = float(angles[1]) / made_up.INTERVAL
    velocities = _about(places, np.zeros(2), speed)
    riding = made_up.frames(places, _RADIUS, drum_angles=angles, velocities=velocities)
    relative = measures.fields(riding, (0.0, 1.0), np.ones(len(load)), relative=True)
    turns = measures.circulation(riding, (0.0, 1.0))
    there = np.abs(relative.velocity[np.isfinite(relative.velocity)]).max()
    return [
        Check("u seen from the drum", "m/s", 0.0, float(there), 1e-9 * speed),
        Check("circulation of riders", "1", 1.0, math.nan if turns is None else turns.value, 1e-12),
    ]


def _load(center: Array, **others: Any) -> tuple[Frames, Array]:
    """Return frames of packings, each turned and moved at random, that turn about a center; and masses."""
    draws = np.random.default_rng(3)
    count = len(made_up.lattice(_RADIUS)) - 20
    places = np.array([made_up.lattice(_RADIUS, draws)[:count] for _ in range(16)])
    velocities = {"velocities": _about(places, center, _SPEED), **others}
    return made_up.frames(places, _RADIUS, **velocities), np.full(count, _MASS)


def _about(places: Array, center: Array, speed: float) -> Array:
    apart = places - center
    velocities: Array = speed * np.stack([-apart[..., 1], apart[..., 0]], axis=-1)
    return velocities


def _positive(values: Array) -> Array:
    return np.where(values > 0.0, values, 1.0)


@case(
    "flowing-layer",
    source="a made-up profile",
    formula="u = u₀ + γ̇ (h − h₀) above, Ω h below: zero at h₀ − u₀/γ̇, kink where the two meet",
    cost=1e6,
)
def flowing_layer() -> Evidence:
    """A bed that turns as one body below a layer of uniform shear, on a slope: depths, velocities and slope of it.

    Bins are one diameter high: half of one for the depth, six tenths for thicknesses, 3 % of the velocity and of the
    slope in radians, half a percent of the core's.
    """
    disc, omega, slope = 0.02, 2.0, math.radians(25.0)
    surface, meeting, top = -0.25, -0.55, 3.0
    shear = (top - omega * meeting) / (surface - meeting)
    draws = np.random.default_rng(1)
    count = 4 * round(0.8 * 0.3425 * (2.0 / disc) ** 2)
    points = draws.uniform(-1.0, 1.0, (10 * count, 2))
    points = points[(np.hypot(*points.T) < 1.0) & (points[:, 1] < surface)][:count]
    along, height = points.T
    down = np.where(height > meeting, top + shear * (height - surface), omega * height)
    velocities = np.column_stack([-down, np.where(height > meeting, 0.0, omega * along)])
    step = made_up.INTERVAL / 10.0
    tilt = made_up.turned(slope)
    places = [(points + sign * 0.5 * step * velocities) @ tilt for sign in (-1.0, 1.0)]
    times = np.array([0.0, step])
    made: dict[str, Any] = {"times": times, "drum_angles": omega * times}
    seen = measures.flowing_layer(made_up.frames(places, 0.5 * disc, **made), (0.0, step))
    rows = [
        ("center_slope", "rad", slope, 0.03),
        ("bed_depth", "m", 1.0 + surface, 0.5 * disc),
        ("surface_velocity_ratio", "1", top / omega, 0.03 * top / omega),
        ("layer_thickness", "m", top / shear, 0.6 * disc),
        ("layer_to_solid_rotation", "m", surface - meeting, 0.6 * disc),
        ("core_velocity_ratio", "1", 1.0, 5e-3),
    ]
    found = [
        Check(name, unit, expected, seen[name].value, tolerance) for name, unit, expected, tolerance in rows
    ]
    trace = Trace("", [row[2] for row in rows], [check.measured for check in found], ([0.0, 1.5], [0.0, 1.5]))
    return Evidence(tuple(found), Panel("expected", "measured", (trace,)))


CASES = (fields, flowing_layer)
