"""A sweep of 10 000 short cases: memory stays flat.

python tests/endurance/short_cases.py [CASES]    # minutes

A thread of its own for every simulation would show here: the system's allocator keeps an arena for each of the threads
that it has seen.
"""

import shutil
import sys
import tempfile
import threading
import time
from pathlib import Path

import drumrs


def resident() -> float:
    """Return the memory that this process holds now [MB] (Linux)."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 1e6


def main(cases: int) -> None:
    """Run the cases while a thread notes finished cases and memory every few seconds."""
    base = drumrs.baseline(fill=0.02).replace({"run.duration": 0.02, "run.frame_every": 0.02})
    sweep = drumrs.Sweep(base, seeds=cases)
    folder = Path(tempfile.mkdtemp())
    held: list[tuple[int, float]] = []
    over = threading.Event()

    def watch() -> None:
        while not over.wait(2.0):
            held.append((len(list(folder.glob("*.facts.json"))), resident()))

    watcher = threading.Thread(target=watch)
    watcher.start()
    began = time.perf_counter()
    outcome = sweep.run(folder, progress=False)
    took = time.perf_counter() - began
    over.set()
    watcher.join()
    shutil.rmtree(folder)
    for share in range(1, 11):
        done, memory = next(
            (entry for entry in held if entry[0] >= share * cases // 10), (outcome.finished, resident())
        )
        sys.stdout.write(f"{done} cases, {memory:.1f} MB\n")
    sys.stdout.write(f"{outcome.finished} of {cases} cases in {took:.0f} s\n")
    # Until then the allocator settles.
    settled = next(memory for done, memory in held if done >= 2 * cases // 5)
    if outcome.finished != cases or held[-1][1] > settled + 10.0:
        sys.exit(f"memory grew from {settled:.1f} to {held[-1][1]:.1f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
