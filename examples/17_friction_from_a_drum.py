"""
A decision: friction from a drum test
=====================================

What do the slope of a bed and the power of a small drum, at two speeds, say of friction and rolling friction? What
comes out is a probability, in which a ridge shows what the test cannot tell apart.
"""

import argparse
from pathlib import Path

import drumrs

EXPERIMENT = {
    # Springs as soft as `Config.softer(100)` makes them.
    "base": {
        "load": {"fill": 0.2},
        "contact": {
            "bundle": {"normal_stiffness": 925000.0},
            "drum": {"normal_stiffness": 970000.0, "friction": 0.4},
        },
        "run": {"duration": 5.0, "window": [1.5, 5.0], "frame_every": 0.02, "time_step": 3.7e-5},
    },
    "ranges": {"contact.bundle.friction": [0.1, 0.8], "contact.bundle.rolling_friction": [0.0, 0.3]},
    # Read off a run with a friction of 0.4 and a rolling friction of 0.1; in rad and W/kg.
    "measured": [
        {"target": "center_slope", "value": 0.475, "error": 0.02, "set": {"rotation.rpm": 15}},
        {"target": "center_slope", "value": 0.603, "error": 0.02, "set": {"rotation.rpm": 40}},
        {"target": "drum_specific_power", "value": 3.34, "error": 0.08, "set": {"rotation.rpm": 40}},
        {"target": "drum_specific_power", "value": 1.05, "error": 0.03, "set": {"rotation.rpm": 15}},
    ],
}
SMALL = {"calibrate": {"runs": 10}}


def main() -> None:
    """Fit the two, and print what they may be."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="fewer runs")
    parser.add_argument(
        "--out", type=Path, default=Path("out/friction"), help="folder of table, picture and runs"
    )
    options = parser.parse_args()

    found = drumrs.calibrate(EXPERIMENT | SMALL if options.small else EXPERIMENT, options.out)
    print(found.sentence)


if __name__ == "__main__":
    main()
