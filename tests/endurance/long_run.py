"""One run of 10⁸ steps: memory stays flat, the ledger stays closed.

python tests/endurance/long_run.py [STEPS]    # minutes; a line a tenth of the way
"""

import sys
import time
from pathlib import Path

import drumrs


def resident() -> float:
    """Return the memory that this process holds now [MB] (Linux)."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 1e6


def main(steps: int) -> None:
    """Run ten bundles between three baffles; samples and frames are rare, so that what grows is a leak."""
    config = drumrs.baseline(baffles=True).replace(
        {
            "load.count": 10,
            "run.duration": steps * 3.7e-6,
            "run.sample_every": steps * 3.7e-6 / 1000,
            "run.frame_every": steps * 3.7e-6,
        }
    )
    simulation = drumrs.Simulation(config)
    began, held = time.perf_counter(), []
    for part in range(1, 11):
        simulation.run_to_step(part * steps // 10)
        residual = simulation.series["energy_residual"][-1]
        held.append(resident())
        took = time.perf_counter() - began
        sys.stdout.write(
            f"{simulation.step:.0e} steps, {took:.0f} s, {held[-1]:.1f} MB, ledger {residual:.1e}\n"
        )
        sys.stdout.flush()
        if residual > 1e-9:
            sys.exit("the ledger is open")
    # The first tenth imports polars.
    if held[-1] > held[1] + 5.0:
        sys.exit(f"memory grew from {held[1]:.1f} to {held[-1]:.1f} MB")


if __name__ == "__main__":
    main(int(float(sys.argv[1])) if len(sys.argv) > 1 else 10**8)
