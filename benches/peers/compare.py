"""Compare drumrs with LAMMPS, LIGGGHTS and Yade: speed on the same settled drums, and the powers that they find.

Parts: `speed` times every code in turn on one core, from one state; `check` runs Table 1's drum in each and compares
specific powers over equal windows; `baffles` times drumrs with and without baffles; `sweep` times a sweep on one core
and on two. The rest of the machine should be at rest. Speeds of drumrs are with its energy ledger and recording on.
"""

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from codes import machine
from codes.agreement import check
from codes.lammps import Lammps
from codes.liggghts import Liggghts
from codes.ours import Drumrs
from codes.program import Code, MissingError, PeerError
from codes.speed import compare_baffles, compare_speeds, compare_sweeps
from codes.yade import Yade

SIZES = (100, 200, 300, 1_000, 10_000, 100_000)
CODES: dict[str, Code] = {
    "drumrs": Drumrs(),
    "lammps": Lammps(),
    "lammps-all": Lammps(near=False, name="LAMMPS, all"),
    "liggghts": Liggghts(),
    "yade": Yade(),
}
DEFAULT = ["drumrs", "lammps", "liggghts", "yade"]
PARTS = ("speed", "check", "baffles", "sweep")


def options_of(words: Sequence[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("parts", nargs="*", metavar="part", help=f"{', '.join(PARTS)}; all unless given")
    parser.add_argument("--codes", nargs="+", default=DEFAULT, choices=CODES, help="which codes to run")
    parser.add_argument(
        "--sizes", nargs="+", type=int, default=list(SIZES), help="numbers of bundles to time"
    )
    parser.add_argument("--repeats", type=int, default=5, help="rounds in which every code has its turn")
    parser.add_argument("--seconds", type=float, default=1.0, help="time that one timing should take [s]")
    parser.add_argument("--seeds", type=int, default=3, help="random starts of a check")
    parser.add_argument(
        "--duration", type=float, default=6.0, help="simulated time of a check [s]; a third is left out"
    )
    parser.add_argument("--core", type=int, help="core to stay on")
    parser.add_argument("--priority", type=int, help="real-time priority, 1 to 99, where that is allowed")
    parser.add_argument(
        "--beds", type=Path, default=Path("out/peers/beds"), help="folder that keeps settled beds"
    )
    options = parser.parse_args(words)
    unknown = [part for part in options.parts if part not in PARTS]
    if unknown:
        parser.error(f"part is {unknown[0]!r}, but must be one of {', '.join(PARTS)}")
    for name in ("repeats", "seconds", "seeds", "duration"):
        if not getattr(options, name) > 0:
            parser.error(f"--{name} is {getattr(options, name)}, but must be above 0")
    if min(options.sizes) < 1:
        parser.error(f"--sizes has {min(options.sizes)}, but must hold numbers of at least 1")
    return options


def present(names: Sequence[str]) -> list[Code]:
    """Return the codes that are installed; say of each other one what installs it."""
    found: list[Code] = []
    for name in names:
        try:
            CODES[name].require()
        except MissingError as missing:
            sys.stderr.write(f"{missing}\n")
        else:
            found.append(CODES[name])
    return found


def main(words: Sequence[str] | None = None) -> int:
    """Run the parts; return 1 where codes disagree or one of them fails."""
    options = options_of(words)
    parts = options.parts or PARTS
    codes = present(options.codes)
    print(machine.cpu(), "|", ", ".join(f"{name} {version}" for name, version in machine.versions().items()))
    try:
        if "sweep" in parts:
            compare_sweeps(options.repeats)
        machine.pin(options.core, options.priority)
        with tempfile.TemporaryDirectory() as scratch:
            if "speed" in parts:
                compare_speeds(codes, options, Path(scratch))
            if "baffles" in parts:
                compare_baffles(options, Path(scratch))
            agreed = check(codes, options, Path(scratch)) if "check" in parts else True
    except (PeerError, OSError) as error:
        sys.stderr.write(f"compare.py: {error}\n")
        return 1
    return 0 if agreed else 1


if __name__ == "__main__":
    sys.exit(main())
