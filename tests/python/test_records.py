"""Records go to disk as they come: kills, interrupts, full disks and full memory do not lose or change a bit."""

import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.errors import CheckpointError, ConfigError
from drumrs.frames import FramesFile, thinned
from drumrs.run_folder import RunFolder

# Frames of every few steps of a soft load: some hundred kilobytes a second of the wall clock's tenth.
DENSE = ["--softer", "100", "--set", "load.count=40", "--set", "run.frame_every=1e-4"]
TABLES = ("series.parquet", "frames.parquet", "config.toml")


def dense(duration: float, every: float = 1e-4) -> drumrs.Config:
    config = drumrs.baseline().softer(100.0)
    return config.replace({"load.count": 40, "run.duration": duration, "run.frame_every": every})


def same(one, other) -> bool:
    return all((one / name).read_bytes() == (other / name).read_bytes() for name in TABLES)


def same_frames(one: drumrs.Frames, other: drumrs.Frames) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name)) for name in vars(one) if name in SHAPED
    )


# What the writing of a part takes, and leaves with the allocator [bytes].
PART = 150e6

SHAPED = ("times", "drum_angles", "positions", "angles", "velocities", "contacts", "radii")

MEASURED = """
import resource, sys, drumrs, polars, matplotlib.figure
{code}
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
"""


