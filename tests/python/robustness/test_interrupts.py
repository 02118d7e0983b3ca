"""Ctrl-C in every long call of the command line: heard soon, one sentence, status 130, and what is finished is kept."""

import os
import re
import signal
import subprocess
import sys
import time

import polars as pl
import pytest

import drumrs
from slowdown import slowdown

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
# The command line, which says when it enters a function: there it is interrupted, a moment later.
CHILD = """
import importlib, os
{before}
module = importlib.import_module({module!r})
real = getattr(module, {name!r})
def entered(*arguments, **options):
    os.write(1, b"entered\\n")  # in one piece, as two threads may enter
    return real(*arguments, **options)
setattr(module, {name!r}, entered)
from drumrs.cli import main
main({words!r})
"""
# A study of a second. Who interrupts the first import of matplotlib's fonts may see the interpreter abort at its exit.
TINY = """
import matplotlib.ft2font
from dataclasses import replace
from small_study import SMALL
from drumrs.paper import scales
tiny = replace(SMALL, duration=0.2, window=(0.1, 0.2), fills=(0.05,), fills_with_baffles=(0.05,), frictions=(0.5,))
scales.SCALES = {"quick": tiny}
"""
LONG = ["--set", "run.duration=500"]
UNTIL = ["--set", "load.count=20", "--set", "run.duration=0.2", "--set", "run.window=[0.1, 0.2]"]
UNTIL += ["--until", "0.0001", "--limit", "900"]
DEAR = [word for name in ("three-powers", "time-step", "threads") for word in ("--only", name)]
LARGE = ["--set", "load.diameter=0.0008", "--set", "load.fill=0.7", "--set", "run.time_step=auto"]

# Where, after which lines of Python, which command; what it says.
CALLS = {
    "packing": ("drumrs.cli.run.Simulation", "", ["run", *LARGE], "interrupted"),
    "until": (
        "drumrs.precision._next_end",
        "",
        ["run", *UNTIL, "--out", "out"],
        r"interrupted at t = \d+\.\d+ s; go on with: drumrs run --resume out --until 0.0001 --limit 900",
    ),
    "baseline": ("drumrs.runs.advance_to_end", "", ["baseline", *LONG], "interrupted"),
    "verification": ("drumrs.verification.runner._run", "", ["verify", *DEAR], "interrupted"),
    "study": (
        "drumrs.sweep.scheduler._schedule",
        "",
        ["reproduce", "--quick"],
        "interrupted; 0 cases are finished and kept, and the same sweep goes on with the others",
    ),
    "report": ("drumrs.paper.reproduction.write", TINY, ["reproduce", "--quick"], "interrupted"),
}


def interrupted(folder, where, before, words) -> tuple[int, str, float]:
    """Interrupt a call; return its status, what it complained of, and how long that took."""
    module, _, name = where.rpartition(".")
    code = CHILD.format(module=module, name=name, before=before, words=words)
    child = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        env=ENVIRONMENT,
    )
    assert child.stdout.readline() == "entered\n", child.communicate()[1]
    time.sleep(0.2)
    asked = time.monotonic()
    child.send_signal(signal.SIGINT)
    _, complaint = child.communicate(timeout=60)
    return child.returncode, complaint, time.monotonic() - asked


@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_is_heard_soon(call, tmp_path):
    where, before, words, says = CALLS[call]
    status, complaint, took = interrupted(tmp_path, where, before, words)
    assert status == 130, complaint
    # The last line; what was announced before stands above it.
    assert re.fullmatch(f"drumrs: {says}", complaint.splitlines()[-1]), complaint
    assert "Traceback" not in complaint
    assert took < 2.0 * slowdown()
    assert not list(tmp_path.rglob("*.tmp"))
    if call == "until":
        assert drumrs.Simulation.load(tmp_path / "out" / "checkpoint.bin").time > 0.2
    if call == "report":
        runs = tmp_path / "out" / "runs"
        assert pl.read_parquet(tmp_path / "out" / "table.parquet").height == len(
            list(runs.glob("*.facts.json"))
        )
        assert not (tmp_path / "out" / "report.html").exists()


