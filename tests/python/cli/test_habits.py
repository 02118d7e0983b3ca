"""What people and clusters expect of a command: encodings, logs, signals, usable cores, files that are held."""

import codecs
import errno
import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import drumrs
from drumrs.files import write_whole

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
DRUMRS = [sys.executable, "-m", "drumrs"]
TINY = ["--set", "run.duration=0.02", "--set", "load.count=10"]


def run(*words: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [*DRUMRS, *words], capture_output=True, env={**ENVIRONMENT, **environment}, check=False
    )


@pytest.fixture(scope="module")
def in_utf8():
    """Return what goes to a file where the encoding is UTF-8."""
    return run("quantities", "ratio", PYTHONIOENCODING="utf-8").stdout


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp437"])
def test_what_goes_to_a_file_is_utf8(encoding, in_utf8):
    told = run("quantities", "ratio", PYTHONIOENCODING=encoding)
    assert (told.returncode, told.stderr) == (0, b"")
    assert told.stdout == in_utf8
    assert "Δ" in told.stdout.decode("utf-8")


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp437"])
def test_a_case_file_written_in_any_locale_is_the_case(encoding, tmp_path):
    """The whole file or none: what is cut at a letter that the locale lacks would run as another case."""
    told = run("config", PYTHONIOENCODING=encoding, LC_ALL="C", PYTHONUTF8="0")
    assert (told.returncode, told.stderr) == (0, b"")
    (tmp_path / "case.toml").write_bytes(told.stdout)
    assert drumrs.Config.read(tmp_path / "case.toml") == drumrs.Config()
    assert "π" in told.stdout.decode("utf-8")


@pytest.mark.parametrize(
    "words", [["--help"], ["verify", "--help"], ["reproduce", "--help"], ["verify", "bouncing"]]
)
def test_help_and_tables_are_shown_in_any_locale(words):
    told = run(*words, PYTHONIOENCODING="ascii", LC_ALL="C", PYTHONUTF8="0")
    assert b"Traceback" not in told.stderr
    assert b"codec" not in told.stderr
    assert told.returncode == run(*words).returncode


def test_a_terminal_gets_what_it_can_show():
    leader, follower = pty.openpty()
    words = [*DRUMRS, "run", *TINY, "--softer", "4"]
    environment = {**ENVIRONMENT, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=follower, env=environment, check=False)
    os.close(follower)
    said = os.read(leader, 65536)
    assert done.returncode == 0
    assert b"normal_stiffness 9.7e+07 ? 2.425e+07" in said


def test_whoever_reads_the_beginning_hears_no_complaint():
    words = " ".join([*DRUMRS, "quantities"])
    done = subprocess.run(
        ["bash", "-c", f"{words} | head -1; exit ${{PIPESTATUS[0]}}"],  # noqa: S607
        capture_output=True,
        env={**ENVIRONMENT, "PYTHONUNBUFFERED": "1"},
        check=False,
    )
    assert done.stderr == b""
    assert done.returncode in {0, 1}
    assert done.stdout.count(b"\n") == 1


