"""
A sweep under MPI
=================

One rank hands out the cases, all others simulate::

    mpiexec -n 17 python -m mpi4py.futures examples/04_sweep_with_mpi.py --out results

runs 16 cases at once. Without mpiexec the script starts two ranks of its own. Needs ``pip install 'drumrs[mpi]'`` and
an MPI: that of the cluster, or ``pip install mpich``. MPI starts ranks with the first mpiexec on the path, so activate
the environment: the mpiexec of another MPI may wait for ever.
"""

import argparse
from pathlib import Path

from mpi4py.futures import MPIPoolExecutor

import drumrs


def main() -> None:
    """Lend the ranks to a sweep and say what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="a moment of each case only")
    parser.add_argument(
        "--out", type=Path, default=Path("out/mpi"), help="folder of the results, seen by all ranks"
    )
    options = parser.parse_args()

    base = drumrs.baseline().replace({"run.duration": 0.1 if options.small else 30.0})
    fills = [0.05, 0.1] if options.small else [0.2, 0.4, 0.6]
    sweep = drumrs.Sweep(base, axes={"load.fill": fills, "rotation.rpm": [30, 54]})
    # The number counts only where MPI has to start the ranks itself.
    with MPIPoolExecutor(max_workers=2) as executor:
        outcome = sweep.run(options.out.absolute(), executor)
    print(f"{outcome.finished} of {len(sweep)} cases are finished, {outcome.computed} of them just now")
    print(sweep.table().select("load.fill", "rotation.rpm", "drum_specific_power").collect())


# Ranks that MPI starts import this file again: what starts them must not run there.
if __name__ == "__main__":
    main()
