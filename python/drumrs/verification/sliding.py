"""One contact along its tangent: friction in gross sliding, the tangential period, conservation."""

import math

import numpy as np
from numpy.typing import NDArray

from drumrs import Simulation, State
from drumrs.verification import scenes, theory
from drumrs.verification.advance import advance
from drumrs.verification.case import case
from drumrs.verification.evidence import Evidence, Panel, Trace, checks, checks_at, vanishing
from drumrs.verification.scenes import MASS, RADIUS, TIME_STEP, WALL_FREQUENCY

Array = NDArray[np.float64]

_ONSETS = 400
_STEP = TIME_STEP / 4.0
_SCHWAGER = "Schwager & Pöschel, Granular Matter 9 (2007) 465"
_FRICTIONS = np.array([0.02, 0.05, 0.1, 0.2, 0.35, 0.5])
_CLOSING, _SLIDING = 0.05, 20.0


def _gross_sliding(tension: str) -> Evidence:
    """Return oblique impacts in gross sliding, at several frictions."""
    ratio = theory.damping_ratio(0.1)
    clipped, free = float(theory.clipped_restitution(ratio)), float(theory.free_restitution(ratio))
    factor = 1.0 + clipped if tension == "clipped" else 1.0 + 2.0 * clipped - free
    seen = np.array([_slid(friction, ratio, tension) for friction in _FRICTIONS])
    change = _FRICTIONS * factor * _CLOSING
    expected = np.column_stack([change, 2.0 * change, change * (_SLIDING - 1.5 * change)])
    # Until the tangential spring is stretched, 2 z² μ vₙ/vₜ of the impulse is lacking.
    late = 2.0 * ratio**2 * _FRICTIONS * _CLOSING / _SLIDING
    speeds = (
        theory.mean_error(WALL_FREQUENCY, _STEP, _ONSETS, ratio) + late + _CLOSING / WALL_FREQUENCY / RADIUS
    )
    # Of the steps in which they meet and part, half a step of the dashpot's force is charged at half and at none.
    ends = 0.5 + (free if tension == "allowed" else 0.0)
    losses = speeds + ends * ratio * WALL_FREQUENCY * _STEP * _FRICTIONS
    allowed = np.column_stack([speeds, speeds, losses])
    scale = np.array([_CLOSING, 2.0 * _CLOSING, _CLOSING * _SLIDING])
    names = [
        f"{quantity} at μ = {friction:g}"
        for friction in _FRICTIONS
        for quantity in ("change of vₜ/vₙ", "change of r ω/vₙ", "loss/(m vₙ vₜ)")
    ]
    found = checks_at(names, expected / scale, seen / scale, allowed)
    line = np.array([0.0, _FRICTIONS[-1]])
    panel = Panel(
        "friction μ",
        "change / vₙ",
        (
            Trace("vₜ", _FRICTIONS, seen[:, 0] / _CLOSING, (line, line * factor)),
            Trace("r ω", _FRICTIONS, seen[:, 1] / _CLOSING, (line, 2.0 * line * factor)),
        ),
    )
    return Evidence(tuple(found), panel)


def _slid(friction: float, ratio: float, tension: str) -> tuple[float, float, float]:
    """Return the losses of vₜ and of r ω [m/s], and of energy over mass [m²/s²], in one impact."""
    law = {"contact.drum.friction": friction, "contact.drum.tension": tension}
    config = scenes.floor({"run.time_step": _STEP, **scenes.damping(ratio), **law})
    gaps = (1.0 + scenes.phases(_ONSETS)) * _STEP * _CLOSING
    run = scenes.after(config, scenes.on_the_floor([_SLIDING, -_CLOSING], gaps), 1e-3)
    slowed = _SLIDING - float(run.velocities[:, 0].mean())
    spun = -RADIUS * float(run.angular_velocities.mean())
    return slowed, spun, scenes.last(run, "dissipated_sliding") / _ONSETS / MASS


_SLIDES = "vₜ' = vₜ − {0}, ω' = 2 {0}/r, loss m {0} (vₜ − (3/2) {0})"


@case(
    "sliding-impact-clipped",
    source=f"impulse balance; {_SCHWAGER}",
    formula=_SLIDES.format("μ (1 + e) vₙ"),
)
def sliding_impact_clipped() -> Evidence:
    """Oblique impact in gross sliding, tension clipped.

    Mean over 400 onsets: θ² + θ/400 of vₙ, δ/r for the lever arm, and 2 z² μ vₙ/vₜ for the slip in which the
    dashpot's first force stretches the tangential spring. The loss is charged at the mean of the forces before and
    after a step, over the part of it in contact. Where bodies meet, the dashpot's force jumps to 2 z ω₀ m vₙ, so that
    of half a step on average half is charged, and ½ z θ μ of m vₙ vₜ goes to the numerical column.
    """
    return _gross_sliding("clipped")


