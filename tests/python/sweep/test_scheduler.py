"""Who runs the cases, in which order, and what becomes of a sweep that meets trouble."""

import errno
import json
import os
import threading
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import polars as pl
import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.sweep import Case, run_case, scheduler, worker
from drumrs.sweep.worker import CaseOutcome

BASE = drumrs.baseline(fill=0.05).replace({"run.duration": 0.05, "run.frame_every": 0.05})
SOFT = {
    "contact.bundle.normal_stiffness": 1e3,
    "contact.drum.normal_stiffness": 1e3,
    "run.overlap_limit": 0.01,
}


def contents(folder) -> dict[str, bytes]:
    """Every result file of a folder; timings and machine are apart, and may differ."""
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(".facts.json")
    }


class Recorder(Executor):
    """Threads that note the order of what they are given, and how much of it is in their hands at once."""

    def __init__(self) -> None:
        self.pool = ThreadPoolExecutor(2)
        self.lock = threading.Lock()
        self.order: list[str] = []
        self.in_flight = self.most = 0

    def submit(self, function, /, *arguments):
        self.order.append(json.loads(arguments[0])["load"]["fill"])
        with self.lock:
            self.in_flight += 1
            self.most = max(self.most, self.in_flight)
        future = self.pool.submit(function, *arguments)
        future.add_done_callback(self._landed)
        return future

    def _landed(self, _: Future) -> None:
        with self.lock:
            self.in_flight -= 1


def test_long_cases_first_and_few_at_once(tmp_path):
    recorder = Recorder()
    fills = [0.01 * number for number in range(1, 9)]
    sweep = drumrs.Sweep(BASE, {"load.fill": fills})
    outcome = sweep.run(tmp_path, recorder, jobs=3, progress=False)
    assert recorder.order == fills[::-1]
    assert recorder.most == 3
    assert (outcome.finished, outcome.computed, outcome.left) == (8, 8, 0)


def test_nothing_is_done_twice(tmp_path):
    recorder = Recorder()
    drumrs.Sweep(BASE, {"load.fill": [0.02, 0.05]}).run(tmp_path, progress=False)
    before = contents(tmp_path)
    outcome = drumrs.Sweep(BASE, {"load.fill": [0.03, 0.05, 0.02]}).run(tmp_path, recorder, progress=False)
    assert recorder.order == [0.03]
    assert (outcome.finished, outcome.computed) == (3, 1)
    # The list of cases is that of the last sweep.
    before.pop("plan.parquet")
    assert before.items() <= contents(tmp_path).items()


def test_processes_give_the_same_bytes_as_threads(tmp_path):
    sweep = drumrs.Sweep(BASE, {"load.fill": [0.05, 0.9], "drum.baffles.count": [0, 3]})
    for executor in ("threads", "processes"):
        outcome = sweep.run(tmp_path / executor, executor, jobs=2, progress=False)
        assert (outcome.finished, len(outcome.failures)) == (2, 2)
        sweep.write_table()
    assert contents(tmp_path / "threads") == contents(tmp_path / "processes")


def test_a_failing_case_leaves_its_error_and_the_rest_go_on(tmp_path):
    rows = pl.DataFrame(
        {"load.fill": [0.05, 0.9, 0.3], **{key: [None, None, value] for key, value in SOFT.items()}}
    )
    sweep = drumrs.Sweep.from_rows(BASE.replace({"run.duration": 0.3}), rows)
    outcome = sweep.run(tmp_path, progress=False)
    good, packed, soft = sweep.cases
    assert outcome.finished == 1
    assert [(failure.case, failure.error) for failure in outcome.failures] == [
        (packed, "ConfigError"),
        (soft, "UnstableError"),
    ]
    assert "load.fill is 0.9 (360 bundles)" in outcome.failures[0].message
    for failure in outcome.failures:
        told = json.loads((tmp_path / f"{failure.case.id}.error.json").read_text())
        assert (told["error"], told["message"]) == (failure.error, failure.message)
        assert drumrs.Config.model_validate(told["config"]) == failure.case.config
        assert drumrs.Config.read(tmp_path / f"{failure.case.id}.toml") == failure.case.config
        assert not (tmp_path / f"{failure.case.id}.parquet").exists()
    assert sweep.table().collect()["case"].to_list() == [good.id]


