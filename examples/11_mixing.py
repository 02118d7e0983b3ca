"""
How fast a bed mixes
====================

Lacey's index over the turns of a drum: 0 while the colors are apart, 1 when they are mixed as well as by chance. The
verdict may depend on the coloring and on the size of the cells, so there are two colorings, and bands for three sizes.
"""

import argparse
from pathlib import Path

import drumrs
from drumrs import figures, measures

MIXER = {
    "drum.diameter": 0.24,
    # Teeth half as high as a disc: on a smooth rim the bed would slip as a whole.
    "drum.baffles": {"count": 60, "shape": "triangle", "height": 0.004, "base": 0.005},
    "load.diameter": 0.008,
    "load.density": 2500.0,
    "load.fill": 0.3,
    "rotation.rpm": 20.0,
    "run.time_step": "auto",
    "run.duration": 30.0,
}


def main() -> None:
    """Run the mixer, color its bed in two ways after the first second, and fit the rate of mixing."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="two and a half turns, with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/mixing"), help="folder of the pictures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    config = drumrs.baseline().replace(MIXER)
    if options.small:
        config = config.softer(100.0).replace({"run.duration": 8.0})
    result = drumrs.run(config, seed=1)

    curves, fits = {}, {}
    for coloring in ("layer", "side"):
        turns, index = measures.mixing_curve(result.frames, (1.0, config.run.duration), by=coloring)
        curves[coloring] = turns, index
        fits[coloring] = measures.mixing_rate(turns, index[1])
        print(f"by {coloring}: {fits[coloring].rate:.2g} per turn, up to {fits[coloring].end:.2f}")
    figures.write(figures.mixing_curve(curves, fits), options.out / "mixing.png")
    print(f"wrote {drumrs.player(result).save(options.out / 'player.html')}")


if __name__ == "__main__":
    main()
