"""A sweep of 10^6 cases, packed: its rows are scanned in seconds, in little memory.

python tests/endurance/million_rows.py [ROWS]    # a minute

The rows are made up from one case that is run; their files are written as `drumrs pack` writes them.
"""

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import polars as pl

import drumrs
from drumrs.sweep import columns, scan_folder
from drumrs.sweep.packs import ROWS
from drumrs.sweep.sealed import write_sealed

PACK = 4096
# What a scan may take [s] and hold [MB].
MOST_TIME, MOST_MEMORY = 60.0, 500.0


def make(folder: Path, count: int) -> None:
    """Write packs with so many rows, whose numbers all differ."""
    base = drumrs.baseline(fill=0.05).replace({"run.duration": 0.05})
    sweep = drumrs.Sweep.from_configs([base])
    sweep.run(folder, progress=False)
    row = sweep.table().collect()
    (folder / f"{sweep.cases[0].id}.parquet").unlink()
    (folder / "packs").mkdir()
    results = [name for name, kind in row.schema.items() if kind == pl.Float64 and "." not in name]
    draw = np.random.default_rng(1)
    for number, first in enumerate(range(0, count, PACK)):
        height = min(PACK, count - first)
        numbers = draw.normal(size=(len(results), height))
        ids = [f"{first + index:020x}" for index in range(height)]
        rows = pl.concat([row] * height).with_columns(
            pl.Series("case", ids),
            pl.Series("seed", np.arange(first, first + height)),
            pl.Series("load.fill", draw.choice([0.1, 0.2, 0.3], height)),
            *(pl.Series(name, values) for name, values in zip(results, numbers, strict=True)),
        )
        name = f"{number:016x}"
        write_sealed(folder / "packs" / f"{name}.parquet", name, ROWS, rows, columns.metadata(), "zstd")


def most_resident() -> float:
    """Return the most memory that this process has held [MB] (Linux)."""
    told = Path("/proc/self/status").read_text(encoding="ascii")
    return int(told.partition("VmHWM:")[2].split()[0]) / 1e3


def scan(folder: Path) -> None:
    """Scan the rows as a user does, and say what it took."""
    before = most_resident()
    began = time.perf_counter()
    power = pl.col("drum_specific_power")
    means = scan_folder(folder).group_by("load.fill").agg(pl.len(), power.mean(), error=power.std()).collect()
    took = time.perf_counter() - began
    held = most_resident()
    sys.stdout.write(f"{means['len'].sum()} rows in {took:.1f} s, {held:.0f} MB ({before:.0f} before)\n")
    if took > MOST_TIME or held > MOST_MEMORY:
        sys.exit(f"a scan took more than {MOST_TIME:.0f} s or {MOST_MEMORY:.0f} MB")


def main(count: int) -> None:
    """Make the rows, and scan them in a process of its own, whose memory says nothing of how they were made."""
    folder = Path(tempfile.mkdtemp())
    try:
        make(folder, count)
        size = sum(path.stat().st_size for path in (folder / "packs").iterdir()) / 1e6
        sys.stdout.write(f"{len(list((folder / 'packs').iterdir()))} files, {size:.0f} MB\n")
        subprocess.run([sys.executable, __file__, "--scan", str(folder)], check=True)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--scan"]:
        scan(Path(sys.argv[2]))
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 10**6)