def test_a_worker_reports_a_failure_and_leaves_its_error(tmp_path):
    config = BASE.replace({"load.fill": 0.9})
    told = run_case(config.model_dump_json(), str(tmp_path))
    assert told[:3] == (Case(config).id, "failed", "ConfigError")
    assert json.loads((tmp_path / f"{told.case}.error.json").read_text())["message"] == told.message


def test_a_disk_in_trouble_is_no_fault_of_the_case(tmp_path, monkeypatch):
    def fail(*_):
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr("drumrs.sweep.store.Store.write", fail)
    with pytest.raises(OSError, match="Input/output error"):
        run_case(BASE.model_dump_json(), str(tmp_path))
    assert not list(tmp_path.iterdir())
    with pytest.raises(OSError, match="Input/output error"):
        drumrs.Sweep(BASE).run(tmp_path, progress=False)
    assert not list(tmp_path.glob("*.error.json"))


@pytest.mark.parametrize("harm", ["none", "torn"])
def test_a_long_case_that_was_stopped_goes_on_to_the_same_bytes(harm, tmp_path, monkeypatch):
    config = BASE.replace({"run.duration": 0.1, "run.sample_every": 0.001, "run.frame_every": 0.01})
    drumrs.Sweep(config).run(tmp_path / "whole", progress=False)
    monkeypatch.setattr(worker, "_WORTH", 0.0)
    running, begun = worker.Running(), []

    def stop_early(simulation):
        begun.append(simulation.step)
        on_progress = real(simulation)

        def then_stop(step):
            on_progress(step)
            if len(begun) == 1 and step > 0:
                running.stop()

        return then_stop

    real = running.begin
    monkeypatch.setattr(running, "begin", stop_early)
    told = run_case(config.model_dump_json(), str(tmp_path), running)
    assert told.status == "stopped"
    checkpoint = tmp_path / f"{told.case}.checkpoint.bin"
    assert drumrs.Simulation.load(checkpoint).step > 0
    # Stopped in order, it is nobody's: that is seen from any machine.
    assert not checkpoint.with_name(f"{told.case}.runner.json").exists()
    if harm == "torn":
        checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    running._stopped = False
    told = run_case(config.model_dump_json(), str(tmp_path), running)
    assert told.status == "finished"
    assert begun[0] == 0
    assert (begun[1] > 0) == (harm == "none")
    assert not checkpoint.exists()
    for name in ("parquet", "series.parquet", "frames.parquet"):
        file = f"{told.case}.{name}"
        assert (tmp_path / file).read_bytes() == (tmp_path / "whole" / file).read_bytes()


def test_failures_are_run_again_only_when_asked(tmp_path, monkeypatch):
    sweep = drumrs.Sweep(BASE, seeds=2)

    def fail(_):
        raise MemoryError("no memory for this one")

    with monkeypatch.context() as patch:
        patch.setattr(worker, "Simulation", fail)
        first = sweep.run(tmp_path, progress=False)
    assert [failure.error for failure in first.failures] == ["MemoryError", "MemoryError"]
    second = sweep.run(tmp_path, progress=False)
    assert (second.computed, second.failures) == (0, first.failures)
    third = sweep.run(tmp_path, retry=True, progress=False)
    assert (third.computed, third.finished, third.failures) == (2, 2, ())
    assert not list(tmp_path.glob("*.error.json"))


def test_shards_share_a_folder(tmp_path):
    sweep = drumrs.Sweep(BASE, {"load.fill": [0.02, 0.03, 0.05]})
    first = sweep.run(tmp_path / "parts", shard=(1, 2), progress=False)
    assert (first.finished, first.left) == (2, 1)
    second = sweep.run(tmp_path / "parts", shard=(2, 2), progress=False)
    assert (second.finished, second.left) == (1, 0)
    sweep.run(tmp_path / "whole", progress=False)
    assert contents(tmp_path / "parts") == contents(tmp_path / "whole")


@pytest.mark.parametrize("shard", [(0, 2), (3, 2), (1, 0)])
def test_bad_shard(tmp_path, shard):
    with pytest.raises(ConfigError, match=f"shard is '{shard[0]}/{shard[1]}', but must be k/n"):
        drumrs.Sweep(BASE).run(tmp_path / "out", shard=shard)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"jobs": 0}, "jobs is 0, but must be"),
        ({"jobs": 1.5}, "jobs is 1.5, but must be"),
        ({"jobs": True}, "jobs is True, but must be"),
        ({"executor": "fork"}, "executor is 'fork', but must be"),
        ({"executor": 3}, "executor is 3, but must be"),
    ],
)
def test_bad_executor_or_jobs(tmp_path, arguments, sentence):
    with pytest.raises(ConfigError, match=sentence):
        drumrs.Sweep(BASE).run(tmp_path / "out", **arguments)
    assert not (tmp_path / "out").exists()