def peak(code: str, **limits: int) -> int:
    """Return the greatest memory [bytes] of a process of its own that ran some lines of Python."""

    def limit() -> None:
        for name, most in limits.items():
            resource.setrlimit(getattr(resource, name), (most, most))

    done = subprocess.run(
        [sys.executable, "-c", MEASURED.format(code=code)],
        capture_output=True,
        text=True,
        preexec_fn=limit,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return int(done.stdout.split()[-1])


@pytest.mark.slow
def test_a_run_with_a_folder_needs_no_memory_for_its_frames(tmp_path):
    """300 MB of frames, ten times those of the other run."""
    words = ["run", "--softer", "100", "--set", "run.duration=6.9", "--force", "--out", str(tmp_path / "out")]
    code = "from drumrs.cli import run_command; assert run_command({}) == 0"
    few = peak(code.format([*words, "--set", "run.frame_every=3.7e-4"]))
    many = peak(code.format([*words, "--set", "run.frame_every=3.7e-5"]), RLIMIT_AS=2_500_000_000)
    file = FramesFile.of(tmp_path / "out" / "frames.parquet")
    size = 22 * file.count * len(file)
    assert size > 290e6
    # Ten times the frames, and no more memory than a part takes: 75 to 140 MB, as the allocator pleases.
    assert many < few + 0.75 * size, f"{many / 1e6:.0f} MB, with few frames {few / 1e6:.0f} MB"
    assert not (tmp_path / "out" / "records").exists()


@pytest.mark.slow
def test_the_series_of_a_run_with_a_folder_needs_what_the_rule_counts(tmp_path):
    """540 000 samples, twice: in the simulation, and where it is drawn and written."""
    words = [
        "run",
        "--softer",
        "100",
        "--set",
        "load.count=5",
        "--set",
        "run.frame_every=1",
        "--force",
        "--out",
        str(tmp_path),
    ]
    code = "from drumrs.cli import run_command; assert run_command({}) == 0"
    few = peak(code.format([*words, "--set", "run.duration=1"]))
    many = peak(code.format([*words, "--set", "run.sample_every=3.7e-5"]))
    assert many < few + PART + 1.5 * 2 * 272 * 540_000


@pytest.mark.slow
def test_a_run_in_memory_needs_what_the_rule_counts(tmp_path):
    config = drumrs.baseline().softer(100.0).replace({"run.duration": 3.0, "run.frame_every": 3.7e-5})
    made = f"config = drumrs.Config.model_validate_json({config.model_dump_json()!r})"
    counted = 2 * 22 * 100 * round(3.0 / 3.7e-5)
    before = peak(made)
    kept = f"{made}; drumrs.save(drumrs.run(config, progress=False), {str(tmp_path)!r}, pictures=False)"
    assert peak(kept) < before + 1.5 * counted
    loaded = f"assert len(drumrs.load({str(tmp_path)!r}).frames) > 80_000"
    assert peak(loaded) < before + 1.5 * counted
    shown = f"from drumrs import viewer; viewer.read({str(tmp_path)!r})"
    assert peak(shown) < before + 0.6 * counted
    saved = f"s = drumrs.Simulation(config); s.run(); s.save({str(tmp_path / 'c')!r}); s.frames"
    assert peak(f"{made}; {saved}") < before + 1.5 * counted


def test_checkpoints_do_not_grow_with_the_number_of_frames(tmp_path):
    sizes = {}
    for every in (1e-4, 0.1):
        folder = RunFolder(tmp_path / str(every))
        folder.begin(dense(1.0, every))
        simulation = drumrs.Simulation(dense(1.0, every))
        simulation.run(duration=0.5)
        folder.save(simulation)
        sizes[every] = (folder.path / "checkpoint.bin").stat().st_size
    assert abs(sizes[1e-4] - sizes[0.1]) < 20
    assert sizes[0.1] < 15_000


def test_a_simulation_of_a_folder_has_the_whole_series_and_all_frames(tmp_path):
    alone, kept = drumrs.Simulation(dense(0.2)), drumrs.Simulation(dense(0.2))
    folder = RunFolder(tmp_path)
    folder.begin(dense(0.2))
    for steps in (700, 1, 900):
        kept.run(steps=steps)
        folder.save(kept)
    assert len(kept.frames) == 0
    kept.run(steps=100)
    alone.run(steps=1701)
    again = drumrs.Simulation.load(tmp_path / "checkpoint.bin")
    again.run(steps=100)
    assert again.series.equals(alone.series)
    assert kept.series.equals(alone.series)
    assert same_frames(again.frames, alone.frames)
    # All of it goes to a checkpoint elsewhere; and where there is nothing beside, no window is made up.
    again.save(tmp_path / "elsewhere.bin")
    alone.save(tmp_path / "alone.bin")
    assert (tmp_path / "elsewhere.bin").read_bytes() == (tmp_path / "alone.bin").read_bytes()
    (tmp_path / "copy").mkdir()
    bare = drumrs.Simulation.load(shutil.copy(tmp_path / "checkpoint.bin", tmp_path / "copy"))
    assert bare.step == 1601
    with pytest.raises(ConfigError, match="its samples are no longer in memory"):
        bare.summary((0.0, 0.05))


CHILD = """
import sys, drumrs.run_folder
drumrs.run_folder.PART_SIZE = 100_000
from drumrs.cli import main
main(sys.argv[1:])
"""


def start(*words) -> subprocess.Popen:
    command = [sys.executable, "-c", CHILD, *map(str, words)]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def written(path) -> int:
    """Return when a file was written; 0 where there is none."""
    return path.stat().st_mtime_ns if path.exists() else 0


def ended(child: subprocess.Popen) -> tuple[int, str]:
    """Return status and complaint of a child, but for what --softer says, the line of facts and lines of progress."""
    _, complaint = child.communicate()
    return child.returncode, "".join(
        line
        for line in complaint.splitlines()
        if not re.search(r"--softer|: \d+%, |steps per collision", line)
    )


@pytest.mark.parametrize("blow", [signal.SIGKILL, pytest.param(signal.SIGINT, marks=pytest.mark.slow)])
def test_blows_at_random_moments_change_no_byte(tmp_path, blow):
    case = [*DENSE, "--set", "run.duration=6", "--set", "run.checkpoint_every=0.1", "--out"]
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    assert ended(start("run", *case, whole)) == (0, "")
    words, draw, blows, parts = ["run", *case, broken], random.Random(blow), 0, 0
    for _ in range(3):
        child, seen = start(*words), written(broken / "checkpoint.bin")
        while child.poll() is None and written(broken / "checkpoint.bin") == seen:
            time.sleep(0.01)
        time.sleep(draw.uniform(0.2, 0.8))
        child.send_signal(blow)
        status, complaint = ended(child)
        assert "Traceback" not in complaint
        blows += status != 0
        parts = max(parts, len(list(broken.glob("records/frames-*.parquet"))))
        words = ["run", "--resume", broken]
    assert blows, "the blows came too late to test anything"
    assert parts > 1
    assert ended(start(*words)) == (0, "")
    assert same(whole, broken)
    assert {path.name for path in whole.iterdir()} == {path.name for path in broken.iterdir()}


def test_what_came_after_the_checkpoint_is_dropped(drum, tmp_path, monkeypatch):
    """As after a kill between two checkpoints: parts of other lengths than those to come."""
    assert drum("run", *DENSE, "--set", "run.duration=0.1", "--out", tmp_path / "whole")[0] == 0
    folder = RunFolder(tmp_path / "broken")
    folder.begin(dense(0.1))
    shutil.copy(tmp_path / "whole" / "config.toml", folder.path)
    simulation = drumrs.Simulation(drumrs.Config.read(folder.path / "config.toml"))
    simulation.run(steps=400)
    folder.save(simulation)
    monkeypatch.setattr("drumrs.run_folder.PART_SIZE", 1)
    for steps in (77, 301, 12):
        simulation.run(steps=steps)
        folder.flush(simulation)
    monkeypatch.undo()
    (folder.path / "records" / ".frames-900.parquet.1a2b3c4d.tmp").write_bytes(b"half a part")
    (folder.path / ".frames.parquet.0123abcd.tmp").write_bytes(b"half a table")
    (folder.path / ".notes.tmp").write_bytes(b"the user's")
    assert len(list(folder.path.glob("records/frames-*.parquet"))) == 4
    assert drum("run", "--resume", folder.path)[0] == 0
    assert same(tmp_path / "whole", folder.path)
    assert not (folder.path / "records").exists()
    assert [path.name for path in folder.path.glob(".*")] == [".notes.tmp"]


def test_a_finished_run_goes_on(drum, tmp_path):
    goal = ["--until", "0.0001", "--limit", "0.3"]
    case = [*DENSE, "--set", "run.duration=0.1", "--set", "run.window=[0.05, 0.1]", "--out"]
    assert drum("run", *case, tmp_path / "whole", *goal)[0] == 0
    assert drum("run", *case, tmp_path / "twice")[0] == 0
    assert drum("run", "--resume", tmp_path / "twice", *goal)[0] == 0
    assert same(tmp_path / "whole", tmp_path / "twice")
    assert drumrs.load(tmp_path / "twice").frames.times[-1] > 0.29


def test_a_blow_while_parts_are_removed_leaves_a_run_that_goes_on(drum, tmp_path, monkeypatch):
    goal = ["--until", "0.0001", "--limit", "0.3"]
    case = [*DENSE, "--set", "run.duration=0.1", "--set", "run.window=[0.05, 0.1]", "--out"]
    assert drum("run", *case, tmp_path / "whole", *goal)[0] == 0
    unlink = Path.unlink

    def broken_off(path, **options):
        if path.name.startswith("frames-") and int(path.stem.removeprefix("frames-")) > 0:
            raise KeyboardInterrupt
        unlink(path, **options)

    monkeypatch.setattr(Path, "unlink", broken_off)
    assert drum("run", *case, tmp_path / "broken")[0] == 130
    monkeypatch.undo()
    assert len(list(tmp_path.glob("broken/records/frames-*.parquet"))) == 1
    assert drum("run", "--resume", tmp_path / "broken", *goal)[0] == 0
    assert same(tmp_path / "whole", tmp_path / "broken")


def test_a_run_removes_what_another_one_left_in_its_folder(tmp_path):
    drumrs.save(drumrs.run(dense(0.1), progress=False), tmp_path, pictures=False)
    folder = RunFolder(tmp_path)
    folder.begin(dense(0.1))
    assert {path.name for path in tmp_path.iterdir()} == {"config.toml", "drumrs-run.json"}


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError(28, "No space left on device")])
def test_what_could_not_be_written_is_written_the_next_time(tmp_path, monkeypatch, error):
    alone, kept = drumrs.Simulation(dense(0.2)), drumrs.Simulation(dense(0.2))
    folder, save, calls = RunFolder(tmp_path), drumrs.Frames.save, []
    folder.begin(dense(0.2))

    def fail_once(*arguments):
        calls.append(arguments)
        if len(calls) == 1:
            raise error
        save(*arguments)

    monkeypatch.setattr(drumrs.Frames, "save", fail_once)
    kept.run(steps=500)
    with pytest.raises(type(error) if isinstance(error, OSError) else error):
        folder.save(kept)
    assert not (tmp_path / "checkpoint.bin").exists()
    kept.run(steps=500)
    folder.save(kept)
    alone.run(steps=1000)
    again = drumrs.Simulation.load(tmp_path / "checkpoint.bin")
    assert again.series.equals(alone.series)
    assert same_frames(again.frames, alone.frames)


