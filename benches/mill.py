"""Compare the net power with what mill engineers use: the segment form of Hogg and Fuerstenau.

Over fill and speed from the kept table of the paper's study, over the drum's size from runs of our own in which lengths
are multiplied by 4 and times by 2. Writes docs/verification/mill.parquet and mill.png.
"""

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl

import drumrs
from drumrs import analysis
from drumrs.figures import write
from drumrs.figures.shared import drumrs_style
from drumrs.paper.drums import BAFFLED, BARE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

GRAVITY = 9.81
# Area fraction of discs in a bed, near that of random close packing in two dimensions.
BED = 0.84
# The angle of the segment is taken from fills up to here.
FITTED_FILL = 0.40
SPEED_FILL = 0.25
TABLE_1 = drumrs.baseline()
DRUMS = {0: "bare", 3: "three baffles"}
SIZES = 3
WINDOW = (4.0, 10.0)


def segment_lever(fill: float, bed: float = BED) -> float:
    """Return the lever arm of a segment over the drum's radius, for a bed that stands upright (sin α = 1).

    A segment of half-angle θ fills J = (θ − sin θ cos θ) / π of the drum and has its center of mass (2/3) sin³θ / (π J)
    radii from the axis. With the bed's density ρ_b and M = ρ_b π R² J, the torque M g R lever sin α is
    (2/3) ρ_b g R³ sin³θ sin α: Hogg and Fuerstenau, Trans. SME-AIME 252 (1972) 418.

    Examples
    --------
    >>> round(segment_lever(0.42), 6) == round(4.0 / (3.0 * math.pi), 6)
    True
    >>> segment_lever(0.84)
    0.0
    """
    filled = fill / bed
    if filled >= 1.0:
        return 0.0
    low, high = 0.0, math.pi
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle - math.sin(middle) * math.cos(middle) < math.pi * filled:
            low = middle
        else:
            high = middle
    return 2.0 / 3.0 * math.sin(low) ** 3 / (math.pi * filled)


def of_study(path: Path) -> Iterator[dict[str, Any]]:
    """Yield means over seeds of P / (M g R Ω) against fill and against speed, from the study's table."""
    table = pl.read_parquet(path).filter(
        (BARE.rows | BAFFLED.rows)
        & (pl.col("contact.bundle.friction") == TABLE_1.contact.bundle.friction)
        & (pl.col("contact.bundle.restitution") == TABLE_1.contact.bundle.restitution)
        & (pl.col("load.diameter") == TABLE_1.load.diameter)
    )
    over_fill = table.filter(pl.col("rotation.rpm") == TABLE_1.rotation.rpm)
    over_speed = table.filter(pl.col("load.fill") == SPEED_FILL)
    for kind, rows in (("fill", over_fill), ("speed", over_speed)):
        keys = ["drum.baffles.count", "fill", "rotation.rpm", "drum.diameter"]
        for (baffles, fill, rpm, diameter), seeds in rows.sort(keys).group_by(keys, maintain_order=True):
            values, errors = (
                seeds["drum_specific_power"].to_list(),
                seeds["drum_specific_power_error"].to_list(),
            )
            power = analysis.estimate(values, errors)
            scale = GRAVITY * diameter / 2.0 * rpm * math.pi / 30.0
            row = {"kind": kind, "baffles": baffles, "fill": fill, "rpm": rpm, "diameter": diameter}
            yield row | {"lever": power.mean / scale, "half_width": power.interval().half_width / scale}


def scaled(factor: int) -> tuple[drumrs.Config, float]:
    """Return Table 1's drum with lengths times 4, times times 2, so often as `factor` says; and the length's factor.

    Gravity and density stay, so stiffness goes with the weight over the length.
    """
    length, time = 4.0**factor, 2.0**factor
    law = TABLE_1.contact
    return TABLE_1.replace(
        {
            "drum.diameter": TABLE_1.drum.diameter * length,
            "load.diameter": TABLE_1.load.diameter * length,
            "load.count": TABLE_1.bundle_count,
            "rotation.rpm": (TABLE_1.rotation.rpm or 0.0) / time,
            "contact.bundle.normal_stiffness": law.bundle.normal_stiffness * length,
            "contact.drum.normal_stiffness": law.drum.normal_stiffness * length,
            "run.time_step": float(TABLE_1.run.time_step) * time,
            "run.sample_every": TABLE_1.run.sample_every * time,
            "run.frame_every": WINDOW[1] * time,
            "run.duration": WINDOW[1] * time,
            "run.window": (WINDOW[0] * time, WINDOW[1] * time),
        }
    ), length


def of_sizes() -> Iterator[dict[str, Any]]:
    """Yield the power of drums of three sizes, from one start scaled."""
    start = drumrs.Simulation(scaled(0)[0]).positions
    ends: list[NDArray[np.float64]] = []
    for factor in range(SIZES):
        config, length = scaled(factor)
        simulation = drumrs.Simulation(config, state=drumrs.State(positions=start * length))
        simulation.run()
        ends.append(simulation.positions / length)
        if not np.array_equal(ends[0], ends[-1]):
            raise SystemExit(f"a drum that is {length:g} times as large does not move in the same way")
        power = simulation.summary().drum_power
        rpm, diameter, derived = config.rotation.rpm or 0.0, config.drum.diameter, config.derived
        weight = derived.load_mass * GRAVITY * diameter / 2.0 * (derived.angular_velocity or 0.0)
        row = {"kind": "size", "baffles": 0, "fill": TABLE_1.load.fill, "rpm": rpm, "diameter": diameter}
        yield row | {"lever": power / weight, "half_width": 0.0, "power": power}


