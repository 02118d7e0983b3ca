"""
Without and with baffles
========================

The paper's drum at 25 % fill: run both, print what they draw, save a picture.
"""

import argparse
from pathlib import Path

import drumrs
from drumrs import figures


def main() -> None:
    """Run both drums, for half a minute of simulated time or, with --small, three seconds."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="three seconds, with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/first_turn"), help="folder of the pictures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    views = []
    for label, baffles in (("without baffles", False), ("with baffles", True)):
        config = drumrs.baseline(fill=0.25, baffles=baffles)
        if options.small:
            config = config.softer(100.0).replace({"run.duration": 3.0})
        result = drumrs.run(config, seed=1)
        summary = result.summary
        print(f"{label}: {summary.drum_specific_power:.3g} W/kg, N/T {summary.work_ratio}")
        views.append(figures.View(result.frames, -1, label))
    picture = options.out / "first_turn.png"
    figures.write(figures.snapshots(views), picture)
    print(f"wrote {picture}")


if __name__ == "__main__":
    main()
