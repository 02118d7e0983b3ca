"""Where results go: disks that fill up, clocks that go back, folders shared by processes that are killed at any moment.

`tests/endurance` has the long forms.
"""

import os
import re
import subprocess
import sys

import pytest

SWEEP = """
seeds = 4
[base]
run.duration = 0.05
run.sample_every = 0.001
run.frame_every = 0.02
load.fill = 0.05
"""
RUN = ["run", "--set", "run.duration=0.2", "--set", "load.fill=0.05"]
# What differs from run to run, and what is drawn from it.
TIMED = ("facts.json", "summary.json", "checkpoint.bin", ".tmp")


def contents(folder) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(TIMED)}


def start(*words, before: str = "") -> subprocess.Popen:
    """Start the command line in a process of its own, after some lines of Python."""
    code = f"{before}\nfrom drumrs.cli import main\nmain({[str(word) for word in words]!r})"
    return subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )


def ended(child: subprocess.Popen) -> tuple[int, str]:
    _, told = child.communicate(timeout=120)
    # A run begins with a line of facts, and a slow machine makes lines of progress appear.
    lines = [
        line
        for line in told.splitlines(keepends=True)
        if not re.search(r": \d+%, |steps per collision", line)
    ]
    return child.returncode, "".join(lines)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A sweep file, and the folder of a sweep of it that nothing has disturbed."""
    root = tmp_path_factory.mktemp("whole")
    (root / "sweep.toml").write_text(SWEEP)
    assert ended(start("sweep", root / "sweep.toml", "--out", root / "out")) == (0, "")
    return root / "sweep.toml", contents(root / "out")


def test_two_processes_share_a_folder(whole, tmp_path):
    path, expected = whole
    children = [start("sweep", path, "--out", tmp_path / "out") for _ in range(2)]
    assert [ended(child) for child in children] == [(0, ""), (0, "")]
    assert contents(tmp_path / "out") == expected


@pytest.mark.parametrize("clock", ["itertools.count(4e9, -1e5).__next__"])
def test_nothing_depends_on_the_clock(whole, tmp_path, clock):
    path, expected = whole
    before = f"import itertools, time\ntime.time = {clock}"
    assert ended(start("sweep", path, "--out", tmp_path / "out", before=before)) == (0, "")
    assert contents(tmp_path / "out") == expected


def test_a_killed_sweep_goes_on(whole, tmp_path):
    path, expected = whole
    for wait in (0.7, 1.1, 1.5):
        child = start("sweep", path, "--out", tmp_path / "out")
        try:
            child.wait(timeout=wait)
        except subprocess.TimeoutExpired:
            child.kill()
        child.communicate()
    assert ended(start("sweep", path, "--out", tmp_path / "out")) == (0, "")
    assert contents(tmp_path / "out") == expected


@pytest.mark.parametrize("command", ["sweep", "run"])
@pytest.mark.parametrize("most", [1000, 20_000])
def test_a_full_disk_is_one_sentence(whole, tmp_path, command, most):
    """No file may grow beyond so many bytes, as where the disk or a quota is full."""
    words = ["sweep", whole[0]] if command == "sweep" else RUN
    before = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))"
    status, complaint = ended(start(*words, "--out", tmp_path / "out", before=before))
    assert status in {1, 2}, complaint
    assert complaint.count("\n") == 1
    assert "Traceback" not in complaint
    assert not [path for path in (tmp_path / "out").iterdir() if path.name.endswith(".tmp")]
    # With room the same command goes on.
    if command == "sweep":
        assert ended(start(*words, "--out", tmp_path / "out")) == (0, "")
        assert contents(tmp_path / "out") == whole[1]


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_may_not_be_written_is_refused(tmp_path):
    (tmp_path / "out").mkdir(mode=0o500)
    status, complaint = ended(start(*RUN, "--out", tmp_path / "out"))
    assert (status, complaint.count("\n")) == (2, 1)
    assert "must be a folder that can be written" in complaint