def test_ctrl_c_within_an_import_is_no_traceback(drum, tmp_path, monkeypatch):
    """Modules made with pybind11 tell of it so."""

    def torn() -> None:
        raise ImportError("initialization failed") from KeyboardInterrupt()

    def missing() -> None:
        raise ImportError("no such module")

    monkeypatch.setattr("drumrs.runs.Task", lambda *_, **__: torn())
    status, printed, complaint = drum("baseline", "--out", tmp_path)
    assert (status, printed, complaint.splitlines()[-1]) == (130, "", "drumrs: interrupted")
    monkeypatch.setattr("drumrs.runs.Task", lambda *_, **__: missing())
    with pytest.raises(ImportError):
        drum("baseline", "--out", tmp_path)


PROCESSES = """
import drumrs
if __name__ == "__main__":
    base = drumrs.baseline(fill=0.05).replace({"run.frame_every": 1000.0})
    sweep = drumrs.Sweep(base, {"run.duration": [0.05, 500.0]})
    try:
        sweep.run("out", executor="processes", jobs=2, progress=False)
    except KeyboardInterrupt as interrupt:
        print(interrupt)
"""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_workers_end_with_the_process_that_they_work_for(tmp_path, number):
    (tmp_path / "many.py").write_text(PROCESSES)
    words = [sys.executable, "many.py"]
    child = subprocess.Popen(words, cwd=tmp_path, env=ENVIRONMENT, start_new_session=True)
    end = time.monotonic() + 60.0
    while not list(tmp_path.glob("out/*.facts.json")) and time.monotonic() < end:
        time.sleep(0.05)
    child.send_signal(number)
    child.wait()
    end = time.monotonic() + 20.0
    while _group_is_alive(child.pid) and time.monotonic() < end:
        time.sleep(0.05)
    alive = _group_is_alive(child.pid)
    if alive:
        os.killpg(child.pid, signal.SIGKILL)
    assert not alive


def test_a_script_without_a_main_guard_gets_a_sentence(tmp_path):
    guard = 'if __name__ == "__main__":'
    (tmp_path / "many.py").write_text(PROCESSES.replace(guard, "if True:").replace(", 500.0", ", 0.06"))
    ran = subprocess.run(
        [sys.executable, "many.py"],
        cwd=tmp_path,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 1
    assert ran.stderr.count("Traceback") == 1
    assert ran.stderr.rstrip().endswith(
        "executor starts processes that end before they work; each of them imports the script that runs the sweep: let "
        f"what it does stand under {guard}"
    )
    assert not list(tmp_path.glob("out/*.facts.json"))


def _group_is_alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize(
    ("seen", "count", "most"), [("drumrs-sweep.json", 0, 5.0), ("?" * 20 + ".parquet", 1, 2.0)]
)
def test_ctrl_c_stops_the_processes_of_a_sweep(tmp_path, seen, count, most):
    """As from a terminal, every process of the group gets the signal: while they import, and when they run."""
    (tmp_path / "many.py").write_text(PROCESSES)
    child = subprocess.Popen(
        [sys.executable, "many.py"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=tmp_path,
        env=ENVIRONMENT,
        start_new_session=True,
    )
    end = time.monotonic() + 60.0
    while not list(tmp_path.glob(f"out/{seen}")) and time.monotonic() < end:
        time.sleep(0.05)
    time.sleep(0.5)  # the sweep has to hear of it
    asked = time.monotonic()
    os.killpg(child.pid, signal.SIGINT)
    printed, complaint = child.communicate(timeout=60)
    taken = time.monotonic() - asked
    assert complaint == ""
    assert printed.startswith(f"interrupted; {count} cases are finished and kept")
    # Who imports is not torn out of it.
    assert taken < most * slowdown()
