"""`drumrs sweep` as it is used: a sweep file, a killed process, Ctrl-C, two at once, a job array, a full disk."""

import contextlib
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import polars as pl
import pytest

from drumrs.sweep import read_sweep
from slowdown import slowdown

SWEEP = """
seeds = 2
[base]
run.duration = 0.08
run.frame_every = 0.04
[axes]
load.fill = [0.05, 0.1]
drum.baffles.count = [0, 3]
"""


@pytest.fixture
def sweep_file(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(SWEEP)
    return path


def apart_from_progress(told: str) -> str:
    """Leave out the lines of progress, which a slow machine makes appear."""
    return "".join(line for line in told.splitlines(keepends=True) if not re.search(r": \d+%, ", line))


def start(sweep_file, out, *words: str, **options) -> subprocess.Popen:
    command = [sys.executable, "-m", "drumrs", "sweep", sweep_file, "--out", out, *words]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


def contents(folder) -> dict[str, bytes]:
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(".facts.json")
    }


def records(folder) -> list[str]:
    """Names of the cases whose record of completion is there."""
    return sorted(
        path.stem
        for path in folder.glob("*.parquet")
        if path.name.count(".") == 1 and path.stem not in {"table", "plan"}
    )


def wait_for(process, condition) -> None:
    end = time.monotonic() + 30
    while not condition():
        assert process.poll() is None, "it was over too soon to test anything"
        assert time.monotonic() < end
        time.sleep(0.002)


def test_a_sweep_prints_and_writes_its_table(drum, sweep_file, tmp_path):
    out = tmp_path / "out"
    status, printed, complaint = drum("sweep", sweep_file, "--out", out, "--jobs", "2")
    assert (status, complaint) == (0, "")
    heads = [re.split(r" {2,}", line.strip()) for line in printed.splitlines()[:2]]
    assert heads[0] == ["drum specific", "dissipation"]
    assert heads[1] == ["case", "baffles.count", "load.fill", "seed", "power [W/kg]", "ratio"]
    assert len(printed.splitlines()) == 2 + 8 + 1
    assert printed.splitlines()[-1] == f"wrote {out / 'table.parquet'}"
    table = pl.read_parquet(out / "table.parquet")
    assert table.select("drum.baffles.count", "load.fill", "seed").rows() == [
        (count, fill, seed) for count in (0, 3) for fill in (0.05, 0.1) for seed in (0, 1)
    ]
    shown = [line.split()[0] for line in printed.splitlines()[2:-1]]
    assert [case[:8] for case in table["case"]] == shown
    assert drum("sweep", sweep_file, "--out", out, "--seeds", "3")[0] == 0
    assert pl.read_parquet(out / "table.parquet").height == 12


def test_failures_are_listed_and_make_the_status_1(drum, sweep_file, tmp_path):
    sweep_file.write_text(SWEEP.replace("[0.05, 0.1]", "[0.05, 0.9]"))
    for _ in range(2):
        status, printed, complaint = drum("sweep", sweep_file, "--out", tmp_path / "out", "--seeds", "1")
        assert status == 1
        assert len(printed.splitlines()) == 2 + 2 + 1
        lines = complaint.splitlines()
        assert len(lines) == 3
        assert "(drum.baffles.count = 0, load.fill = 0.9) failed: load.fill is 0.9 (360 bundles)" in lines[0]
        assert lines[2] == "drumrs: 2 of 4 cases failed; --retry runs them again"


def test_a_killed_sweep_goes_on_and_ends_with_the_same_bytes(drum, sweep_file, tmp_path):
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    assert drum("sweep", sweep_file, "--out", whole)[0] == 0
    for least in (1, 3, 5):
        process = start(sweep_file, broken, "--jobs", "1")
        wait_for(process, lambda least=least: len(records(broken)) >= least)
        process.kill()
        process.communicate()
        assert not (broken / "table.parquet").exists()
    kept = {name: (broken / f"{name}.parquet").stat().st_mtime_ns for name in records(broken)}
    assert 5 <= len(kept) < 8
    assert drum("sweep", sweep_file, "--out", broken)[0] == 0
    assert {name: (broken / f"{name}.parquet").stat().st_mtime_ns for name in kept} == kept
    assert {name: data for name, data in contents(broken).items() if not name.endswith(".tmp")} == contents(
        whole
    )


def test_ctrl_c_stops_soon_and_keeps_what_is_finished(sweep_file, tmp_path):
    out = tmp_path / "out"
    sweep_file.write_text(
        SWEEP.replace("[base]\nrun.duration = 0.08", "[base]").replace(
            "[axes]", "[axes]\nrun.duration = [0.05, 500.0]"
        )
    )
    process = start(sweep_file, out)
    # Long cases come first, and none of them is over soon.
    wait_for(process, (out / "drumrs-sweep.json").exists)
    time.sleep(0.5)
    began = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=30)
    complaint = apart_from_progress(told)
    taken = time.monotonic() - began
    assert process.returncode == 130
    assert (
        complaint
        == "drumrs: interrupted; 0 cases are finished and kept, and the same sweep goes on with the others\n"
    )
    assert taken < 2.0 * slowdown()
    assert not list(out.glob("*.tmp"))


