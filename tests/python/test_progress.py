"""Tasks without a terminal: when lines come, what they say, and which display shows them."""

import re
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import drumrs
from drumrs import progress
from drumrs.progress import ProgressDisplay, Task


@pytest.fixture
def soon(monkeypatch):
    """Let lines come every few milliseconds."""
    monkeypatch.setattr(progress, "_FIRST_PAUSES", (0.01,))
    monkeypatch.setattr(progress, "_PAUSE", 0.01)


@pytest.fixture
def clock(monkeypatch):
    """A clock that stands still until it is told."""
    now = [100.0]
    monkeypatch.setattr("drumrs.progress.time.perf_counter", lambda: now[0])
    return now


def test_rate_and_time_left_count_from_where_a_task_goes_on(clock):
    with Task("run", 10e6, "particle-steps", done=6e6, show=False) as task:
        assert str(task) == "run: 60%, time left not known yet"
        clock[0] += 2.0
        task.update(8e6, "4 of 5 s")
        assert str(task) == "run: 80%, 4 of 5 s, 1.0 M particle-steps/s, 2 s left"
        clock[0] += 1.0
        task.advance(2e6)
    clock[0] += 50.0
    assert str(task) == "run: 100%, 4 of 5 s, 1.3 M particle-steps/s, 3 s taken"


def test_a_task_of_unknown_size_tells_its_time(clock):
    with Task("packing 50000 bundles", 0, show=False) as task:
        clock[0] += 90.0
        assert str(task) == "packing 50000 bundles: 1 min 30 s taken"


@pytest.mark.usefixtures("soon")
def test_lines_come_even_where_nothing_is_told(capsys):
    with Task("packing", 0):
        time.sleep(0.1)
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) >= 2
    assert all(re.fullmatch(r"packing: \d+ s taken", line) for line in lines)


def test_what_is_soon_over_says_nothing(capsys, short, monkeypatch):
    monkeypatch.setattr(progress, "_FIRST_PAUSES", (10.0,))
    drumrs.run(short.replace({"run.duration": 0.01, "run.frame_every": 0.01}))
    assert capsys.readouterr().err == ""


@pytest.mark.usefixtures("soon")
def test_a_run_tells_its_size_and_an_estimate_first(capsys, short):
    drumrs.run(short.replace({"run.duration": 0.5}))
    first = capsys.readouterr().err.splitlines()[0]
    assert first.startswith("40 bundles, 135.1 k steps: ")
    assert " of 0.50 s" in first
    assert first.endswith((" left", "time left not known yet", " taken"))


@pytest.mark.usefixtures("soon")
def test_tasks_open_together_share_a_display(capsys):
    with Task("outer", 2, "cases") as outer:
        display = ProgressDisplay._current

        def inner(number: int) -> None:
            with Task(f"inner {number}", 1) as task:
                assert task._display is display
                time.sleep(0.05)
                outer.advance()

        with ThreadPoolExecutor(2) as pool:
            list(pool.map(inner, (1, 2)))
        assert ProgressDisplay._current is display
        assert display.tasks == [outer]
    assert ProgressDisplay._current is None
    assert outer.share == 1.0
    lines = capsys.readouterr().err
    assert all(f"{name}: " in lines for name in ("outer", "inner 1", "inner 2"))


def test_a_failure_within_a_task_ends_its_display():
    with pytest.raises(ZeroDivisionError), Task("division", 1):
        _ = 1 / 0
    assert ProgressDisplay._current is None


def test_many_threads_advance_one_task():
    with Task("cases", 4000, show=False) as task, ThreadPoolExecutor(8) as pool:
        for _ in range(4000):
            pool.submit(task.advance)
    assert task.done == 4000
