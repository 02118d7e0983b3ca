"""
A figure from the table of a sweep
==================================

With polars and matplotlib alone: no simulation, and no drumrs, is needed to read a table.
"""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import polars as pl


def means(table: Path) -> pl.DataFrame:
    """Read the specific power against fill and baffles: mean and standard error over seeds."""
    power = pl.col("drum_specific_power")
    return (
        pl.scan_parquet(table)
        # Sums of floats depend on their order; kept, they give the same bits every time.
        .group_by("drum.baffles.count", "fill", maintain_order=True)
        .agg(power.mean().alias("mean"), (power.std() / power.count().sqrt()).alias("error"))
        .sort("drum.baffles.count", "fill")
        .collect()
    )


def main() -> None:
    """Draw the table that examples/02_fill_sweep.py wrote, or else a small one made on the spot."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="make a small table in any case")
    parser.add_argument(
        "--table", type=Path, default=Path("out/fill_sweep/table.parquet"), help="table of a sweep"
    )
    parser.add_argument("--out", type=Path, default=Path("out/plot"), help="folder of the picture")
    options = parser.parse_args()
    table = options.table if options.table.exists() and not options.small else small_table(options.out)

    options.out.mkdir(parents=True, exist_ok=True)
    figure, axes = plt.subplots(figsize=(5.0, 3.5), layout="constrained")
    for (count,), line in means(table).group_by("drum.baffles.count", maintain_order=True):
        label = f"{count} baffles" if count else "no baffles"
        axes.errorbar(100.0 * line["fill"], line["mean"], line["error"], marker="o", capsize=2.0, label=label)
    axes.set(xlabel="Fill [%]", ylabel="Specific power [W/kg]", ylim=(0.0, None))
    axes.legend(frameon=False)
    picture = options.out / "drum_specific_power.png"
    figure.savefig(picture, dpi=150)
    print(f"wrote {picture}")


def small_table(folder: Path) -> Path:
    """Make a table to draw where there is none yet."""
    import drumrs

    base = drumrs.baseline().softer(100.0).replace({"run.duration": 3.0})
    sweep = drumrs.Sweep(base, axes={"load.fill": [0.15, 0.25, 0.35], "drum.baffles.count": [0, 3]}, seeds=2)
    sweep.run(folder)
    return sweep.write_table()


if __name__ == "__main__":
    main()
