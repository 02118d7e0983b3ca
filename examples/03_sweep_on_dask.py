"""
A sweep on Dask
===============

Here two worker processes of this machine, on a cluster whatever Dask starts there.

Needs ``pip install 'drumrs[cluster]'``. The folder of the results has to be reached by all workers under one name.
"""

import argparse
from pathlib import Path

from distributed import LocalCluster

import drumrs


def main() -> None:
    """Start a cluster, lend it to a sweep, say what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--small", action="store_true", help="a moment of each case only")
    parser.add_argument("--out", type=Path, default=Path("out/dask"), help="folder of the results")
    options = parser.parse_args()

    base = drumrs.baseline().replace({"run.duration": 0.1 if options.small else 30.0})
    fills = [0.05, 0.1] if options.small else [0.2, 0.4, 0.6]
    sweep = drumrs.Sweep(base, axes={"load.fill": fills, "contact.bundle.friction": [0.1, 0.5]})

    # A simulation of a few hundred bundles keeps one core busy, hence one thread a worker. On a cluster, put
    # dask_jobqueue.SLURMCluster(cores=1, ...) in this place, scale it, and leave the rest as it is.
    local = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with local as cluster, cluster.get_client() as client, client.get_executor() as executor:
        outcome = sweep.run(options.out.absolute(), executor)
    print(f"{outcome.finished} of {len(sweep)} cases are finished, {outcome.computed} of them just now")
    print(sweep.table().select("load.fill", "contact.bundle.friction", "drum_specific_power").collect())


# Worker processes import this file again: what starts them must not run there.
if __name__ == "__main__":
    main()
