"""One contact along its normal, linear spring and dashpot: restitution, duration, losses, order of the scheme."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import (
    Check,
    Evidence,
    Panel,
    Trace,
    checks_at,
    shared_curve,
)
from drumrs.verification.scenes import MASS, PAIR_FREQUENCY, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_ONSETS = 400
_STEP = TIME_STEP / 4.0
_RATIOS = np.array([0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.7, 0.8, 0.9])
_FINE = np.linspace(0.005, 0.93, 200)
_PAPER = "Park & Wassgren, Eq. 1"
_SCHWAGER = "Schwager & Pöschel, Granular Matter 9 (2007) 465"


def _rebounds(changes: dict[str, object], step: float) -> Array:
    """Return the speeds after head-on impacts on the floor at 1 m/s, one for each onset within the step."""
    config = scenes.floor({"run.time_step": step, **changes})
    state = scenes.on_the_floor([0.0, -1.0], (1.0 + scenes.phases(_ONSETS)) * step)
    return np.asarray(scenes.after(config, state, 4e-4 + 8.0 * math.pi / WALL_FREQUENCY).velocities[:, 1])


def _mean_rebound(changes: dict[str, object], step: float = _STEP) -> float:
    return float(_rebounds(changes, step).mean())


def _allowed(ratio: float = 0.0) -> float:
    return theory.mean_error(WALL_FREQUENCY, _STEP, _ONSETS, ratio)


_ALLOWED = [_allowed(z) for z in _RATIOS]


@case("restitution-tension", source=f"{_PAPER}; {_SCHWAGER}", formula="e = exp(−π z/√(1 − z²))")
def restitution_with_tension() -> Evidence:
    """Restitution where the dashpot may pull, against the damping ratio.

    Mean over 400 onsets at a quarter of Table 1's time step: θ² + θ/400 of the speed.
    """
    measured = [_mean_rebound(scenes.damping(z)) for z in _RATIOS]
    expected = theory.free_restitution(_RATIOS)
    found = checks_at([f"e at z = {z:g}" for z in _RATIOS], expected, measured, _ALLOWED)
    curve = (_FINE, theory.free_restitution(_FINE))
    return Evidence(
        tuple(found), Panel("damping ratio z", "restitution e", (Trace("", _RATIOS, measured, curve),))
    )


@case("restitution-clipped", source=_SCHWAGER, formula="e = exp(−(z/√(1 − z²)) (π − 2 asin z))")
def restitution_clipped() -> Evidence:
    """Restitution where tension is clipped at zero, against the damping ratio.

    Mean over 400 onsets at a quarter of Table 1's time step: θ² + θ/400 of the speed.
    """
    clip = {"contact.drum.tension": "clipped"}
    measured = [_mean_rebound({**scenes.damping(z), **clip}) for z in _RATIOS]
    expected = theory.clipped_restitution(_RATIOS)
    found = checks_at([f"e at z = {z:g}" for z in _RATIOS], expected, measured, _ALLOWED)
    curve = (_FINE, theory.clipped_restitution(_FINE))
    return Evidence(
        tuple(found), Panel("damping ratio z", "restitution e", (Trace("", _RATIOS, measured, curve),))
    )


@case("contact-duration", source=f"{_PAPER}; {_SCHWAGER}", formula="t = π/(ω₀ √(1 − z²))")
def contact_duration() -> Evidence:
    """Duration of a contact where the dashpot may pull.

    Steps in contact, counted, times the step: the mean over 400 onsets is met within θ² + θ/400 of the duration.
    """
    measured = []
    for ratio in _RATIOS:
        config = scenes.floor({"run.time_step": _STEP, **scenes.damping(ratio)})
        state = scenes.on_the_floor([0.0, -1.0], (1.0 + scenes.phases(_ONSETS)) * _STEP)
        length = 3.0 * math.pi / WALL_FREQUENCY
        run = scenes.after(config, state, length, samples=math.ceil(length / _STEP))
        measured.append(float(run.series["contact_count"].sum()) * _STEP / _ONSETS * WALL_FREQUENCY)
    duration = math.pi / np.sqrt(1.0 - _RATIOS**2)
    found = checks_at(
        [f"ω₀ t at z = {z:g}" for z in _RATIOS], duration, measured, np.array(_ALLOWED) * duration
    )
    curve = (_FINE, math.pi / np.sqrt(1.0 - _FINE**2))
    return Evidence(
        tuple(found), Panel("damping ratio z", "duration ω₀ t", (Trace("", _RATIOS, measured, curve),))
    )


@case("restitution-order", source="order of the scheme", formula="⟨e⟩ − e = O(Δt²)")
def restitution_order() -> Evidence:
    """Error of the mean restitution against the time step, at e = 0.1 and 0.5.

    Over three halvings the error falls by 4³, an order of 2. What 400 onsets leave, θ/400, is a tenth of the smallest
    error, log₂(1.1)/3 of the order; the number of steps in a contact changes with the step, and the coefficient with
    it, by half at most, log₂(1.5)/3.
    """
    steps = TIME_STEP / np.array([1.0, 2.0, 4.0, 8.0])
    traces, found = [], []
    for restitution in (0.1, 0.5):
        changes: dict[str, object] = {"contact.drum.restitution": restitution}
        errors = np.array([abs(_mean_rebound(changes, step) - restitution) for step in steps])
        order = math.log2(errors[0] / errors[-1]) / 3.0
        found.append(Check(f"order at e = {restitution}", "1", 2.0, order, theory.ORDER_ERROR))
        line = (steps, errors[0] * (steps / steps[0]) ** 2)
        traces.append(Trace(f"e = {restitution}", steps, errors, line))
    return Evidence(
        tuple(found), Panel("time step [s]", "error of ⟨e⟩, lines: Δt²", tuple(traces), logarithmic=True)
    )


@case("gross-work", source="energy balance", formula="½ m* v² (1 + 2 e_c² − e²), clipped ½ m* v² (1 + e_c²)")
def gross_work() -> Evidence:
    """Gross work along the normal in a head-on impact on the floor, ∫ |F v| dt, against the damping ratio.

    The energy of the approach goes in; that of the rebound up to where the force vanishes, e_c² of it, comes out, e_c
    being the restitution of the clipped law; where the dashpot may pull, it then takes e_c² − e². Each of the three is
    met as well as the square of a speed: within 2 (θ² + θ/400) of the energy of the approach.
    """
    clipped = theory.clipped_restitution(_FINE) ** 2
    curves = {
        "allowed": 1.0 + 2.0 * clipped - theory.free_restitution(_FINE) ** 2,
        "clipped": 1.0 + clipped,
    }
    traces, found = [], []
    for tension, curve in curves.items():
        measured = []
        for ratio in _RATIOS:
            changes = {"run.record": ["gross_work"], "contact.drum.tension": tension, **scenes.damping(ratio)}
            config = scenes.floor({"run.time_step": _STEP, **changes})
            state = scenes.on_the_floor([0.0, -1.0], (1.0 + scenes.phases(_ONSETS)) * _STEP)
            run = scenes.after(config, state, 4e-4 + 8.0 * math.pi / WALL_FREQUENCY)
            measured.append(scenes.last(run, "gross_work_normal") / _ONSETS / (0.5 * MASS))
        expected = np.interp(_RATIOS, _FINE, curve)
        allowed = 6.0 * np.array(_ALLOWED)
        found += checks_at([f"at z = {z:g}, tension {tension}" for z in _RATIOS], expected, measured, allowed)
        traces.append(Trace(f"tension {tension}", _RATIOS, measured, (_FINE, curve)))
    return Evidence(tuple(found), Panel("damping ratio z", "gross work / ½ m* v²", tuple(traces)))


@case("normal-dissipation", source="energy balance", formula="½ m* (1 − e²) v²")
def normal_dissipation() -> Evidence:
    """Energy that the dashpot takes in a head-on impact of two bundles.

    Mean over 400 onsets at a quarter of Table 1's time step: θ² + θ/400 of the energy of the approach.
    """
    restitutions = np.array([0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0])
    scale = 0.5 * (MASS / 2.0)
    traces, found = [], []
    for tension in ("allowed", "clipped"):
        measured, allowed = [], []
        for restitution in restitutions:
            law = {"contact.bundle.restitution": restitution, "contact.bundle.tension": tension}
            state = scenes.in_pairs(1.0, (1.0 + scenes.phases(_ONSETS)) * _STEP)
            run = scenes.after(scenes.free_space({"run.time_step": _STEP, **law}), state, 1e-3)
            measured.append(scenes.last(run, "dissipated_normal") / _ONSETS / scale)
            ratio = theory.damping_ratio(restitution, clipped=tension == "clipped")
            allowed.append(theory.mean_error(PAIR_FREQUENCY, _STEP, _ONSETS, ratio))
        places = [f"loss at e = {e:g}, tension {tension}" for e in restitutions]
        found += checks_at(places, 1.0 - restitutions**2, measured, allowed)
        traces.append(Trace(f"tension {tension}", restitutions, measured))
    fine = np.linspace(0.05, 1.0, 100)
    return Evidence(
        tuple(found), Panel("restitution e", "loss / ½ m* v²", (shared_curve(fine, 1.0 - fine**2), *traces))
    )


CASES = (
    restitution_with_tension,
    restitution_clipped,
    contact_duration,
    restitution_order,
    normal_dissipation,
    gross_work,
)
