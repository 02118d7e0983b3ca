"""Measure the cost of a particle-step against the number of bundles, in drumrs and in other codes, and draw it.

Every code starts from the same settled, turning bed, on one core; drumrs also on two, with its ledger and recording on.
Writes scaling.parquet, with machine and versions in its metadata, and scaling.png. The rest of the machine should be at
rest.
"""

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import drumrs
from codes import machine
from codes.beds import settled
from codes.lammps import Lammps
from codes.liggghts import Liggghts
from codes.ours import Drumrs
from codes.program import Code, MissingError, PeerError
from codes.speed import time_code
from codes.yade import Yade
from drumrs.figures import write
from drumrs.figures.shared import drumrs_style

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure

SIZES = (100, 200, 300, 1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000)
# Each code with the largest load that it is given: the others need too long or too much memory for more.
CODES: tuple[tuple[Code, int], ...] = (
    (Drumrs(), 1_000_000),
    (Drumrs(threads=2, name="drumrs, 2 threads"), 1_000_000),
    (Lammps(), 100_000),
    (Liggghts(), 100_000),
    (Yade(), 10_000),
)


def measure(sizes: Sequence[int], repeats: int, seconds: float, beds: Path) -> "pl.DataFrame":
    """Time the codes in turn, round by round; return one row a code and size."""
    import polars as pl

    rows: list[dict[str, Any]] = []
    missing: set[str] = set()
    with tempfile.TemporaryDirectory() as scratch:
        for count in sizes:
            case = settled(count, beds)
            costs: dict[str, list[float]] = {}
            for _ in range(repeats):
                for code, largest in CODES:
                    if count > largest or code.name in missing:
                        continue
                    try:
                        rate = time_code(code, case, seconds, Path(scratch)).rate(count)
                    except MissingError as error:
                        sys.stderr.write(f"{error}\n")
                        missing.add(code.name)
                    else:
                        costs.setdefault(code.name, []).append(1e9 / rate)
            contacts = contacts_per_bundle(case.config, case.state)
            rows += [
                {
                    "code": name,
                    "count": count,
                    "contacts_per_bundle": contacts,
                    "nanoseconds": median(values),
                    "least": min(values),
                    "greatest": max(values),
                }
                for name, values in costs.items()
            ]
            told = ", ".join(f"{name} {median(values):.1f}" for name, values in costs.items())
            print(f"N = {count}, {contacts:.2f} contacts a bundle; ns a particle-step: {told}", flush=True)
    return pl.DataFrame(rows)


def joined(kept: Path, table: "pl.DataFrame") -> "pl.DataFrame":
    """Return a kept table with the sizes of a new one in the place of its own, code by code."""
    import polars as pl

    earlier = pl.read_parquet(kept).join(table, on="count", how="anti")
    order = {code.name: rank for rank, (code, _) in enumerate(CODES)}
    rank = pl.col("code").replace_strict(order, return_dtype=pl.Int64)
    return pl.concat([earlier, table]).sort(rank, "count")


def contacts_per_bundle(config: drumrs.Config, state: drumrs.State) -> float:
    """Return the number of contacts over that of bundles, a few steps after the start."""
    steps = 200
    config = config.replace({"run.sample_every": steps * float(config.run.time_step) / 4.0})
    simulation = drumrs.Simulation(config, state=state)
    simulation.run(steps=steps)
    return float(simulation.series["contact_count"][-1]) / simulation.count


def draw(table: "pl.DataFrame", title: str) -> "Figure":
    """Draw the cost of a particle-step of each code against the number of bundles."""
    from matplotlib.figure import Figure

    with drumrs_style():
        figure = Figure(figsize=(6.5, 4.2))
        axes = figure.subplots()
        for name, rows in table.group_by("code", maintain_order=True):
            ours = str(name[0]).startswith("drumrs")
            middle, low, high = (rows[key].to_numpy() for key in ("nanoseconds", "least", "greatest"))
            axes.errorbar(
                rows["count"],
                middle,
                [middle - low, high - middle],
                label=str(name[0]),
                marker="." if ours else "o",
                mfc=None if ours else "none",
                ls="-" if ours else ":",
                capsize=2.0,
            )
        axes.set(
            xscale="log", yscale="log", xlabel="Number of bundles", ylabel="Time of a particle-step [ns]"
        )
        axes.set_title(title, fontsize="small")
        axes.legend()
    return figure


def main() -> int:
    """Measure and draw."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", nargs="+", type=int, default=list(SIZES), help="numbers of bundles")
    parser.add_argument("--repeats", type=int, default=3, help="rounds in which every code has its turn")
    parser.add_argument("--seconds", type=float, default=0.5, help="time that one timing should take [s]")
    parser.add_argument("--priority", type=int, help="real-time priority, 1 to 99, where that is allowed")
    parser.add_argument(
        "--beds", type=Path, default=Path("out/peers/beds"), help="folder that keeps settled beds"
    )
    parser.add_argument("--out", type=Path, default=Path("docs"), help="folder of table and figure")
    parser.add_argument(
        "--append", action="store_true", help="keep the other sizes of the table that is there"
    )
    options = parser.parse_args()
    if min(options.sizes) < 1 or options.repeats < 1 or not options.seconds > 0.0:
        parser.error("--sizes, --repeats and --seconds must be above 0")
    try:
        machine.pin(None, options.priority)
        table = measure(options.sizes, options.repeats, options.seconds, options.beds)
    except (PeerError, OSError) as error:
        sys.stderr.write(f"scaling.py: {error}\n")
        return 1
    if options.append and (options.out / "scaling.parquet").exists():
        table = joined(options.out / "scaling.parquet", table)
    versions = ", ".join(f"{name} {version}" for name, version in machine.versions().items())
    options.out.mkdir(parents=True, exist_ok=True)
    facts = {"machine": machine.cpu(), "versions": versions, "units": json.dumps({"nanoseconds": "ns"})}
    table.write_parquet(options.out / "scaling.parquet", statistics=False, metadata=facts)
    write(draw(table, f"{machine.cpu()}; {versions}"), options.out / "scaling.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