def test_whoever_reads_nothing_hears_no_complaint():
    reading, writing = os.pipe()
    os.close(reading)
    environment = {**ENVIRONMENT, "PYTHONUNBUFFERED": "1"}
    words = [*DRUMRS, "info"]
    done = subprocess.run(words, stdout=writing, stderr=subprocess.PIPE, env=environment, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"])
def test_case_files_of_windows_are_read_or_refused_in_a_sentence(encoding, tmp_path):
    text = "# Größe\r\nload.fill = 0.15\r\n"
    (tmp_path / "case.toml").write_bytes(text.encode(encoding))
    assert codecs.BOM_UTF8 + text.encode() == text.encode("utf-8-sig")
    if encoding in {"utf-8", "utf-8-sig", "utf-16"}:
        assert drumrs.Config.read(tmp_path / "case.toml").load.fill == 0.15
        return
    with pytest.raises(drumrs.ConfigError, match="it is not text in UTF-8: save it as such"):
        drumrs.Config.read(tmp_path / "case.toml")


def test_counts_are_taken_as_people_write_them(drum):
    status, printed, _ = drum(
        "run", *TINY, "--set", "load.count=1.2e1", "--threads", "1.", "--seed", "1e1", "--json"
    )
    assert (status, json.loads(printed)["bundle_count"]) == (0, 12)
    status, _, complaint = drum("run", *TINY, "--seed", ".5")
    assert (status, complaint) == (2, "drumrs: Invalid value for --seed: .5 is not a whole number\n")


def test_quiet_leaves_results_warnings_and_errors(drum, tmp_path):
    status, printed, complaint = drum("run", *TINY, "--out", tmp_path / "out", "--quiet")
    assert (status, complaint) == (0, "")
    assert f"wrote {tmp_path / 'out' / 'summary.json'}" in printed
    status, _, complaint = drum("run", *TINY, "--out", tmp_path / "out", "--quiet")
    assert (status, complaint.count("\n")) == (2, 1)
    assert "drumrs: Froude number" in drum("run", *TINY)[2]


def test_debug_shows_where_an_error_comes_from(drum):
    sentence = "drumrs: load.fil is not a key; did you mean load.fill?\n"
    assert drum("run", "--set", "load.fil=0.1")[2] == sentence
    told = drum("run", "--set", "load.fil=0.1", "--debug")[2]
    assert told.startswith("Traceback")
    assert told.endswith(sentence)


def test_a_log_file_has_a_line_of_json_for_all_that_is_said(drum, tmp_path):
    (tmp_path / "sweep.toml").write_text("[base]\nrun.duration = 0.02\n[axes]\nload.fill = [0.05, 5.0]\n")
    log = tmp_path / "log.jsonl"
    status, _, _ = drum("sweep", tmp_path / "sweep.toml", "--out", tmp_path / "out", "--log-file", log)
    lines = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    assert (lines[0]["process"], lines[0]["version"]) == (os.getpid(), drumrs.__version__)
    assert lines[0]["message"].startswith("drumrs sweep ")
    cases = {line["status"]: line for line in lines if line["logger"] == "drumrs.sweep"}
    assert set(cases) == {"finished", "failed"}
    assert (cases["failed"]["level"], cases["failed"]["error"]) == ("warning", "ConfigError")
    assert cases["failed"]["reason"]
    assert cases["finished"]["seconds"] > 0.0
    assert cases["finished"]["host"]
    assert (lines[-1]["status"], status) == (1, 1)
    # What follows is added; and nobody listens any longer.
    drum("info", "--log-file", log)
    drum("info")
    assert len(log.read_text(encoding="utf-8").splitlines()) == len(lines) + 2
    status, _, complaint = drum("info", "--log-file", tmp_path / "nowhere" / "log")
    assert (status, complaint.startswith("drumrs: --log-file is ")) == (2, True)


def test_info_as_json(drum):
    told = json.loads(drum("info", "--json")[1])
    assert told["version"] == drumrs.__version__
    assert told["cpu_features"] == list(drumrs.info()["cpu_features"])


def started(folder: Path, *before: str) -> subprocess.Popen[str]:
    """Start a long run, and wait until it is under way."""
    words = [*before, *DRUMRS, "run", "--set", "run.duration=500", "--set", "load.count=10", "--out", "out"]
    child = subprocess.Popen(words, stderr=subprocess.PIPE, text=True, cwd=folder, env=ENVIRONMENT)
    end = time.monotonic() + 60.0
    while not (folder / "out" / "checkpoint.bin").exists() and time.monotonic() < end:
        time.sleep(0.02)
    time.sleep(0.2)
    return child


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGUSR1"])
def test_signals_that_ask_for_the_end_leave_a_checkpoint(name, tmp_path):
    child, number = started(tmp_path), getattr(signal, name)
    child.send_signal(number)
    _, complaint = child.communicate(timeout=60)
    assert child.returncode == 128 + number
    assert f"drumrs: interrupted by {name} at t = " in complaint
    assert complaint.endswith("go on with: drumrs run --resume out\n")
    assert drumrs.Simulation.load(tmp_path / "out" / "checkpoint.bin").step > 0


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_signal_that_is_ignored_at_the_start_stays_ignored(tmp_path):
    child = started(tmp_path, "nohup")
    child.send_signal(signal.SIGHUP)
    with pytest.raises(subprocess.TimeoutExpired):
        child.wait(0.5)
    child.send_signal(signal.SIGTERM)
    child.communicate(timeout=60)
    assert child.returncode == 128 + signal.SIGTERM


def test_handlers_are_those_of_before_after_a_command(drum):
    before = signal.getsignal(signal.SIGTERM)
    drum("info")
    assert signal.getsignal(signal.SIGTERM) is before


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="affinity of Linux")
def test_jobs_are_the_cores_that_the_process_may_use():
    first = "import os, drumrs; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})"
    code = f"{first}; print(drumrs.effective_jobs())"
    told = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=ENVIRONMENT, check=True
    )
    assert told.stdout == "1\n"