@case(
    "sliding-impact-tension",
    source=f"impulse balance; {_SCHWAGER}",
    formula=_SLIDES.format("μ (1 + 2 e⁺ − e) vₙ"),
)
def sliding_impact_with_tension() -> Evidence:
    """Oblique impact in gross sliding where the dashpot may pull: friction acts on |Fₙ| then too.

    As with tension clipped; e⁺ is the clipped restitution of the same dashpot. Where bodies part the force is still
    e times what it was when they met, and half a step of it is not charged: e z θ μ more of the loss.
    """
    return _gross_sliding("allowed")


@case("equal-periods", source="derived: a disc's tangential mass is m/3", formula="s'/s = cos(π √(3 kₛ/kₙ))")
def equal_periods() -> Evidence:
    """Slip after an elastic impact that sticks, against kₛ/kₙ: turned round at 1/3, where both periods are equal.

    The tangential spring swings by the phase φ = π √(3 kₛ/kₙ). Its own step has the phase θ √(3 kₛ/kₙ), so φ is off
    by φ (θ² + δ/r), and the end of the contact within a step leaves θ √(3 kₛ/kₙ)/400 in the mean over onsets.
    """
    ratios = np.array([0.02, 0.08, 0.15, 0.25, 1.0 / 3.0, 0.5, 0.7, 1.0, 1.3])
    closing, slip = 0.01, 0.01
    measured = []
    for ratio in ratios:
        law = {"restitution": 1.0, "friction": 1e6, "stiffness_ratio": ratio}
        changes = {f"contact.drum.{key}": value for key, value in law.items()}
        config = scenes.floor({"run.time_step": _STEP, **changes})
        gaps = (1.0 + scenes.phases(_ONSETS)) * _STEP * closing
        run = scenes.after(config, scenes.on_the_floor([slip, -closing], gaps), 6e-4)
        after = run.velocities[:, 0] + RADIUS * run.angular_velocities
        measured.append(float(after.mean()) / slip)
    swing = np.sqrt(3.0 * ratios)
    phase = WALL_FREQUENCY * _STEP * swing
    allowed = math.pi * swing * (phase**2 + closing / WALL_FREQUENCY / RADIUS) + phase / _ONSETS
    places = [f"s'/s at kₛ/kₙ = {ratio:.3g}" for ratio in ratios]
    found = checks_at(places, np.cos(math.pi * swing), measured, allowed)
    fine = np.linspace(0.0, 1.35, 200)
    curve = (fine, np.cos(math.pi * np.sqrt(3.0 * fine)))
    return Evidence(
        tuple(found), Panel("kₛ/kₙ", "slip after / before", (Trace("", ratios, measured, curve),))
    )


@case("conservation", source="Newton's third law", formula="Σ m v and Σ (m x × v + I ω) stay")
def conservation() -> Evidence:
    """Momentum and angular momentum in oblique impacts of two discs, equal and unequal, with spins.

    Round-off: n ε of the sums of magnitudes, n the number of steps.
    """
    steps, found = 2000, []
    allowed, sizes = steps * theory.EPSILON, []
    for other in (1.0, 0.4):
        for spins in ((0.0, 0.0), (50.0, -20.0), (-300.0, 100.0)):
            change = _change_of_momenta(other, spins, steps)
            place = f"radii 1:{other:g}, spins {spins[0]:g} and {spins[1]:g} rad/s"
            found += checks(f"change of momentum {{}}, {place}", "1", 0.0, change, allowed)
            sizes.append(change / allowed)
    impact = np.arange(1, len(sizes) + 1)
    names = ("momentum along x", "momentum along y", "angular momentum")
    traces = [Trace(name, impact, np.array(sizes)[:, k]) for k, name in enumerate(names)]
    return Evidence(tuple(found), vanishing("impact", traces))


def _change_of_momenta(other: float, spins: tuple[float, float], steps: int) -> Array:
    """Return what an impact changes of momentum (x, y) and angular momentum, over the sums of magnitudes."""
    reach = RADIUS * (1.0 + other)
    state = State(
        positions=[[0.1, 0.1], [0.1 + 1.001 * reach * math.cos(0.3), 0.1 + 1.001 * reach * math.sin(0.3)]],
        velocities=[[0.7, -0.2], [-0.6, 0.3]],
        angular_velocities=spins,
        radii=[RADIUS, other * RADIUS],
    )
    config = scenes.free_space({"run.time_step": _STEP})
    run = scenes.after(config, state, 0.0, samples=1)
    before, scale = _momenta(run)
    advance(run, steps)
    after, _ = _momenta(run)
    return (after - before) / scale


def _momenta(run: Simulation) -> tuple[Array, Array]:
    """Return momentum (x, y) and angular momentum, and the sums of their parts' magnitudes."""
    mass, place, velocity = run.masses[:, None], run.positions, run.velocities
    inertia = run.masses * run.radii**2 / 2.0
    orbital = run.masses * (place[:, 0] * velocity[:, 1] - place[:, 1] * velocity[:, 0])
    parts = np.column_stack([mass * velocity, orbital + inertia * run.angular_velocities])
    return parts.sum(axis=0), np.abs(parts).sum(axis=0)


CASES = (sliding_impact_clipped, sliding_impact_with_tension, equal_periods, conservation)
