"""Whole drums, judged by their own accounts: ledger, three powers, bounds, the finite time step."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drumrs import Config, Simulation, quantity
from drumrs.verification import scenes, theory
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at, shared_curve
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, TIME_STEP

Array = NDArray[np.float64]

# Bundles of a tenth of the drum's diameter: a whole drum of little work.
_LARGE = {"load.diameter": 0.0475, "run.time_step": 2.0 * TIME_STEP}
# What is stored, and where energy goes.
_STORED = (
    "kinetic_translation",
    "kinetic_rotation",
    "gravitational",
    "elastic_normal",
    "elastic_tangential",
    "elastic_rolling",
    "adhesion",
)
_LOST = (
    "dissipated_normal",
    "dissipated_sliding",
    "dissipated_tangential",
    "dissipated_rolling",
    "numerical",
)
_TERMS = {"rolling_friction": 0.2, "tangential_damping_ratio": 0.3, "adhesion": 4.0}


def _worlds() -> dict[str, Config]:
    """Return drums of every kind: fills, baffles, laws, programs, steps."""

    def world(changes: dict[str, Any], fill: float = 0.25, *, baffles: bool = False) -> Config:
        return scenes.drum({**_LARGE, **changes}, fill=fill, baffles=baffles)

    program = ((0.0, 0.0), (0.1, 54.0), (0.3, 54.0), (0.5, -54.0))
    return {
        "Table 1": scenes.drum(),
        "frictionless": world(scenes.both("friction", 0.0)),
        "clipped, 50 %": world(scenes.both("tension", "clipped"), 0.5, baffles=True),
        "75 %": world({}, 0.75),
        "overdamped": world(scenes.both("normal_damping", 4e4), baffles=True),
        "wash program": world({"rotation.program": program}, 0.4, baffles=True),
        "coarse step": world({"run.time_step": 3e-5}, baffles=True),
        "spins locked": world({"load.spin_locked": True}, baffles=True),
        "all terms": world(
            {k: v for term in _TERMS.items() for k, v in scenes.both(*term).items()}, baffles=True
        ),
    }


def _gross(run: Simulation) -> float:
    """Return the sum of all flows so far and of what is stored [J/m]: what round-off is a part of."""
    row = run.series.row(-1, named=True)
    return math.fsum(abs(row[name]) for name in (*_STORED, *_LOST, "drum_work"))


@case("ledger", source="identity of the leapfrog", formula="stored + lost = work + initial", cost=4e7)
def ledger() -> Evidence:
    """The energy ledger closes in drums of every kind, at any time step.

    Round-off: n ε of all flows and of what is stored over n steps, as if all of it went one way.
    """
    found, traces = [], []
    for name, config in _worlds().items():
        run = scenes.after(config, None, 0.5, samples=25)
        series = run.series
        stored, lost = (series.select(columns).to_numpy().sum(axis=1) for columns in (_STORED, _LOST))
        given = series["drum_work"].to_numpy() + stored[0]
        residual = float(np.abs(stored + lost - given).max()) / _gross(run)
        found.append(Check(f"residual, {name}", "1", 0.0, residual, run.step * theory.EPSILON))
        # From the least on, so that zero of the potential does not matter.
        traces.append(Trace(name, given - stored[0], stored + lost - stored[0]))
    given_all = np.concatenate([np.asarray(trace.x) for trace in traces])
    limits = [float(given_all.min()), float(given_all.max())]
    panel = Panel(
        "work of the drum [J/m]", "gain of stored + lost [J/m]", (shared_curve(limits, limits), *traces)
    )
    return Evidence(tuple(found), panel)


@case(
    "three-powers",
    source="energy and moment of momentum",
    formula="T Ω = dE/dt + losses = Ω (M g x + dL/dt)",
    cost=4e7,
)
def three_powers() -> Evidence:
    """Three ways to the drum's power agree in every window.

    Each is a difference of sums over a window: n ε of all flows and of what is stored, over the window's length.
    """
    found, traces, most = [], [], 0.0
    for name, config in _worlds().items():
        run = scenes.after(config, None, 0.5, samples=25)
        allowed = run.step * theory.EPSILON * _gross(run) / (run.time / 5.0)
        windows = [(k * run.time / 5.0, (k + 1) * run.time / 5.0) for k in range(5)]
        means = [run.summary(window) for window in windows]
        torque = np.array([mean.drum_power for mean in means])
        others = {
            "ledger": np.array([mean.energy_balance_power for mean in means]),
            "moments": np.array([mean.moment_balance_power for mean in means]),
        }
        for kind, power in others.items():
            names = [f"power by {kind}, {name}, fifth {k}" for k in range(1, 6)]
            found += checks_at(names, torque, power, allowed, "W/m")
        traces.append(Trace(name, np.tile(torque, 2), np.concatenate(list(others.values()))))
        most = max(most, float(np.abs(torque).max()))
    line = shared_curve([-most, most], [-most, most])
    panel = Panel("torque × Ω [W/m]", "by ledger, by moments [W/m]", (line, *traces))
    return Evidence(tuple(found), panel)


@case(
    "bounds",
    source="moment of gravity, at most M g R; second law",
    formula="0 ≤ P/(M g R Ω) ≤ 1, mean overlap < 1 % of r",
    cost=6e7,
)
def bounds() -> Evidence:
    """Power and overlap of steady drums lie where they must.

    Bounds: ½ ± ½ for the power over M g R Ω, which a steady load can neither exceed nor give back, and 0 … 0.01 for the
    mean of the greatest overlap over the radius: beyond, the stiffness does not serve.
    """
    # The highest fill does not fit beside baffles.
    fills = {False: (0.1, 0.25, 0.4, 0.5, 0.6, 0.75), True: (0.1, 0.25, 0.4, 0.5, 0.6)}
    found, traces = [], []
    for baffles, levels in fills.items():
        powers = []
        label = "3 baffles" if baffles else "no baffles"
        for fill in levels:
            run = scenes.after(scenes.drum(_LARGE, fill=fill, baffles=baffles), None, 1.5, samples=300)
            means = run.summary((0.5, run.time))
            power = means.drum_specific_power / (GRAVITY * DRUM_RADIUS * run.drum_angular_velocity)
            overlap = float(run.series["max_overlap_ratio"].to_numpy()[100:].mean())
            case_name = f"{label}, {100 * fill:.0f} % fill"
            found.append(Check(f"P/(M g R Ω), {case_name}", "1", 0.5, power, 0.5))
            found.append(Check(f"overlap/r, {case_name}", "1", 0.0, overlap, 0.01))
            powers.append(power)
        traces.append(Trace(label, levels, powers))
    frame = Trace("bounds", (), (), ([0.1, 0.75, 0.75, 0.1, 0.1], [0.0, 0.0, 1.0, 1.0, 0.0]))
    return Evidence(tuple(found), Panel("fill", "P / (M g R Ω)", (frame, *traces)))


@case("numerical-order", source="order of the scheme", formula="numerical column = O(Δt²)")
def numerical_order() -> Evidence:
    """The work that no formula accounts for, in the mean over head-on impacts, against the time step.

    Over three halvings it falls by 4³, an order of 2, to within what `restitution-order` allows.
    """
    steps, onsets = TIME_STEP / np.array([1.0, 2.0, 4.0, 8.0]), 400
    found, traces = [], []
    for restitution in (0.1, 0.5):
        shares = []
        for step in steps:
            changes = {"run.time_step": step, "contact.bundle.restitution": restitution}
            state = scenes.in_pairs(1.0, (1.0 + scenes.phases(onsets)) * step)
            run = scenes.after(scenes.free_space(changes), state, 1e-3)
            shares.append(abs(scenes.last(run, "numerical")) / onsets / (scenes.MASS / 4.0))
        order = math.log2(shares[0] / shares[-1]) / 3.0
        found.append(Check(f"order at e = {restitution}", "1", 2.0, order, theory.ORDER_ERROR))
        line = (steps, shares[0] * (steps / steps[0]) ** 2)
        traces.append(Trace(f"e = {restitution}", steps, np.array(shares), line))
    panel = Panel("time step [s]", "numerical / energy, lines: Δt²", tuple(traces), logarithmic=True)
    return Evidence(tuple(found), panel)


_MEANS = ("drum_specific_power", "dissipated_normal_power", "dissipated_sliding_power", "kinetic_energy")


@case("time-step", source="convergence", formula="means at Δt = means at Δt/2", cost=8e7)
def time_step() -> Evidence:
    """Halving the time step changes window means within their statistical error: eight seeds, 2 s of a soft drum.

    99.9 % of Student's t for the difference of two means of eight, from the scatter of the seeds.
    """
    from scipy import special

    soft = {
        "load.diameter": 0.0475,
        "contact.bundle.normal_stiffness": 3.7e6,
        "contact.drum.normal_stiffness": 3.88e6,
    }
    coarse, seeds = 3.7e-5, range(1, 9)
    means = {
        step: np.array(
            [_means(scenes.drum({**soft, "run.time_step": step, "run.seed": s}, fill=0.4)) for s in seeds]
        )
        for step in (coarse, coarse / 2.0)
    }
    one, other = means.values()
    errors = np.sqrt((one.var(axis=0, ddof=1) + other.var(axis=0, ddof=1)) / len(seeds))
    allowed = special.stdtrit(2 * (len(seeds) - 1), 0.9995) * errors
    names = [f"mean {quantity(name).title}" for name in _MEANS]
    found = checks_at(names, other.mean(axis=0), one.mean(axis=0), allowed, "W/kg, W/m or J/m")
    traces = tuple(
        Trace(f"Δt = {step:.2g} s", np.array(seeds), values[:, 0], ([1, 8], [values[:, 0].mean()] * 2))
        for step, values in means.items()
    )
    return Evidence(tuple(found), Panel("seed", f"{quantity(_MEANS[0]).label}, lines: means", traces))


def _means(config: Config) -> list[float]:
    """Return means over the last two thirds of 3 s."""
    run = scenes.after(config, None, 3.0, samples=300)
    summary = run.summary((1.0, run.time))
    return [float(getattr(summary, name)) for name in _MEANS]


CASES = (ledger, three_powers, bounds, numerical_order, time_step)
