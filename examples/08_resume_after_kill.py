"""
A sweep that is killed and goes on
==================================

It is killed in its middle, the hard way, and started again: its table is that of a sweep without a break.
"""

import argparse
import shutil
import subprocess
import sys
import time
from pathlib import Path

SWEEP = """
seeds = 2
[base]
run.duration = {duration}
[axes]
load.fill = [0.05, 0.1, 0.15]
drum.baffles.count = [0, 3]
"""
CASES = 12


def finished(folder: Path) -> int:
    """Count the cases whose record of completion is there: <id>.parquet, written last."""
    return sum(path.name.count(".") == 1 and path.stem != "table" for path in folder.glob("*.parquet"))


def main() -> None:
    """Run a sweep, kill it, run it again, and compare with one that was left alone."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="a moment of each case only")
    parser.add_argument(
        "--out", type=Path, default=Path("out/resume"), help="folder of both sweeps, made anew"
    )
    options = parser.parse_args()
    broken, whole = options.out / "broken", options.out / "whole"
    for folder in (broken, whole):
        shutil.rmtree(folder, ignore_errors=True)
    options.out.mkdir(parents=True, exist_ok=True)
    path = options.out / "sweep.toml"
    path.write_text(SWEEP.format(duration=0.1 if options.small else 3.0), encoding="utf-8")
    command = [sys.executable, "-m", "drumrs", "sweep", str(path), "--jobs", "1", "--out"]

    process = subprocess.Popen([*command, str(broken)])
    while finished(broken) < CASES // 2 and process.poll() is None:
        time.sleep(0.002)
    process.kill()
    process.wait()
    print(f"killed: {finished(broken)} of {CASES} cases are finished")

    for folder in (broken, whole):
        subprocess.run([*command, str(folder)], check=True, stdout=subprocess.DEVNULL)
    tables = [(folder / "table.parquet").read_bytes() for folder in (broken, whole)]
    if tables[0] != tables[1]:
        sys.exit("the tables differ")
    print(f"the tables of both sweeps are the same {len(tables[0])} bytes")


if __name__ == "__main__":
    main()
