"""
The flow of a bed: solid fraction and velocity
==============================================

Coarse-grained fields, means over all frames of a window, and the thickness of the layer that flows down the surface.
"""

import argparse
from pathlib import Path

import drumrs
from drumrs import figures, measures


def main() -> None:
    """Run a rolling bed and draw its mean flow."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="a few seconds, with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/flow"), help="folder of the picture")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    config = drumrs.baseline(fill=0.4).replace(
        {
            "load.diameter": 0.015,
            "rotation.rpm": 25.0,
            "contact.bundle.rolling_friction": 0.1,
            "contact.drum.rolling_friction": 0.1,
            "run.time_step": "auto",
            "run.frame_every": 0.02,
        }
    )
    if options.small:
        config = config.softer(100.0).replace({"run.duration": 4.0})
    result = drumrs.run(config, seed=1)

    window = config.run.averaging_window
    masses = measures.disc_masses(config, result.frames)
    layer = measures.flowing_layer(result.frames, window)
    print(
        f"the layer is {layer['layer_thickness'].value:.2g} m thick, the bed {layer['bed_depth'].value:.2g} m deep"
    )
    fields = measures.fields(result.frames, window, masses)
    figures.write(figures.flow(fields, result.frames.drum_radius), options.out / "flow.png")


if __name__ == "__main__":
    main()