def sine_of(rows: Sequence[dict[str, Any]], baffles: int) -> float:
    """Return sin α of a drum: the mean over the smaller fills of the power over the segment form's."""
    chosen = [
        r for r in rows if r["kind"] == "fill" and r["baffles"] == baffles and r["fill"] < FITTED_FILL + 0.01
    ]
    return float(np.mean([row["lever"] / segment_lever(row["fill"]) for row in chosen]))


def draw(rows: Sequence[dict[str, Any]]) -> "Figure":
    """Draw power against fill, speed and size."""
    from matplotlib.figure import Figure

    with drumrs_style():
        figure = Figure(figsize=(10.0, 3.6))
        axes = figure.subplots(1, 3)
        for baffles, name in DRUMS.items():
            sine = sine_of(rows, baffles)
            angle = math.degrees(math.asin(sine))
            color = f"C{list(DRUMS).index(baffles)}"
            fills = np.linspace(0.02, BED, 200)
            form = [segment_lever(fill) * sine for fill in fills]
            axes[0].plot(100.0 * fills, form, color=color, label=f"segment, α = {angle:.0f}°")
            _points(
                axes[0], [r for r in rows if r["kind"] == "fill" and r["baffles"] == baffles], name, color
            )
            axes[1].axhline(segment_lever(SPEED_FILL) * sine, color=color)
            _points(
                axes[1], [r for r in rows if r["kind"] == "speed" and r["baffles"] == baffles], name, color
            )
        sizes = [r for r in rows if r["kind"] == "size"]
        diameters = np.array([row["diameter"] for row in sizes])
        powers = np.array([row["power"] for row in sizes])
        axes[2].plot(diameters, powers[0] * (diameters / diameters[0]) ** 2.5, color="C0", label="∝ D^2.5")
        axes[2].plot(diameters, powers, "o", mfc="none", color="C0", label="bare, lengths × 4")
        label = "Power / (M g R Ω)"
        axes[0].set(xlabel="Fill [%]", ylabel=label, ylim=(0.0, None), title="54 rpm")
        axes[1].set(xlabel="Speed over critical speed", ylabel=label, ylim=(0.0, None), title="25 % fill")
        axes[2].set(xlabel="Drum diameter [m]", ylabel="Drum power [W/m]", xscale="log", yscale="log")
        axes[2].set_title("25 % fill, one Froude number and d/R")
        axes[2].set_xticks(diameters, [f"{diameter:g}" for diameter in diameters])
        axes[2].minorticks_off()
        for panel in (axes[0], axes[2]):
            panel.legend()
    return figure


def _points(axes: "Axes", rows: Sequence[dict[str, Any]], name: str, color: str) -> None:
    """Draw measured points with intervals of 95 %."""
    if rows[0]["kind"] == "fill":
        places = [100.0 * row["fill"] for row in rows]
    else:
        radii = [row["diameter"] / 2.0 for row in rows]
        places = [
            r["rpm"] * math.pi / 30.0 * math.sqrt(R / GRAVITY) for r, R in zip(rows, radii, strict=True)
        ]
    halves = [row["half_width"] for row in rows]
    axes.errorbar(
        places,
        [row["lever"] for row in rows],
        halves,
        color=color,
        ls="none",
        marker="o",
        mfc="none",
        label=name,
    )


def main() -> int:
    """Make table and figure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--table", type=Path, default=Path("docs/study/table.parquet"), help="table of the study"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("docs/verification"), help="folder of table and figure"
    )
    options = parser.parse_args()
    if not options.table.is_file():
        parser.error(
            f"--table is {str(options.table)!r}, but must be the table that `drumrs reproduce` writes"
        )
    rows = [*of_study(options.table), *of_sizes()]
    options.out.mkdir(parents=True, exist_ok=True)
    pl.DataFrame(rows, infer_schema_length=None).write_parquet(options.out / "mill.parquet", statistics=False)
    write(draw(rows), options.out / "mill.png")
    for baffles, name in DRUMS.items():
        sine = sine_of(rows, baffles)
        print(f"{name}: sin α = {sine:.3f}, α = {math.degrees(math.asin(sine)):.1f}°")
        for row in rows:
            if row["kind"] != "size" and row["baffles"] == baffles:
                share = row["lever"] / segment_lever(row["fill"]) / sine
                print(f"  {row['kind']} {row['fill']:.3f} {row['rpm']:g} rpm: measured over form {share:.2f}")
    print(
        *(
            f"D = {r['diameter']:g} m: {r['power']:.6g} W/m, P/(M g R Ω) = {r['lever']!r}"
            for r in rows[-SIZES:]
        ),
        sep="\n",
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
