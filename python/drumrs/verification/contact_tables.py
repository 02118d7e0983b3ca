"""Measures of the tables of contacts and walls: the spectrum of a disc that bounces, Finnie's function, a worn face."""

import math

import numpy as np
import polars as pl
from numpy.typing import NDArray

from drumrs import measures
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at

Array = NDArray[np.float64]

_BOUNCES, _MASS, _DURATION = 12, 2.0, 5.0
# Restitution by which lines are five bins of a tenth of a decade apart, and the first energy, in the middle of its bin.
_RESTITUTION, _FIRST = 10.0**-0.25, 10.0**-1.95


@case(
    "spectrum",
    source="geometric series",
    formula="lines at E₀ e²ᵏ, equal distances of 2 log₁₀(1/e); their sum E₀ (1 − e²ⁿ)/(1 − e²)",
    cost=1e5,
)
def spectrum() -> Evidence:
    """The spectrum of a disc that bounces: a line every fifth bin, each of one event, and what they take in all.

    Events are counted: no tolerance. Energies: round-off, 10⁻¹² of them.
    """
    energies = _FIRST * _RESTITUTION ** (2.0 * np.arange(_BOUNCES))
    contacts = pl.DataFrame(
        {
            "duration": np.where(np.arange(_BOUNCES) % 2, 1e-3, 5e-3),
            "particle": np.zeros(_BOUNCES, dtype=np.uint32),
            "other": [1, None] * (_BOUNCES // 2),
            "dissipated_normal": 0.75 * energies,
            "dissipated_tangential": 0.25 * energies,
            "dissipated_rolling": 0.0 * energies,
            "is_open": np.zeros(_BOUNCES, dtype=bool),
        }
    )
    seen = measures.collision_spectrum(contacts, _MASS, _DURATION)
    whole = _FIRST * (1.0 - _RESTITUTION ** (2.0 * _BOUNCES)) / (1.0 - _RESTITUTION**2)
    rate = 1.0 / (_MASS * _DURATION)
    lines = np.arange(len(seen)) % 5 == 0
    found = checks("events in bin {}", "1", lines.astype(float), seen["events"].to_numpy(), 0.0)
    found.append(Check("bins", "1", 5.0 * (_BOUNCES - 1) + 1.0, float(len(seen)), 0.0))
    low = seen["energy_low"].to_numpy()
    found += checks_at(
        ["least edge", "greatest edge", "power", "rate above the least edge", "share above the last bin"],
        [10.0 ** (-2.0 - 0.5 * (_BOUNCES - 1)), 10.0**-1.9, whole * rate, _BOUNCES * rate, _FIRST / whole],
        [
            low[0],
            seen["energy_high"][-1],
            seen["power"].sum(),
            seen["rate_above"][0],
            seen["share_above"][-1],
        ],
        1e-12,
    )
    for kind, share in (("normal", 0.75), ("tangential", 0.25), ("rolling", 0.0)):
        power = float(measures.collision_spectrum(contacts, _MASS, _DURATION, kind)["power"].sum())
        found.append(Check(f"power, {kind}", "W/kg", share * whole * rate, power, 1e-12))
    halves = (measures.impacts(contacts, 1e-3), measures.enduring(contacts, 1e-3))
    found += checks("contacts of kind {}", "1", _BOUNCES / 2.0, [float(len(half)) for half in halves], 0.0)
    # Half of the contacts are with a disc of a tenth of the mass, the others with the drum.
    light = measures.collision_spectrum(contacts, _MASS, _DURATION, masses=[1.0, 0.1])
    edges = light.filter(pl.col("events") > 0)["energy_low"].to_numpy()
    specific = np.sort(energies * np.where(np.arange(_BOUNCES) % 2, 1.0, 10.0))
    found += checks("E/m over its bin's lower edge, {}", "1", 10.0**0.05, specific / edges, 1e-12)
    trace = Trace(
        "", low[lines], seen["power"].to_numpy()[lines], (np.sort(energies), np.sort(energies) * rate)
    )
    return Evidence(tuple(found), Panel("energy [J/m]", "power [W/kg]", (trace,), logarithmic=True))


@case(
    "wear",
    source="Finnie 1960; geometry",
    formula="f(γ) = sin 2γ − 3 sin²γ, then ⅓ cos²γ; a face worn evenly moves by V/L",
    cost=1e5,
)
def wear() -> Evidence:
    """Finnie's function against its integral form, and a straight face that wears evenly, or linearly along it.

    f: half of the last digit of the published numbers; round-off where its two branches meet. Volumes, depths and the
    worn face: round-off.
    """
    meet, most = math.atan(1.0 / 3.0), math.radians(16.85)
    found = checks_at(
        ["f where branches meet", "f from below", "f at its greatest", "f at 90°", "f at 45°", "f at 0°"],
        [0.3, 0.3, 0.3028, 0.0, 1.0 / 6.0, 0.0],
        measures.finnie_f([meet, meet * (1.0 - 1e-14), most, 0.5 * math.pi, 0.25 * math.pi, 0.0]),
        [1e-12, 1e-12, 5e-5, 1e-12, 1e-12, 1e-12],
    )
    bins = 20
    middle = (np.arange(bins) + 0.5) / bins
    profile = pl.DataFrame(
        {
            "part": ["wall 1"] * bins,
            "arc_start": np.arange(bins) / bins,
            "arc_end": (np.arange(bins) + 1.0) / bins,
            "x": middle,
            "y": np.zeros(bins),
            "normal_x": np.zeros(bins),
            "normal_y": np.ones(bins),
            "normal_force_slip": 4.0 * middle,
            "finnie": np.ones(bins),
        }
    )
    archard = measures.wear(profile, coefficient=1e-3, turns=2.0)
    finnie = measures.wear(profile, "finnie", coefficient=1e-2)
    face = measures.worn_outline(archard, "wall 1", turns=3.0)
    depth = 1e-3 / 2.0 * 4.0 * middle * bins
    inner = slice(1, -1)
    found += [
        Check("volume, Archard", "m²", 1e-3 / 2.0 * 2.0 * bins, float(archard["wear_volume"].sum()), 1e-12),
        Check("volume, Finnie", "m²", 1e-2 * bins, float(finnie["wear_volume"].sum()), 1e-12),
        *checks("depth in bin {}", "m", depth, archard["wear_depth"].to_numpy(), 1e-12),
        *checks("relative wear in bin {}", "1", 2.0 * middle, archard["relative_wear"].to_numpy(), 1e-12),
        *checks("face after three turns, bin {}", "m", -3.0 * depth[inner], face[inner, 1], 1e-12),
    ]
    fine = np.linspace(0.0, 0.5 * math.pi, 400)
    curve = np.where(fine < meet, np.sin(2.0 * fine) - 3.0 * np.sin(fine) ** 2, np.cos(fine) ** 2 / 3.0)
    few = fine[::20]
    trace = Trace("", np.degrees(few), measures.finnie_f(few), (np.degrees(fine), curve))
    return Evidence(tuple(found), Panel("γ [°]", "f(γ)", (trace,)))


CASES = (spectrum, wear)
