"""
A sweep over fill and baffles
=============================

What a drum draws from 10 to 70 % fill, without and with baffles, on all cores; the results are one parquet table.

Stop it with Ctrl-C and start it again: it goes on where it was.
"""

# sphinx_gallery_thumbnail_path = "tutorials/sweep.png"
import argparse
from pathlib import Path

import polars as pl

import drumrs
from drumrs.analysis import student


def main() -> None:
    """Run the sweep and print specific powers, means over seeds with intervals of 95 %."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="three fills, short runs with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/fill_sweep"), help="folder of the results")
    options = parser.parse_args()

    base = drumrs.baseline()
    if options.small:
        base = base.softer(100.0).replace({"run.duration": 3.0})
    fills = [0.1, 0.2, 0.3] if options.small else [0.1, 0.2, 0.3, 0.4, 0.45, 0.5, 0.6, 0.7]
    sweep = drumrs.Sweep(base, axes={"load.fill": fills, "drum.baffles.count": [0, 3]}, seeds=range(3))
    outcome = sweep.run(options.out)
    for failure in outcome.failures:
        print(f"{failure.case} failed: {failure.message}")

    by_fill = sweep.table().collect().sort("load.fill", "drum.baffles.count", "seed")
    for (fill, baffles), runs in by_fill.group_by("load.fill", "drum.baffles.count", maintain_order=True):
        power = student(runs["drum_specific_power"].to_list(), runs["drum_specific_power_error"].to_list())
        warning = "  drifting" if runs.select(pl.col("drifting").any()).item() else ""
        print(f"fill {fill:.0%}, {baffles} baffles: {power.mean:.3g} ± {power.half_width:.2g} W/kg{warning}")
    print(f"wrote {sweep.write_table()}")


if __name__ == "__main__":
    main()