def test_processes_that_fork_are_refused(tmp_path):
    import multiprocessing

    refused = pytest.raises(ConfigError, match="executor forks its workers, but must spawn them")
    with ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool, refused:
        drumrs.Sweep(BASE).run(tmp_path / "out", pool)


def test_an_executor_shut_down_is_refused(tmp_path):
    pool = ThreadPoolExecutor(1)
    pool.shutdown()
    with pytest.raises(ConfigError, match="executor takes no work, but must be open"):
        drumrs.Sweep(BASE).run(tmp_path, pool, progress=False)


class Closed(Executor):
    """An executor that refuses in its own way."""

    def submit(self, *_):
        raise LookupError("the client is closed")


def test_an_executor_that_refuses_in_its_own_way_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="takes no work, but must be open: the client is closed"):
        drumrs.Sweep(BASE).run(tmp_path, Closed(), progress=False)


class Answering(Executor):
    """An executor whose futures come back with what it was made with."""

    def __init__(self, answer) -> None:
        self.answer = answer

    def submit(self, *_):
        future: Future = Future()
        if isinstance(self.answer, Exception):
            future.set_exception(self.answer)
        else:
            future.set_result(self.answer)
        return future


def test_a_worker_that_dies_with_a_case_fails_it(tmp_path):
    sweep = drumrs.Sweep(BASE)
    outcome = sweep.run(tmp_path, Answering(RuntimeError("the worker was killed")), progress=False)
    assert [(failure.error, failure.message) for failure in outcome.failures] == [
        ("RuntimeError", "the worker was killed")
    ]
    assert sweep.run(tmp_path, retry=True, progress=False).finished == 1


def test_workers_of_another_version_are_refused(tmp_path):
    with pytest.raises(ConfigError, match="workers with another version of drumrs"):
        drumrs.Sweep(BASE).run(tmp_path, Answering(CaseOutcome("other", "finished")), progress=False)


@pytest.mark.parametrize("room", range(11))
def test_a_full_disk_is_told_once_and_nothing_finished_is_lost(tmp_path, monkeypatch, room):
    """The disk is full after so many files: in every place where a case may be caught."""
    sweep = drumrs.Sweep(BASE, {"load.fill": [0.01, 0.02]})
    written = iter(range(room))

    def flush(_: int) -> None:
        if next(written, None) is None:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr("drumrs.files.os.fsync", flush)
        if room == 10:
            # A mark, a plan and four files a case: there was room for all.
            assert sweep.run(tmp_path, jobs=1, progress=False).finished == 2
        else:
            with pytest.raises(
                OSError, match="cases are finished and kept, and the same sweep goes"
            ) as caught:
                sweep.run(tmp_path, jobs=1, progress=False)
            assert caught.value.errno == errno.ENOSPC
    assert not [path for path in tmp_path.iterdir() if path.name.endswith(".tmp")]
    assert sweep.table().collect().height == sum(room > 4 * case + 1 for case in (1, 2))
    outcome = sweep.run(tmp_path, progress=False)
    assert (outcome.finished, outcome.replaced) == (2, ())


@pytest.mark.parametrize("executor", ["threads", "processes"])
def test_an_interrupt_stops_what_runs_and_keeps_what_is_finished(tmp_path, monkeypatch, executor):
    sweep = drumrs.Sweep(BASE, {"run.duration": [0.05, 100.0, 150.0]})
    short = sweep.cases[0]
    drumrs.Sweep.from_configs([short.config]).run(tmp_path, progress=False)
    calls = iter(range(8))

    def interrupted_wait(*arguments, **options):
        if next(calls, None) is None:
            raise KeyboardInterrupt
        return real_wait(*arguments, **options)

    real_wait = scheduler.wait
    monkeypatch.setattr(scheduler, "wait", interrupted_wait)
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt, match="interrupted; 1 cases are finished and kept"):
        sweep.run(tmp_path, executor, progress=False)
    # Two seconds before the interrupt; left alone, the long cases take half a minute.
    assert time.monotonic() - began < 12.0
    assert sweep.table().collect()["case"].to_list() == [short.id]
    assert not list(tmp_path.glob("*.error.json"))