def cpu_group() -> Path | None:
    """A control group of one core, where this process may make one; the caller removes it."""
    for root, limits in (
        (Path("/sys/fs/cgroup"), {"cpu.max": "100000 100000"}),
        (Path("/sys/fs/cgroup/cpu"), {"cpu.cfs_period_us": "100000", "cpu.cfs_quota_us": "100000"}),
    ):
        own = root / f"drumrs-{os.getpid()}"
        if not (root / "cgroup.procs").exists():
            continue
        try:
            own.mkdir()
        except OSError:
            continue
        try:
            for name, limit in limits.items():
                (own / name).write_text(limit)
        except OSError:
            own.rmdir()
            continue
        return own
    return None


def test_jobs_are_what_the_quota_of_a_container_leaves():
    group = cpu_group()
    if group is None:
        pytest.skip("this process may not make control groups")
    try:
        first = f"import os, drumrs; open('{group}/cgroup.procs', 'w').write(str(os.getpid()))"
        code = f"{first}; print(drumrs.effective_jobs(), len(os.sched_getaffinity(0)))"
        told = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, env=ENVIRONMENT, check=True
        )
        jobs, cores = map(int, told.stdout.split())
        assert jobs == 1
        if cores == 1:
            pytest.skip("one core is all that there is")
    finally:
        group.rmdir()


def test_a_file_that_another_program_holds_is_tried_again(tmp_path, monkeypatch):
    real, tries = Path.replace, []

    def held(self, target):
        tries.append(target)
        if len(tries) < 3:
            raise PermissionError(errno.EACCES, "held")
        return real(self, target)

    monkeypatch.setattr(Path, "replace", held)
    write_whole(tmp_path / "summary.json", b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["summary.json"]
    assert len(tries) == 3


def test_what_cannot_take_its_place_is_kept_and_named(tmp_path, monkeypatch):
    def held(*_):
        raise PermissionError(errno.EACCES, "Access is denied")

    monkeypatch.setattr(Path, "replace", held)
    monkeypatch.setattr("drumrs.files._PAUSES", (0.0, 0.0))
    (tmp_path / "summary.json").write_bytes(b"old")
    with pytest.raises(PermissionError) as told:
        write_whole(tmp_path / "summary.json", b"new")
    kept = next(path for path in tmp_path.iterdir() if path.name != "summary.json")
    assert kept.read_bytes() == b"new"
    assert (kept.suffix, kept.name.startswith("summary.")) == (".json", True)
    assert str(told.value).startswith(
        f"cannot replace '{tmp_path / 'summary.json'}': another program holds it open"
    )
    assert str(told.value).endswith(f"what was to be written is in '{kept}'")
