"""Cases one by one, as workflow engines run them, and how far a folder is, as it tells by itself."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.sweep import read_sweep, status
from drumrs.sweep.runner import Runner, is_at_work
from drumrs.sweep.store import Store

SWEEP = """
seeds = 2
[base]
run.duration = 0.06
run.frame_every = 0.03
[axes]
load.fill = [0.05, 0.1]
"""


@pytest.fixture
def sweep_file(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(SWEEP)
    return path


def contents(folder) -> dict[str, bytes]:
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(".facts.json")
    }


def test_a_plan_names_every_case_and_runs_nothing(drum, sweep_file, tmp_path):
    cases = read_sweep(sweep_file).cases
    lines = [f"{case.id}\tload.fill={case.config.load.fill}\trun.seed={case.seed}" for case in cases]
    assert drum("sweep", sweep_file, "--plan") == (0, "".join(f"{line}\n" for line in lines), "")
    out = tmp_path / "out"
    status_, printed, complaint = drum("sweep", sweep_file, "--plan", "--out", out)
    assert (status_, printed.splitlines(), complaint) == (0, lines, "")
    files = {f"{case.id}.toml" for case in cases}
    assert {path.name for path in out.iterdir()} == files | {"drumrs-sweep.json", "plan.parquet"}
    for case in cases:
        assert drumrs.Config.read(out / f"{case.id}.toml") == case.config


def test_cases_one_by_one_leave_the_bytes_of_a_sweep(drum, sweep_file, tmp_path, monkeypatch):
    cases = read_sweep(sweep_file).cases
    alone, whole = tmp_path / "alone", tmp_path / "whole"
    assert drum("sweep", sweep_file, "--out", whole)[0] == 0
    assert drum("sweep", sweep_file, "--plan", "--out", alone)[0] == 0
    with pytest.MonkeyPatch.context() as patch:
        # The files that the plan has left are enough.
        patch.setattr("drumrs.cli.sweep.read_sweep", None)
        first = cases[0].id
        assert drum("sweep", sweep_file, "--out", alone, "--case", first) == (0, f"{first} is finished\n", "")
    assert {path.name for path in alone.glob("*.facts.json")} == {f"{first}.facts.json"}
    words = [word for case in cases[1:] for word in ("--case", case.id[:10])]
    assert drum("sweep", sweep_file, "--out", alone, *words)[0] == 0
    monkeypatch.setattr("drumrs.sweep.worker.Simulation", None)
    assert drum("sweep", sweep_file, "--out", alone, "--case", first)[0] == 0
    assert drum("sweep", sweep_file, "--out", alone)[0] == 0
    assert contents(alone) == contents(whole)


def test_a_case_without_a_plan_and_twice_at_once(sweep_file, tmp_path):
    case = read_sweep(sweep_file).cases[0]
    command = [sys.executable, "-m", "drumrs", "sweep", sweep_file, "--out", "out", "--case", case.id]
    both = [subprocess.Popen(command, cwd=tmp_path) for _ in range(2)]
    assert [process.wait(timeout=120) for process in both] == [0, 0]
    sweep = drumrs.Sweep.from_configs([case.config])
    assert sweep.run(tmp_path / "out", progress=False).computed == 0
    assert sweep.run(tmp_path / "again", progress=False).computed == 1
    assert contents(tmp_path / "out") == contents(tmp_path / "again")


def test_a_case_file_that_was_changed_is_not_the_case(drum, sweep_file, tmp_path):
    out = tmp_path / "out"
    assert drum("sweep", sweep_file, "--plan", "--out", out)[0] == 0
    case = read_sweep(sweep_file).cases[0]
    path = out / f"{case.id}.toml"
    path.write_text(path.read_text().replace("fill = 0.05", "fill = 0.06"))
    assert drum("sweep", sweep_file, "--out", out, "--case", case.id)[0] == 0
    assert drumrs.Config.read(path) == case.config


def test_a_case_that_fails_is_run_again_when_asked(drum, sweep_file, tmp_path):
    sweep_file.write_text(SWEEP.replace("[0.05, 0.1]", "[0.05, 0.9]"))
    case = read_sweep(sweep_file).cases[2].id
    for words in ((), (), ("--retry",)):
        status_, printed, complaint = drum(
            "sweep", sweep_file, "--out", tmp_path / "out", "--case", case, *words
        )
        assert (status_, printed) == (1, "")
        assert complaint.splitlines()[0].startswith(f"drumrs: case {case} (")
        assert "failed: load.fill is 0.9 (360 bundles)" in complaint


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((), "--out is missing; give the folder of the results: --out FOLDER"),
        (("--out", "out", "--case", "zz"), "--case is 'zz', but must be the id of one case of"),
        (("--out", "out", "--case", ""), "0 of 4 cases have such an id; --plan lists them"),
        (
            ("--out", "out", "--case", "0", "--shard", "1/2"),
            "--case is '0', but must be given without --shard",
        ),
        (
            ("--plan", "--shard", "1/2"),
            "--plan runs nothing, so --case, --shard and --retry do not go with it",
        ),
    ],
)
def test_bad_words_for_single_cases(drum, sweep_file, tmp_path, monkeypatch, words, sentence):
    monkeypatch.chdir(tmp_path)
    status_, printed, complaint = drum("sweep", sweep_file, *words)
    assert (status_, printed, complaint.count("\n")) == (2, "", 1)
    assert sentence in complaint
    assert not (tmp_path / "out").exists()


def test_the_status_of_a_folder(drum, sweep_file, tmp_path):
    out = tmp_path / "out"
    sweep_file.write_text(SWEEP.replace("[0.05, 0.1]", "[0.05, 0.1, 0.9]"))
    cases = read_sweep(sweep_file).cases
    assert drum("sweep", sweep_file, "--plan", "--out", out)[0] == 0
    assert drum("status", out) == (4, "0 of 6 cases are finished\n6 left\n", "")
    drum("sweep", sweep_file, "--out", out, "--case", cases[0].id, "--case", cases[4].id)
    fresh, old = cases[1].id, cases[2].id
    for case, age in ((fresh, 20.0), (old, 3600.0)):
        path = out / f"{case}.checkpoint.bin"
        path.write_bytes(b"")
        os.utime(path, (time.time() - age, time.time() - age))
        # Of a machine of which nothing is known here, the age of the checkpoint tells.
        (out / f"{case}.runner.json").write_text('{"machine": "another", "process": 1, "began": 1}')
    sweep_file.unlink()
    status_, printed, _ = drum("status", out)
    assert status_ == 4
    lines = printed.splitlines()
    assert lines[:3] == ["1 of 6 cases are finished", "1 failed, see ID.error.json", f"  {cases[4].id}"]
    assert lines[3] == "1 under way"
    assert lines[4].startswith(f"  {fresh}, checkpoint 2")
    assert lines[5] == "1 stopped, and go on from there when run again"
    assert lines[7].startswith("4 left, ")
    assert lines[7].endswith(" core-hours")
    status_, printed, _ = drum("status", out, "--json")
    told = json.loads(printed)
    assert status_ == 4
    assert (told["planned"], told["finished"], told["failed"], told["left"]) == (6, 1, [cases[4].id], 4)
    assert told["running"].keys() == {fresh}
    assert told["stopped"].keys() == {old}
    assert told["stopped"][old] == pytest.approx(3600.0, abs=60.0)
    facts = json.loads((out / f"{cases[0].id}.facts.json").read_text())
    particle_steps = sum(cases[number].cost for number in (1, 2, 3, 5))
    expected = particle_steps / facts["particle_steps_per_second"] / 3600.0
    assert told["core_hours_left"] == pytest.approx(expected, rel=1e-6)


WORKING = """
import sys
from drumrs.sweep import read_sweep, worker
from drumrs.sweep.worker import run_case
worker._WORTH = 0.0
case = read_sweep(sys.argv[1]).cases[0]
run_case(case.config.model_dump_json(), sys.argv[2])
"""


@pytest.mark.skipif(
    not Path("/proc/self/ns/pid").exists(), reason="the system does not tell of its processes"
)
def test_a_case_that_was_killed_is_not_taken_for_one_under_way(sweep_file, tmp_path):
    out = tmp_path / "out"
    sweep_file.write_text(
        SWEEP.replace("run.duration = 0.06", "run.duration = 4000.0\nrun.checkpoint_every = 0.1").replace(
            "run.frame_every = 0.03", "run.frame_every = 4000.0"
        )
    )
    [case, *_] = read_sweep(sweep_file).cases
    Store(out).open()
    with subprocess.Popen([sys.executable, "-c", WORKING, sweep_file, out]) as working:
        while not (out / f"{case.id}.checkpoint.bin").exists():
            assert working.poll() is None
            time.sleep(0.02)
        found = status(out)
        assert (found.running.keys(), found.stopped.keys()) == ({case.id}, set())
        working.kill()
        # Nobody has asked how it has ended, and its checkpoint is new; nobody works on it all the same.
        waited_from = time.monotonic()
        while (found := status(out)).running and time.monotonic() < waited_from + 30.0:
            time.sleep(0.02)
        assert found.stopped[case.id] < 60.0
    found = status(out)
    assert (found.running.keys(), found.stopped.keys()) == (set(), {case.id})
    # Another process with the same number, as it may be some time later.
    mark = out / f"{case.id}.runner.json"
    mark.write_text(json.dumps({**json.loads(mark.read_text()), "process": os.getpid()}))
    assert status(out).stopped.keys() == {case.id}


def test_a_mark_is_its_owners(tmp_path):
    path = tmp_path / "mark"
    runner = Runner(path)
    assert is_at_work(path) is False
    runner.mark()
    assert is_at_work(path) is not False
    runner.clear()
    assert not path.exists()
    path.write_text('{"machine": "another"}')
    runner.clear()
    assert path.exists()
    for text in ("", "[1]", '{"machine": "another"}'):
        path.write_text(text)
        assert is_at_work(path) is None


def test_the_status_says_when_all_is_done(drum, sweep_file, tmp_path):
    out = tmp_path / "out"
    sweep_file.write_text(SWEEP.replace("0.1]", "0.9]"))
    assert drum("sweep", sweep_file, "--out", out)[0] == 1
    assert drum("status", out)[0] == 1
    sweep_file.write_text(SWEEP.replace(", 0.1]", "]"))
    assert drum("sweep", sweep_file, "--out", out)[0] == 0
    assert drum("status", out) == (0, "2 of 2 cases are finished\n0 left\n", "")
    (out / "plan.parquet").unlink()
    status_, printed, _ = drum("status", out)
    assert status_ == 1
    assert "how many are left is not known here: the folder has no list of a sweep's cases" in printed
    (out / "plan.parquet").write_bytes(b"other")
    with pytest.raises(ConfigError, match=r"plan\.parquet' is damaged or no list of a sweep's cases"):
        status(out)
    status_, _, complaint = drum("status", tmp_path)
    assert status_ == 2
    assert "must be the folder of a sweep, with a file drumrs-sweep.json in it" in complaint
