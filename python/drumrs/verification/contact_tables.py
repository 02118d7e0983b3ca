"""Measures of the tables of contacts and walls: the spectrum of a disc that bounces, Finnie's function, a worn face."""

import math

import numpy as np
import polars as pl
from numpy.typing import NDArray

from drumrs import State, measures
from drumrs.verification import scenes
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks, checks_at
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, MASS, RADIUS

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
            "opened": (np.arange(_BOUNCES) + 0.5) * _DURATION / _BOUNCES,
            "part": pl.Series([None, "rim"] * (_BOUNCES // 2), dtype=pl.Enum(["rim", "wall 1"])),
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
    # Every other one is short, and at the rim: the second, fourth … of the lines.
    rates = measures.impact_rates(contacts, (0.0, _DURATION), _MASS, 1e-3)
    short = _RESTITUTION**2 * whole / (1.0 + _RESTITUTION**2) * rate
    found += checks_at(
        ["impacts", "impacts on the drum", "what they take", "at the rim", "at a wall", "half of it above"],
        [_BOUNCES / 2.0 * rate, _BOUNCES / 2.0 * rate, short, short, 0.0, _FIRST * _RESTITUTION**2],
        [
            rates[name].value
            for name in (
                *("impact_rate", "drum_impact_rate", "impact_specific_power", "rim_impact_specific_power"),
                *("wall_1_impact_specific_power", "median_impact_energy"),
            )
        ],
        1e-12,
    )
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
            "part": pl.Series(["wall 1"] * bins, dtype=pl.Enum(["rim", "wall 1"])),
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
        *checks_at(
            [
                "Archard's sum in a turn",
                "Finnie's sum, wall 1",
                "Finnie's sum, rim",
                "greatest relative wear",
            ],
            [2.0 * bins / 2.0, bins / 2.0, 0.0, 2.0 * float(middle[-1])],
            [
                measures.wear_of_parts(profile, turns=2.0)[name]
                for name in ("archard_wear", "wall_1_finnie_wear", "rim_finnie_wear", "wear_peak")
            ],
            1e-12,
        ),
        *checks("depth in bin {}", "m", depth, archard["wear_depth"].to_numpy(), 1e-12),
        *checks("relative wear in bin {}", "1", 2.0 * middle, archard["relative_wear"].to_numpy(), 1e-12),
        *checks("face after three turns, bin {}", "m", -3.0 * depth[inner], face[inner, 1], 1e-12),
    ]
    fine = np.linspace(0.0, 0.5 * math.pi, 400)
    curve = np.where(fine < meet, np.sin(2.0 * fine) - 3.0 * np.sin(fine) ** 2, np.cos(fine) ** 2 / 3.0)
    few = fine[::20]
    trace = Trace("", np.degrees(few), measures.finnie_f(few), (np.degrees(fine), curve))
    return Evidence(tuple(found), Panel("γ [°]", "f(γ)", (trace,)))


@case(
    "wear-locked-disc",
    source="statics",
    formula="∫Fₙ ds = m g cos θ · R Ω t with tan θ = μ, even all round; μ ∫Fₙ ds = sliding = motor work",
    cost=2e6,
)
def wear_locked_disc() -> Evidence:
    """The wear of a smooth drum below a disc that may not spin, two turns long.

    The disc swings by the impulse of one step of sliding, see `spin-locked-disc`; of the drum's work the part that
    moves it is not sliding. A bin is left up to 16 steps late: that part of the time that it takes to pass one.
    """
    friction, speed, turns, step = 0.4, 5.0, 2.0, 1e-5
    angle, time = math.atan(friction), turns * math.tau / speed
    orbit = DRUM_RADIUS - RADIUS + MASS * GRAVITY * math.cos(angle) / scenes.WALL_STIFFNESS
    changes = {
        "rotation.rpm": speed * 30.0 / math.pi,
        "load.spin_locked": True,
        "contact.drum.friction": friction,
        "run.time_step": step,
        "run.record": ["wall_profile"],
    }
    state = State([[orbit * math.sin(angle), -orbit * math.cos(angle)]])
    run = scenes.after(scenes.drum(changes), state, time, samples=10)
    worn = measures.wear(run.result().wall_profile, turns=turns)
    series = run.series
    weight = MASS * GRAVITY * math.cos(angle)
    swing = GRAVITY * math.sin(angle) * step / math.sqrt(GRAVITY * orbit / math.cos(angle))
    moved = swing * orbit / (DRUM_RADIUS * speed * time) + step / time
    whole = weight * math.tau * DRUM_RADIUS
    late = 2.0 * 16.0 * step * speed * len(worn) / math.tau
    volume = float(worn["wear_volume"].sum())
    rubbed = friction * turns * volume
    found = [
        Check("∫Fₙ ds in a turn / 2π R m g cos θ", "1", 1.0, volume / whole, swing + moved),
        *checks("relative wear in bin {}", "1", 1.0, worn["relative_wear"].to_numpy(), late),
        *(
            Check(
                f"{column} / μ ∫Fₙ ds",
                "1",
                1.0,
                float(series[column][-1]) / rubbed,
                moved + swing,
            )
            for column in ("dissipated_sliding", "drum_work")
        ),
    ]
    arc = worn["arc_start"].to_numpy()
    trace = Trace("", arc, worn["relative_wear"].to_numpy(), (arc, np.ones(len(arc))))
    return Evidence(tuple(found), Panel("arc [m]", "relative wear", (trace,)))


@case(
    "contact-sums",
    source="identity",
    formula="Σ over contacts = ledger, for normal and tangential damping with sliding",
    cost=2e6,
)
def contact_sums() -> Evidence:
    """What all contacts of a thrown load with baffles have taken, added up one by one, and by spectra.

    Round-off: 10⁻¹² of the sum of magnitudes.
    """
    config = scenes.drum({"load.start_speed": 1.0, "run.record": ["contacts"]}, baffles=True).softer(100.0)
    run = scenes.after(config, None, 0.1, samples=10)
    result = run.result()
    missing = measures.sum_rule(result.contacts, result.dissipated)
    found = [Check(f"missing, {name}", "1", 0.0, value, 1e-12) for name, value in missing.items()]
    taken = sum((result.dissipated or {}).values())
    seen = measures.collision_spectrum(result.contacts, 1.0, 1.0)
    found.append(Check("power in the spectrum / ledger", "1", 1.0, float(seen["power"].sum()) / taken, 1e-12))
    low = seen["energy_low"].to_numpy()
    trace = Trace("", low, seen["rate_above"].to_numpy(), (low, seen["rate_above"].to_numpy()))
    return Evidence(tuple(found), Panel("energy [J/m]", "contacts above", (trace,), logarithmic=True))


CASES = (spectrum, wear, wear_locked_disc, contact_sums)