FULL = """
import os, resource, numpy as np, drumrs
config = drumrs.baseline(0.5).softer(100.0).replace({"run.duration": 20.0, "run.frame_every": 3.7e-5})
full, free = drumrs.Simulation(config), drumrs.Simulation(config)
full.run(steps=100), full.frames, full.series
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * os.sysconf("SC_PAGE_SIZE") + 40_000_000, -1))
try:
    full.run()
except MemoryError as error:
    print(error)
assert 1000 < full.step < full.last_step
held = {}
full.records.take(held)
frames = [full.records.as_frames(held["frames"])]
resource.setrlimit(resource.RLIMIT_AS, (-1, -1))
assert len(frames[0]) == full.step
full.run(steps=500)
free.run(steps=full.step)
frames.append(full.frames)
assert np.array_equal(np.concatenate([part.times for part in frames]), free.frames.times)
assert np.array_equal(np.concatenate([part.positions for part in frames]), free.frames.positions)
assert full.series.equals(free.series)
assert np.array_equal(full.positions, free.positions)
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="Linux tells how much memory is in use")  # noqa: PTH110
def test_full_memory_is_an_exception_that_loses_nothing():
    done = subprocess.run([sys.executable, "-c", FULL], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("recording a frame: there is no memory for ")


def test_full_memory_ends_a_run_with_a_checkpoint(drum, tmp_path, monkeypatch):
    run_to_step, calls = drumrs.Simulation.run_to_step, []

    def full(simulation, step, **options):
        calls.append(step)
        if len(calls) > 1:
            return run_to_step(simulation, step, **options)
        run_to_step(simulation, 500)
        raise MemoryError("recording a frame: there is no memory for 1600 bytes more")

    case = [*DENSE, "--set", "run.duration=0.1", "--out"]
    assert drum("run", *case, tmp_path / "whole")[0] == 0
    monkeypatch.setattr(drumrs.Simulation, "run_to_step", full)
    status, _, told = drum("run", *case, tmp_path / "full")
    assert status == 1
    assert "out of memory at t = " in told
    assert f"go on with: drumrs run --resume {tmp_path / 'full'}" in told
    assert drumrs.Simulation.load(tmp_path / "full" / "checkpoint.bin").step == 500
    assert drum("run", "--resume", tmp_path / "full")[0] == 0
    assert same(tmp_path / "whole", tmp_path / "full")


def test_an_unstable_run_keeps_all_parts(drum, tmp_path, monkeypatch):
    monkeypatch.setattr("drumrs.run_folder.PART_SIZE", 3_000)
    taken, append = [], drumrs.parts.Parts.append
    monkeypatch.setattr(
        drumrs.parts.Parts, "append", lambda parts, records: (taken.append(1), append(parts, records))
    )
    soft = ["--softer", "30000", "--set", "run.frame_every=1e-3"]
    case = [*soft, "--set", "run.duration=3", "--set", "rotation.rpm=100"]
    status, _, _ = drum("run", *case, "--out", tmp_path)
    assert status == 1
    assert len(taken) >= 3
    alone = drumrs.Simulation(drumrs.Config.read(tmp_path / "config.toml"))
    with pytest.raises(drumrs.UnstableError):
        alone.run()
    assert same_frames(drumrs.Frames.load(tmp_path / "frames.parquet"), alone.frames)
    assert pl.read_parquet(tmp_path / "series.parquet").equals(alone.series)
    assert json.loads((tmp_path / "unstable.json").read_text())["step"] == alone.step
    assert not (tmp_path / "records").exists()


def test_missing_parts_are_named(drum, tmp_path):
    folder = RunFolder(tmp_path)
    folder.begin(dense(0.2))
    simulation = drumrs.Simulation(dense(0.2))
    for _ in range(3):
        simulation.run(steps=400)
        folder.save(simulation)
    parts = sorted(tmp_path.glob("records/frames-*.parquet"))
    assert len(parts) == 3
    parts[1].unlink()
    status, _, told = drum("run", "--resume", tmp_path)
    assert status == 2
    assert "lacks the frames recorded after the first" in told
    with pytest.raises(CheckpointError, match="lacks the frames recorded after the first"):
        folder.restore(folder.load(1))


def test_a_damaged_part_is_named(tmp_path):
    folder = RunFolder(tmp_path)
    folder.begin(dense(0.2))
    simulation = drumrs.Simulation(dense(0.2))
    simulation.run(steps=400)
    folder.save(simulation)
    (part,) = tmp_path.glob("records/series-*.parquet")
    part.write_bytes(
        b"PAR1" + bytes(part.stat().st_size // 2) + part.read_bytes()[part.stat().st_size // 2 + 4 :]
    )
    with pytest.raises(CheckpointError, match="lacks the series recorded after the first"):
        folder.restore(folder.load(1))


def test_what_there_is_no_room_for_is_refused_before_the_run(drum, tmp_path, monkeypatch):
    many = drumrs.baseline().replace({"run.frame_every": 3.7e-6, "run.duration": 60.0})
    with pytest.raises(ConfigError, match=r"GiB of memory, .* let drumrs run --out OUT write frames to disk"):
        drumrs.Simulation(many)
    assert drumrs.Simulation(many, in_memory=False).step == 0
    few = drumrs.baseline().replace({"run.frame_every": 1e-3})
    monkeypatch.setattr("drumrs.limits._memory", lambda: 1e8)
    assert drumrs.Simulation(few.replace({"run.duration": 10.0})).step == 0
    with pytest.raises(ConfigError, match=r"run\.frame_every is 0\.001, but must be at least 0\.0031"):
        drumrs.Simulation(few.replace({"run.duration": 60.0}))
    room = shutil.disk_usage(tmp_path)._replace(free=10_000_000)
    monkeypatch.setattr("shutil.disk_usage", lambda _: room)
    for free, shown in ((10_000_000, "0.009313"), (0, "0")):
        room = room._replace(free=free)
        status, _, told = drum("run", "--set", "run.frame_every=1e-3", "--out", tmp_path / "out")
        assert status == 2
        assert "run.frame_every is 0.001, but must be at least " in told
        assert f"GiB on the disk of {str(tmp_path / 'out')!r}, and {shown} are there for it" in told
        assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("frames", "count", "most"), [(7, 5, 10), (1000, 3, 100), (1000, 300, 7), (1, 5, 3), (0, 5, 3)]
)
def test_what_is_thinned_once_is_thin(frames, count, most):
    kept = thinned(frames, count, most)
    assert len(thinned(len(kept), count, most)) == len(kept)
    assert not frames or kept[-1] == frames - 1


def test_sizes_are_those_of_what_is_recorded():
    config = drumrs.baseline(fill=0.1, baffles=True).replace({"drum.walls": [[[0.0, 0.0], [0.05, 0.0]]]})
    simulation = drumrs.Simulation(config)
    rows, frames = simulation.series, simulation.frames
    arrays = [getattr(frames, name) for name in SHAPED if name != "radii"]
    assert simulation.records.sizes == {
        "run.sample_every": 8 * rows.width * rows.height,
        "run.frame_every": sum(array.nbytes for array in arrays),
    }
