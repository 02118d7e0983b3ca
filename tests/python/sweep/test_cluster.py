"""Sweeps on Dask's worker processes and under MPI leave the very bytes that threads leave."""

import shutil
import subprocess
import sys
from concurrent.futures import Executor
from pathlib import Path

import pytest

import drumrs

BASE = drumrs.baseline().replace({"run.duration": 0.05, "run.frame_every": 0.02})


def design() -> drumrs.Sweep:
    return drumrs.Sweep(BASE, {"load.fill": [0.05, 0.9], "drum.baffles.count": [0, 3]}, seeds=2)


def run_on(executor: Executor | None, folder: Path) -> None:
    sweep = design()
    outcome = sweep.run(folder, executor, progress=False)
    assert (outcome.finished, outcome.computed, len(outcome.failures)) == (4, 4, 4)
    sweep.write_table()


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(".facts.json")
    }


@pytest.fixture(scope="module")
def threaded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("threads")
    run_on(None, folder)
    return contents(folder)


def test_dask(threaded, tmp_path):
    from distributed import LocalCluster

    local = LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with local as cluster, cluster.get_client() as client, client.get_executor() as executor:
        run_on(executor, tmp_path)
    assert contents(tmp_path) == threaded


def test_mpi(threaded, tmp_path):
    """One rank hands out, two simulate."""
    start = Path(sys.executable).with_name("mpiexec")
    launcher = str(start) if start.exists() else shutil.which("mpiexec")
    assert launcher, "no mpiexec: install the wheel mpich, or an MPI"
    command = [launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures", __file__, str(tmp_path)]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.split() == ["2", "workers"]
    assert contents(tmp_path) == threaded


def main(folder: Path) -> None:
    """Run the sweep; called by mpiexec."""
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as executor:
        sys.stdout.write(f"{executor.num_workers} workers\n")
        run_on(executor, folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
