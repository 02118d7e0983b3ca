"""
A decision: the speed of a dryer
================================

At which speed does the load lie open to the air? Its openness and the curtain of falling cloth, which the air meets,
give different answers, and one of them is wrong.
"""

import argparse
from importlib.resources import files
from pathlib import Path

import drumrs

TARGETS = ("openness", "curtain")


def main() -> None:
    """Search for the best speed by each target."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="short runs, and the curtain alone")
    parser.add_argument(
        "--out", type=Path, default=Path("out/dryer"), help="folder of tables, pictures and runs"
    )
    options = parser.parse_args()

    # What `drumrs init --template dryer` writes.
    case = files("drumrs") / "templates/dryer/case.toml"
    length, runs = (3.0, 8) if options.small else (8.0, 16)
    times = {"run.duration": length, "run.window": [length / 4.0, length], "run.frame_every": 0.02}
    dryer = drumrs.Config.read(Path(str(case))).softer(100.0).replace(times)
    for target in TARGETS[1:] if options.small else TARGETS:
        wanted = {"maximize": target, "tolerance": "3 %", "runs": runs, "confirm": 2 if options.small else 4}
        problem = {"base": dryer, "ranges": {"rotation.rpm": [30, 75]}, "optimize": wanted}
        folder = options.out if options.small else options.out / target
        print(drumrs.optimize(problem, folder).sentence)


if __name__ == "__main__":
    main()
