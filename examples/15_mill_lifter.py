"""
A decision: the face angle of a mill's lifters
==============================================

Which face angle, and which speed, give much power for little that impacts on the shell take? A search over both leaves
a front, of which no point is better than another in both.
"""

import argparse
from pathlib import Path

import drumrs

RAIL = {"count": 8, "height": 0.04, "width": 0.04, "face_angle": 20.0, "back_angle": 20.0}
MILL = drumrs.Config().replace(
    {
        "drum.liner.rail": RAIL,
        "load.fill": 0.2,
        "contact.bundle.restitution": 0.3,
        "run.duration": 5.0,
        "run.window": [2.0, 5.0],
    }
)
# The angle of the leading face from the radial, and 65 to 90 % of critical speed.
RANGES = {"drum.liner.rail.face_angle": [0, 45], "rotation.rpm": [40, 55]}
WANTED = {
    "maximize": "drum_specific_power",
    "minimize": "rim_impact_specific_power",  # what impacts on the shell take
    "runs": 18,
    "batch": 4,
    "confirm": 2,
}


def main() -> None:
    """Search for the front and print it."""
    parser = argparse.ArgumentParser()
    parser.add_argument(
        "--small", action="store_true", help="short runs with softer springs, and few of them"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("out/lifter"), help="folder of table, picture and runs"
    )
    options = parser.parse_args()

    mill, wanted = MILL, WANTED
    if options.small:
        mill = MILL.softer(100.0).replace({"run.duration": 3.0, "run.window": [1.0, 3.0]})
        wanted = {**WANTED, "runs": 12}
    found = drumrs.optimize({"base": mill, "ranges": RANGES, "optimize": wanted}, options.out)
    print(found.sentence)


if __name__ == "__main__":
    main()
