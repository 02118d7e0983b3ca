"""Compare the physics of drumrs with that of other codes: specific power and center of mass, run by run.

Every code starts from the same packing and is averaged over the same window; the specific power is that of the
balance of moments, Ω (g x + dL/dt). Runs that are kept in the folder are not run again. The table of all runs, a page
of means, and a figure with intervals of 95 % are made of what the folder holds.
"""

import argparse
import json
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import drumrs
from codes.balance import Measured
from codes.case import Case
from codes.findings import collect, draw, means, verdicts
from codes.lammps import Lammps
from codes.liggghts import Liggghts
from codes.ours import Drumrs
from codes.program import Code, MissingError, PeerError
from drumrs.figures import write
from drumrs.paper.drums import BARE, TRIANGLES

FILLS = (0.10, 0.25, 0.40, 0.50, 0.60, 0.75)
FRICTIONS = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7)
FRICTION_FILL = 0.50
FILLS_WITH_BAFFLES = (0.25, 0.50, 0.75)
WINDOW = (4.0, 10.0)
SEEDS = (1, 2, 3)
CODES = ("drumrs", "LAMMPS", "LIGGGHTS")


@dataclass(frozen=True)
class Point:
    """A drum to compare: fill, friction of all contacts, baffles or none."""

    fill: float
    friction: float = 0.5
    baffles: bool = False

    def config(self, seed: int) -> drumrs.Config:
        """Return the paper's drum with this fill, friction and seed."""
        both = {f"contact.{side}.friction": self.friction for side in ("bundle", "drum")}
        run = {"seed": seed, "duration": WINDOW[1], "window": WINDOW, "frame_every": WINDOW[1]}
        drum = TRIANGLES if self.baffles else BARE
        return drum.config(self.fill).replace({**both, "run": run})


def points() -> list[Point]:
    """Return the points, each once."""
    bare = [Point(fill) for fill in FILLS] + [Point(FRICTION_FILL, friction) for friction in FRICTIONS]
    return list(dict.fromkeys(bare)) + [Point(fill, baffles=True) for fill in FILLS_WITH_BAFFLES]


def runs(seeds: Sequence[int]) -> Iterator[tuple[Point, int, Code]]:
    """List the runs, seed by seed: of bare drums in LAMMPS, of drums with baffles in LIGGGHTS, of both in drumrs."""
    for seed in seeds:
        for point in points():
            peer: Code = Liggghts() if point.baffles else Lammps()
            for code in (Drumrs(), peer):
                yield point, seed, code


def measure(point: Point, seed: int, code: Code, folder: Path) -> None:
    """Run a point in a code, unless its result is kept already, and keep the result."""
    baffles = "baffles" if point.baffles else "bare"
    kept = folder / f"{code.name}_{baffles}_{point.fill:g}_{point.friction:g}_{seed}.json"
    if kept.exists():
        return
    case = Case.packed(point.config(seed))
    with tempfile.TemporaryDirectory() as scratch:
        measured = Measured.over(code.trace(case, WINDOW[1], Path(scratch)), WINDOW)
    row = {"code": code.name, **asdict(point), "seed": seed, "start": WINDOW[0], "end": WINDOW[1]}
    for name, mean in asdict(measured).items():
        row |= {name: mean["value"], f"{name}_error": mean["error"]}
    kept.write_text(json.dumps(row), encoding="utf-8")
    print(f"{kept.stem}: {measured.power.value:.3f} W/kg", flush=True)


def _shard(text: str) -> tuple[int, int]:
    """Read k/n."""
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    share, shares = (int(found[1]), int(found[2])) if found is not None else (0, 0)
    if not 1 <= share <= shares:
        raise argparse.ArgumentTypeError(f"{text!r} must be k/n with 1 <= k <= n")
    return share, shares


def main() -> int:
    """Run what is missing, then make the table and the figure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--runs", type=Path, default=Path("out/peers/physics"), help="folder of the runs' results"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("docs/verification"), help="folder of table, page and figure"
    )
    parser.add_argument(
        "--seeds", nargs="+", type=int, default=SEEDS, help="seeds of the random starts to run now"
    )
    parser.add_argument("--codes", nargs="+", default=CODES, choices=CODES, help="which codes to run now")
    parser.add_argument(
        "--shard", type=_shard, default=(1, 1), help="k/n: run the k-th of n parts, for n processes"
    )
    options = parser.parse_args()
    options.runs.mkdir(parents=True, exist_ok=True)
    share, shares = options.shard
    chosen = [run for run in runs(options.seeds) if run[2].name in options.codes][share - 1 :: shares]
    for point, seed, code in chosen:
        try:
            measure(point, seed, code, options.runs)
        except MissingError as missing:
            sys.stderr.write(f"{missing}\n")
        except PeerError as error:
            sys.stderr.write(f"physics.py: {point}, seed {seed}: {error}\n")
            return 1
    write_findings(options.runs, options.out)
    return 0


def write_findings(runs_kept: Path, out: Path) -> None:
    """Write peers.parquet, peers.md and peers.png."""
    table = collect(runs_kept)
    out.mkdir(parents=True, exist_ok=True)
    table.write_parquet(out / "peers.parquet", compression="zstd", statistics=False)
    entries = means(table)
    lines = verdicts(entries)
    (out / "peers.md").write_text("\n".join([*lines, ""]), encoding="utf-8")
    write(draw(entries), out / "peers.png")
    print("\n".join(lines))


if __name__ == "__main__":
    sys.exit(main())
