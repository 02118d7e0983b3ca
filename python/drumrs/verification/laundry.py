"""Measures of washing and drying, and of torque over frequency, on loads and signals of which they are known."""

import math

import numpy as np
import polars as pl

from drumrs import measures
from drumrs.verification import made_up
from drumrs.verification.case import case
from drumrs.verification.evidence import Check, Evidence, Panel, Trace, checks_at

_SPEED = 3.0


@case(
    "washing",
    source="geometry",
    formula="shape 4 π A/P²; openness of one disc 1, of one among six 0; curtain 2 n r / 2 R",
    cost=1e5,
)
def washing() -> Evidence:
    """Shape, openness and curtain of a few discs; how a load turns that rides with a drum.

    Outlines are polygons of 64 corners a disc: 0.2 % of a shape factor; a square has corners as round as a disc, and
    wavy edges, 1 %. Openness is counted in 72 directions, none at an edge, and the rest to round-off.
    """
    square = np.stack(np.meshgrid(np.arange(60.0), np.arange(60.0)), axis=-1).reshape(-1, 2)
    around = np.radians(60.0 * np.arange(6) + 2.0)
    six = np.vstack([np.zeros((1, 2)), 2.0 * np.column_stack([np.cos(around), np.sin(around)])])
    row = np.column_stack([np.array([-0.6, 0.2, -0.2, 0.6, 0.65]), np.array([0.0, 0.3, -0.3, 0.1, 0.2])])
    angles = _SPEED * made_up.INTERVAL * np.arange(50)
    load = made_up.lattice(0.08)[40:]
    riding = made_up.frames([load @ made_up.turned(angle) for angle in angles], 0.08, drum_angles=angles)
    seen = measures.washing(riding, (0.0, 1.0))
    distance = np.hypot(*load.T)
    step = 2.0 * math.sin(0.5 * _SPEED * made_up.INTERVAL) / made_up.INTERVAL
    split = pl.DataFrame(
        {
            "body": ["bundle", "bundle", "bundle"],
            "other": ["bundle", "rim", "baffle 1"],
            "dissipated_normal": [6.0, 2.0, 1.0],
            "dissipated_sliding": [4.0, 1.0, 0.5],
            "dissipated_tangential": [2.0, 0.0, 0.5],
        }
    )
    # Per mass 1, 1 and 4: of mean 2 and standard deviation √2.
    discs = pl.DataFrame(
        {"mass": [1.0, 2.0, 4.0], "received_normal": [1.0, 1.0, 15.0], "received_rolling": [0.0, 1.0, 1.0]}
    )
    power = measures.knocking_and_rubbing(split, mass=2.0, duration=3.0)
    rows = [
        ("shape of a disc", 1.0, measures.shape_factor([[0.0, 0.0]], [1.0]), 2e-3),
        ("shape of a square", _rounded(59.0, 2.0), measures.shape_factor(square, np.full(3600, 2.0)), 1e-2),
        ("openness of one", 1.0, measures.openness([[0.0, 0.0]], [1.0], 5.0), 0.0),
        ("openness of seven, half of six", 3.0 / 7.0, measures.openness(six, np.ones(7), 0.75), 1e-12),
        (
            "openness of two within reach",
            1.0 - 6.0 / 72.0,
            measures.openness(2.0 * six[:2], np.ones(2), 5.0),
            1e-12,
        ),
        (
            "openness of two hardly within",
            1.0 - 2.0 / 72.0,
            measures.openness(2.0 * six[:2], np.ones(2), 2.05),
            1e-12,
        ),
        (
            "curtain of five, two of them one behind the other",
            0.425,
            measures.curtain(row, np.full(5, 0.1), 1.0),
            1e-12,
        ),
        ("received_spread", 0.5 * math.sqrt(2.0), measures.received_spread(discs), 1e-12),
        ("center_turning", _SPEED, seen["center_turning"].value, 1e-9),
        ("disc_turning", _SPEED, seen["disc_turning"].value, 1e-9),
        ("moving_speed", step * distance.mean(), seen["moving_speed"].value, 1e-9),
        ("moving_spread", distance.std() / distance.mean(), seen["moving_spread"].value, 1e-9),
        ("axis_distance_spread", distance.std(), seen["axis_distance_spread"].value, 1e-9),
        ("knocking of the load", 1.0, power["load"][0], 1e-12),
        ("rubbing of the load", 1.0, power["load"][1], 1e-12),
        ("knocking at the drum", 0.5, power["drum"][0], 1e-12),
        ("rubbing at the drum", 1.0 / 3.0, power["drum"][1], 1e-12),
    ]
    found = tuple(Check(name, "1", expected, value, tolerance) for name, expected, value, tolerance in rows)
    expected, values = [check.expected for check in found], [check.measured for check in found]
    return Evidence(
        found, Panel("expected", "measured", (Trace("", expected, values, ([0.0, 3.0], [0.0, 3.0])),))
    )


def _rounded(side: float, radius: float) -> float:
    """Return the shape factor of a square with round corners, by its side without them."""
    area = side**2 + 4.0 * side * radius + math.pi * radius**2
    return 4.0 * math.pi * area / (4.0 * side + math.tau * radius) ** 2


@case(
    "frequency-spectrum",
    source="Parseval; a sine",
    formula="∫S df = variance; a line at n_b Ω/2π that holds a²/2; peak over rms √2",
    cost=1e5,
)
def frequency_spectrum() -> Evidence:
    """The spectrum of a torque that ripples with three baffles at 54 rpm, and of noise.

    Parseval: 10⁻¹² of the variance. The line: one bin of frequency, and what Hann's window leaves beyond three bins,
    10⁻³ of its power. The peak: half a step of the phase from the crest, squared.
    """
    rate, frequency, amplitude = 200.0, 3.0 * 54.0 / 60.0, 1.7
    time = np.arange(4001) / rate
    draws = np.random.default_rng(6)
    ripple = amplitude * np.sin(math.tau * frequency * time)
    series = pl.DataFrame(
        {"time": time, "drum_torque": ripple + 5.0, "ripple": ripple, "noise": draws.normal(size=4001)}
    )
    window = (0.0, float(time[-1]))
    found = []
    for column in ("drum_torque", "noise"):
        whole = measures.frequency_spectrum(series, column, window, segments=1, taper="boxcar")
        step = float(whole["frequency"][1])
        variance = float(np.var(series[column].to_numpy()[1:]))
        found.append(
            Check(f"∫S df of {column}", "1", variance, float(whole["density"].sum()) * step, 1e-12 * variance)
        )
    lines = measures.frequency_spectrum(series, "drum_torque", window)
    at, density = lines["frequency"].to_numpy(), lines["density"].to_numpy()
    step = float(at[1])
    near = np.abs(at - frequency) <= 3.0 * step
    found += checks_at(
        ["line [Hz]", "power of the line", "peak factor"],
        [frequency, 0.5 * amplitude**2, math.sqrt(2.0)],
        [at[density.argmax()], density[near].sum() * step, measures.peak_factor(series, "ripple", window)],
        [step, 1e-3 * amplitude**2, math.sqrt(2.0) * (math.pi * frequency / rate) ** 2],
    )
    trace = Trace("", at[1:], density[1:], ([frequency, frequency], [density[1:].min(), density.max()]))
    panel = Panel("frequency [Hz]", "density [(N m/m)²/Hz]", (trace,), logarithmic=True)
    return Evidence(tuple(found), panel)


CASES = (washing, frequency_spectrum)
