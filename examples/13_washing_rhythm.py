"""
A washer's rhythm: tumble to and fro, rest, spin up
===================================================

The drum turns by phases, and work and power are summed up phase by phase.
"""

import argparse
from pathlib import Path

import polars as pl

import drumrs
from drumrs import figures

TUMBLE = [
    {"name": "start", "duration": 0.5, "ramp": [0.0, 54.0]},
    {"name": "tumble", "duration": 4.0, "rpm": 54.0},
    {"name": "brake", "duration": 0.5, "ramp": [54.0, 0.0]},
    {"name": "rest", "duration": 1.0, "rpm": 0.0},
]
PROGRAM = [
    {"name": "rhythm", "repeat": 2, "reversing": True, "phase": TUMBLE},
    {"name": "spin up", "duration": 6.0, "ramp": [0.0, 200.0]},
]


def main() -> None:
    """Run the program, print what each phase takes, and draw power and energies over time."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/washing_rhythm"), help="folder of the pictures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    config = drumrs.baseline(fill=0.25, baffles=True).replace(
        {"rotation.phase": PROGRAM, "run.duration": 18.0}
    )
    if options.small:
        config = config.softer(100.0)
    result = drumrs.run(config, seed=1)

    phases = drumrs.phases(result)
    print(phases.group_by("phase", maintain_order=True).agg(pl.col("phase_specific_work").sum()))
    starts = phases["start"].to_list()
    figures.write(figures.time_series(result.series, starts=starts), options.out / "time_series.png")
    print(f"wrote {drumrs.player(result).save(options.out / 'player.html')}")


if __name__ == "__main__":
    main()
