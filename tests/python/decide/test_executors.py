"""Decisions on Dask's worker processes and under MPI come to what they come to on threads, to the bit."""

import json
import shutil
import subprocess
import sys
from concurrent.futures import Executor
from pathlib import Path

import pytest

import drumrs
from drumrs.decide import Target

BASE = drumrs.baseline(fill=0.05).replace({"run.duration": 0.05})
POWER = "drum_specific_power"
RANGES = {"rotation.rpm": [20, 80]}
# Workers need not know a function of one's own: what they return is the run.
TOP = Target.of("top", lambda run: float(run.series["center_of_mass_y"].max()), "m")


def compared(executor: Executor | None, folder: Path) -> object:
    designs = {"slow": BASE.replace({"rotation.rpm": 20.0}), "fast": BASE}
    found = drumrs.compare(designs, TOP, out=folder, most=8, executor=executor, jobs=2, progress=False)
    return found.table().rows()


def screened(executor: Executor | None, folder: Path) -> object:
    plan = {"base": BASE, "ranges": RANGES, "screen": {"trajectories": 4, "points": 0}}
    (found,) = drumrs.screen(plan, [POWER], out=folder, executor=executor, jobs=2, progress=False)
    return found.sentences


def optimized(executor: Executor | None, folder: Path) -> object:
    wanted = {"minimize": POWER, "runs": 5, "batch": 1, "confirm": 2}
    problem = {"base": BASE, "ranges": RANGES, "optimize": wanted}
    return drumrs.optimize(problem, folder, executor=executor, jobs=2, progress=False).sentence


def calibrated(executor: Executor | None, folder: Path) -> object:
    measured = [{"target": POWER, "value": 1.0, "error": 0.5}]
    experiment = {"base": BASE, "ranges": RANGES, "measured": measured, "calibrate": {"runs": 6}}
    found = drumrs.calibrate(experiment, folder, executor=executor, jobs=2, progress=False)
    return found.table.rows()


DECISIONS = {one.__name__: one for one in (compared, screened, optimized, calibrated)}


def decide(executor: Executor | None, folder: Path) -> object:
    """Return what all decisions come to, as JSON leaves it."""
    return json.loads(json.dumps({name: one(executor, folder / name) for name, one in DECISIONS.items()}))


@pytest.fixture(scope="module")
def threaded(tmp_path_factory):
    return decide(None, tmp_path_factory.mktemp("threads"))


@pytest.fixture(scope="module")
def on_dask(tmp_path_factory):
    from distributed import LocalCluster

    local = LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with local as cluster, cluster.get_client() as client, client.get_executor() as executor:
        return decide(executor, tmp_path_factory.mktemp("dask"))


@pytest.fixture(scope="module")
def on_mpi(tmp_path_factory):
    """One rank decides, two simulate."""
    start, folder = Path(sys.executable).with_name("mpiexec"), tmp_path_factory.mktemp("mpi")
    launcher = str(start) if start.exists() else shutil.which("mpiexec")
    assert launcher, "no mpiexec: install the wheel mpich, or an MPI"
    command = [launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures", __file__, str(folder)]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert ran.returncode == 0, ran.stderr
    return json.loads((folder / "decided.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", DECISIONS)
def test_dask(threaded, on_dask, name):
    assert on_dask[name] == threaded[name]


@pytest.mark.parametrize("name", DECISIONS)
def test_mpi(threaded, on_mpi, name):
    assert on_mpi[name] == threaded[name]


def main(folder: Path) -> None:
    """Decide; called by mpiexec."""
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as executor:
        found = decide(executor, folder)
    (folder / "decided.json").write_text(json.dumps(found), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