def test_two_sweeps_in_one_folder_do_no_harm(drum, sweep_file, tmp_path):
    both, alone = tmp_path / "both", tmp_path / "alone"
    processes = [start(sweep_file, both, "--jobs", "1") for _ in range(2)]
    for process in processes:
        _, complaint = process.communicate(timeout=60)
        assert (process.returncode, apart_from_progress(complaint)) == (0, "")
    assert drum("sweep", sweep_file, "--out", alone)[0] == 0
    assert contents(both) == contents(alone)


def test_a_job_array_shares_the_cases(drum, sweep_file, tmp_path):
    parts, whole = tmp_path / "parts", tmp_path / "whole"
    status, printed, _ = drum("sweep", sweep_file, "--out", parts, "--shard", "1/2")
    assert (status, printed) == (0, "4 cases are left to the other shards; the last one writes the table\n")
    assert not (parts / "table.parquet").exists()
    assert drum("sweep", sweep_file, "--out", parts, "--shard", "2/2")[0] == 0
    assert drum("sweep", sweep_file, "--out", whole)[0] == 0
    assert contents(parts) == contents(whole)


def test_the_slurm_script_runs_its_part(drum, sweep_file, tmp_path):
    script = Path(__file__).parents[3] / "examples" / "05_slurm_array.sh"
    command = tmp_path / "bin" / "drumrs"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m drumrs "$@"\n')
    command.chmod(0o755)
    own = {"SWEEP": str(sweep_file), "OUT": str(tmp_path / "parts"), "SLURM_ARRAY_TASK_COUNT": "2"}
    path = f"{command.parent}:{os.environ['PATH']}"
    for task in ("1", "2"):
        assert not (tmp_path / "parts" / "table.parquet").exists()
        environment = {**os.environ, **own, "PATH": path, "SLURM_ARRAY_TASK_ID": task}
        subprocess.run([shutil.which("bash"), script], env=environment, check=True, capture_output=True)
    assert drum("sweep", sweep_file, "--out", tmp_path / "whole")[0] == 0
    assert contents(tmp_path / "parts") == contents(tmp_path / "whole")


def test_the_study_of_the_slurm_script_is_one(tmp_path):
    script = Path(__file__).parents[3] / "examples" / "05_slurm_array.sh"
    sweep_file = re.search(r"<<'TOML'\n(.*?)\nTOML", script.read_text(), re.DOTALL)
    (tmp_path / "sweep.toml").write_text(sweep_file.group(1))
    assert len(read_sweep(tmp_path / "sweep.toml")) == 60


def test_a_quota_is_met_in_a_sentence(sweep_file, tmp_path):
    """No file of this process may be larger than a summary: the first one is not finished."""
    out = tmp_path / "out"
    quota = (20_000, 20_000)
    process = start(sweep_file, out, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, quota))
    _, complaint = process.communicate(timeout=60)
    assert process.returncode == 1
    assert apart_from_progress(complaint).count("\n") == 1
    assert f"cannot write to {str(out)!r}: File too large; 0 cases are finished and kept" in complaint
    assert not list(out.glob(".*"))
    assert not records(out)


def test_progress_counts_cases_and_cost(sweep_file, tmp_path):
    """Where nobody looks there are lines; here their pauses are short."""
    code = (
        "import drumrs.progress, sys; from drumrs.cli import run_command; "
        "drumrs.progress._FIRST_PAUSES, drumrs.progress._PAUSE = (0.05,), 0.05;"
        f"sys.exit(run_command(['sweep', {str(sweep_file)!r}, '--out', {str(tmp_path / 'out')!r}, '--jobs', '1']))"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    ran = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True
    )
    lines = ran.stderr.splitlines()
    assert lines
    for line in lines:
        assert line.startswith("sweep: ")
        assert " of 8 cases, " in line
        assert line.endswith((" left", " left not known yet", " taken"))


def test_progress_is_a_bar_in_a_terminal(sweep_file, tmp_path):
    leader, follower = os.openpty()
    command = [sys.executable, "-m", "drumrs", "sweep", sweep_file, "--out", tmp_path / "out"]
    wide = {**os.environ, "TERM": "xterm", "COLUMNS": "160"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=follower, env=wide)
    os.close(follower)
    shown = b""
    # The terminal's other end is gone once the process is over.
    with contextlib.suppress(OSError):
        while data := os.read(leader, 1 << 16):
            shown += data
    os.close(leader)
    assert process.wait(timeout=60) == 0
    process.communicate()
    assert b" of 8 cases" in shown
    assert b"8 of 8 cases" in shown
    assert b"particle-steps/s" in shown
    assert b"left" in shown
