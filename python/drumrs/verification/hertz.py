"""Hertz–Mindlin: greatest overlap, duration and restitution of an impact, at speeds a thousand times apart.

With Fₙ = k δ^{3/2} an elastic impact at v reaches δ = (5 m* v²/4 k)^{2/5} and lasts 2 δ/v ∫ dx/√(1 − x^{5/2}) from 0
to 1, 2.943 δ/v. Here k = 4/3 E* √R*/h, E* = E/2 (1 − ν²), and h is the diameter of the disc.
"""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Simulation
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at
from drumrs.verification.scenes import MASS, RADIUS

Array = NDArray[np.float64]

_YOUNG, _POISSON = 1e8, 0.25
_STIFFNESS = 4.0 / 3.0 * _YOUNG / (2.0 * (1.0 - _POISSON**2)) * math.sqrt(RADIUS) / (2.0 * RADIUS)
_SPEEDS = np.array([0.001, 0.01, 0.1, 1.0])
# 4/5 √π Γ(2/5)/Γ(9/10)
_DURATION = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9)
_STEPS, _ONSETS = 200, 100
# The phase that a step makes up of an impact, which takes π.
_PHASE = math.pi / _STEPS


def _deepest(speed: float | Array) -> Array:
    return np.asarray((1.25 * MASS * np.square(speed) / _STIFFNESS) ** 0.4)


def _impacts(speed: float, restitution: float, tension: str, samples: int = 1) -> Simulation:
    """Return impacts on the floor at a speed, one for each onset within a step."""
    step = _DURATION * float(_deepest(speed)) / speed / _STEPS
    law = {
        "young_modulus": _YOUNG,
        "poisson_ratio": _POISSON,
        "restitution": restitution,
        "tension": tension,
    }
    changes = {"contact.base": "hertz", "contact.bundle.young_modulus": _YOUNG, "run.time_step": step}
    changes |= {f"contact.drum.{key}": value for key, value in law.items()}
    config = scenes.floor({**changes, "run.frame_every": 1e4 * step})
    state = scenes.on_the_floor([0.0, -speed], (1.0 + scenes.phases(_ONSETS)) * step * speed)
    return scenes.after(config, state, 3.0 * _STEPS * step, samples=samples)


@case("hertz-impact", source="Hertz; derived", formula="δ = (5 m v²/4 k)^{2/5}, t = 2.943 δ/v, v' = v")
def hertz_impact() -> Evidence:
    """Elastic impact on a wall by Hertz's law, against its speed.

    A step is a two-hundredth of the contact, θ = π/200. The force grows from zero, so overlap, duration and speed are
    met within θ² as with a linear spring, and the duration, counted in steps, within θ/100 for the onsets.
    """
    found, drawn = [], []
    for speed in _SPEEDS.tolist():
        run = _impacts(speed, 1.0, "allowed", samples=3 * _STEPS)
        deep = float(run.series["max_overlap_ratio"].to_numpy().max()) * RADIUS / float(_deepest(speed))
        lasted = float(run.series["contact_count"].sum()) / _ONSETS / _STEPS
        allowed = _PHASE**2 + _PHASE / _ONSETS
        found += [
            Check(f"δ over Hertz's at {speed:g} m/s", "1", 1.0, deep, allowed),
            Check(f"t over 2.943 δ/v at {speed:g} m/s", "1", 1.0, lasted, allowed),
            Check(f"v'/v at {speed:g} m/s", "1", 1.0, float(run.velocities[:, 1].mean()) / speed, allowed),
        ]
        drawn.append(deep * float(_deepest(speed)))
    fine = np.geomspace(_SPEEDS[0], _SPEEDS[-1], 50)
    trace = Trace("", _SPEEDS, drawn, (fine, _deepest(fine)))
    return Evidence(tuple(found), Panel("speed [m/s]", "overlap [m]", (trace,), logarithmic=True))


@case(
    "hertz-restitution",
    source="Antypov & Elliott, EPL 94 (2011) 50004",
    formula="e as prescribed, at any speed; loss ½ m (1 − e²) v²",
)
def hertz_restitution() -> Evidence:
    """Restitution by Hertz's law with its damping, at any speed and with either tension.

    As `restitution-sweep`: θ² + θ/100 with the damping ratio, of speed and energy. Unlike with a linear dashpot the
    force starts at zero.
    """
    found, traces = [], []
    for tension in ("allowed", "clipped"):
        for restitution in (0.2, 0.5, 0.9):
            ratio = theory.damping_ratio(restitution, clipped=tension == "clipped")
            allowed = theory.mean_error(_PHASE, 1.0, _ONSETS, ratio)
            runs = [_impacts(speed, restitution, tension) for speed in _SPEEDS.tolist()]
            speeds = np.array([float(run.velocities[:, 1].mean()) for run in runs]) / _SPEEDS
            lost = np.array([scenes.last(run, "dissipated_normal") for run in runs])
            energy = 0.5 * MASS * _SPEEDS**2 * _ONSETS
            places = [f"at {speed:g} m/s, e = {restitution:g}, tension {tension}" for speed in _SPEEDS]
            found += checks_at([f"v'/v {place}" for place in places], restitution, speeds, allowed)
            losses = [f"loss/½ m v² {place}" for place in places]
            found += checks_at(losses, 1.0 - restitution**2, lost / energy, allowed)
            line = (_SPEEDS, np.full_like(_SPEEDS, restitution))
            traces.append(Trace(f"e = {restitution:g}, {tension}", _SPEEDS, speeds, line))
    panel = Panel("speed [m/s]", "speed after / before", tuple(traces), logarithmic=True)
    return Evidence(tuple(found), panel)


CASES = (hertz_impact, hertz_restitution)
