"""
A ball mill: charge, collisions, wear
=====================================

A mill of one meter with twelve rails, filled to 30 % with steel balls of two sizes. Contacts and what the wall feels
are recorded on request; what they took adds up to the energy ledger.
"""

import argparse
import math
from pathlib import Path

import drumrs
from drumrs import figures, measures

MILL = {
    "drum.diameter": 1.0,
    "drum.liner.rail": {"count": 12, "height": 0.05, "width": 0.05, "face_angle": 20.0, "back_angle": 5.0},
    "rotation.rpm": 32.0,  # 74 % of critical
    "load.fill": 0.3,
    # Balls that meet at the speed of a fall through the mill overlap by a hundredth of their radius.
    "contact.bundle.normal_stiffness": 2.5e9,
    "contact.drum.normal_stiffness": 2.5e9,
    "load.species": [
        {"name": "large", "preset": "steel-ball", "share": 0.6, "diameter": 0.05},
        {"name": "small", "preset": "steel-ball", "share": 0.4, "diameter": 0.03},
    ],
    "load.share_by": "mass",
    "run.time_step": "auto",
    "run.duration": 20.0,
    "run.record": ["contacts", "wall_profile"],
    "run.arc_bin": 0.01,
}


def main() -> None:
    """Run the mill and draw it, its wear and its collisions."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="one turn, with softer springs")
    parser.add_argument("--out", type=Path, default=Path("out/ball_mill"), help="folder of the pictures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)

    config = drumrs.baseline().replace(MILL)
    if options.small:
        config = config.softer(100.0).replace({"run.duration": 4.0})
    result = drumrs.run(config, seed=1)
    window = config.run.averaging_window
    charge = measures.charge(result.frames, window)
    print(f"power {result.summary.drum_specific_power:.1f} W/kg")
    for end in ("toe", "shoulder"):
        print(
            f"{end} at {math.degrees(charge[f'{end}_angle'].value):.0f}°, counter-clockwise from the horizontal"
        )
    missing = measures.sum_rule(result.contacts, result.dissipated)
    print(f"missing from the sum over contacts: {max(map(abs, missing.values())):.0e} of all")

    worn = measures.wear(result.wall_profile)
    hits = measures.impacts(result.contacts, config.derived.bundle.collision_time)
    spectra = {
        name: measures.collision_spectrum(table, config.derived.load_mass, config.run.duration)
        for name, table in (("all contacts", result.contacts), ("impacts", hits))
    }
    for name, figure in (
        ("charge", figures.snapshots([figures.View(result.frames, -1, "the last moment")])),
        ("wear", figures.wall_profile(worn, "relative_wear", "wear over its mean")),
        ("collisions", figures.collision_spectrum(spectra)),
    ):
        figures.write(figure, options.out / f"{name}.png")
    print(f"wrote {drumrs.player(result).save(options.out / 'player.html')}")


if __name__ == "__main__":
    main()
