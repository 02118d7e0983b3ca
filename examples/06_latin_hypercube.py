"""
Which parameter matters most: a Latin hypercube
===============================================

Which of fill, friction, speed and restitution matters most for the power? A Latin hypercube, SciPy's, asks with a few
random cases. With ``--sobol`` the cases are those of a Sobol sequence, which fills the ranges more evenly still.
"""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import polars as pl
from scipy.stats import qmc

import drumrs

# Keys of the configuration, with the range that each is drawn from.
RANGES = {
    "load.fill": (0.10, 0.70),
    "contact.bundle.friction": (0.05, 1.0),
    "rotation.rpm": (20.0, 70.0),
    "contact.bundle.restitution": (0.05, 0.9),
}


def design(count: int, *, sobol: bool) -> pl.DataFrame:
    """Return as many cases, a power of two, spread over all ranges at once, one row each."""
    lowest, highest = zip(*RANGES.values(), strict=True)
    sampler = (qmc.Sobol if sobol else qmc.LatinHypercube)(d=len(RANGES), rng=1)
    points = qmc.scale(sampler.random(count), lowest, highest)
    # Bundles meet the drum as they meet each other.
    return pl.DataFrame(points, schema=list(RANGES), orient="row").with_columns(
        pl.col("contact.bundle.friction").alias("contact.drum.friction"),
        pl.col("contact.bundle.restitution").alias("contact.drum.restitution"),
    )


def main() -> None:
    """Run the design and print the rank correlation of every parameter with the specific power."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="sixteen short runs with softer springs")
    parser.add_argument("--sobol", action="store_true", help="take the cases from a Sobol sequence")
    parser.add_argument("--out", type=Path, default=Path("out/latin_hypercube"), help="folder of the results")
    options = parser.parse_args()

    rows = design(16 if options.small else 64, sobol=options.sobol)
    base = drumrs.baseline()
    if options.small:
        base = base.softer(100.0).replace({"run.duration": 3.0})
    sweep = drumrs.Sweep.from_rows(base, rows, seeds=[1])
    sweep.run(options.out)

    power = pl.col("drum_specific_power")
    strengths = (
        sweep.table().select(pl.corr(key, power, method="spearman").alias(key) for key in RANGES).collect()
    )
    print("rank correlation with the specific power (−1 … 1):")
    for key in RANGES:
        print(f"  {key:28} {strengths[key].item():+.2f}")
    print(f"wrote {sweep.write_table()}")

    figure, panels = plt.subplots(1, len(RANGES), figsize=(10.0, 3.0), sharey=True, layout="constrained")
    table = sweep.table().collect()
    for axes, key in zip(panels, RANGES, strict=True):
        axes.plot(table[key], table["drum_specific_power"], "o")
        axes.set(xlabel=key)
    panels[0].set(ylabel="Specific power [W/kg]", ylim=(0.0, None))
    figure.savefig(options.out / "power.png", dpi=150)


if __name__ == "__main__":
    main()
