"""
A decision: the height of a washer's paddles
============================================

Which of three heights lets the load fall farthest for the rubbing that it costs? Seeds are run until that is settled,
or until the runs that are allowed are used up.
"""

import argparse
from importlib.resources import files
from pathlib import Path

import drumrs

HEIGHTS = (45, 60, 75)  # mm
FALL, RUBBING = "falls_per_turn * mean_drop", "dissipated_sliding_specific_power"
QUESTIONS = ((FALL, True), (RUBBING, False), (f"{FALL} / {RUBBING}", True))


def main() -> None:
    """Compare the heights by falls, by rubbing, and by one over the other."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="short runs, and few of them")
    parser.add_argument(
        "--out", type=Path, default=Path("out/paddle"), help="folder of tables, pictures and runs"
    )
    options = parser.parse_args()

    # What `drumrs init --template front-loader` writes.
    case = files("drumrs") / "templates/front-loader/case.toml"
    washer = drumrs.Config.read(Path(str(case))).softer(100.0)
    length = 4.0 if options.small else 8.0
    times = {"run.duration": length, "run.window": [length / 4.0, length], "run.frame_every": 0.01}
    washer = washer.replace({"rotation.rpm": 50.0, "run.record": [], **times})
    designs = {f"{height} mm": washer.replace({"drum.baffles.height": height / 1000}) for height in HEIGHTS}

    # All questions share the folder, and so the runs.
    for by, greatest in QUESTIONS[2:] if options.small else QUESTIONS:
        found = drumrs.compare(
            designs,
            by,
            greatest=greatest,
            difference="10 %",
            most=12 if options.small else 200,
            out=options.out,
        )
        print(found.sentence)


if __name__ == "__main__":
    main()
