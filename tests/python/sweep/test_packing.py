"""Packs: the files of finished cases in a few, read as before, and nothing lost wherever packing is broken off."""

import os
import re
import shutil
import subprocess
import sys
import time
import zipfile
from itertools import count
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.sweep import pack, packing, scan_folder, status, unpack
from drumrs.sweep.packs import Packs
from drumrs.sweep.sealed import write_sealed

SHORT = {"run.duration": 0.06, "run.sample_every": 0.002, "run.frame_every": 0.02}
BASE = drumrs.baseline(fill=0.05).replace(SHORT)
RECORDED = BASE.replace({"run.record": ["wall_profile"], "drum.baffles.count": 3})


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Three finished cases, one of which records more."""
    folder = tmp_path_factory.mktemp("finished")
    sweep = drumrs.Sweep.from_configs([BASE, BASE.replace({"run.seed": 2}), RECORDED])
    sweep.run(folder, progress=False)
    return sweep, folder


@pytest.fixture
def copy(finished, tmp_path):
    sweep, folder = finished
    shutil.copytree(folder, tmp_path / "copy")
    return sweep, tmp_path / "copy"


def loose(folder: Path) -> dict[str, bytes]:
    """Every file of a case in the folder itself."""
    return {
        path.name: path.read_bytes() for path in folder.iterdir() if len(path.name.partition(".")[0]) == 20
    }


def assert_same_results(sweep, folder, before):
    """Everything that a sweep gives is what it was."""
    assert sweep.table(folder).collect().equals(sweep.table(before).collect())
    assert sweep.facts(folder).equals(sweep.facts(before))
    for case in sweep.cases:
        assert sweep.series(case, folder).equals(sweep.series(case, before))
        assert np.array_equal(sweep.frames(case, folder).positions, sweep.frames(case, before).positions)


def test_packed_results_are_what_they_were(finished, copy, monkeypatch):
    sweep, folder = copy
    before = loose(folder)
    done = pack(folder, progress=False)
    assert (done.cases, done.files, done.packs, done.left) == (3, len(before), 1, {})
    assert loose(folder) == {}
    [files] = (folder / "packs").glob("*.zip")
    with zipfile.ZipFile(files) as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == before
    assert_same_results(sweep, folder, finished[1])
    assert sweep.write_table(folder).read_bytes() == sweep.write_table(finished[1]).read_bytes()
    profiles = [
        sweep.measure(lambda result: {"tables": len(result.contact_tables())}, at)["tables"].to_list()
        for at in (folder, finished[1])
    ]
    assert profiles[0] == profiles[1]
    assert sweep.short_ids(folder) == sweep.short_ids(finished[1])
    # Nothing is simulated again, and shards see that all is settled.
    monkeypatch.setattr("drumrs.sweep.worker.Simulation", None)
    outcome = sweep.run(folder, shard=(1, 3), progress=False)
    assert (outcome.finished, outcome.computed, outcome.left) == (1, 0, 0)
    assert pack(folder, progress=False).packs == 0


class Killed(BaseException):
    """Stands for the end of the process."""


def dying_at(step: int, monkeypatch) -> None:
    """Let the process die at a step that changes the disk, and do nothing more: no file is removed on the way out."""
    steps = count()

    def dies(action):
        def act(*arguments, **options):
            if next(steps) >= step:
                raise Killed
            return action(*arguments, **options)

        return act

    for where, name in (
        (Path, "mkdir"),
        (Path, "replace"),
        (Path, "unlink"),
        (os, "fsync"),
        (zipfile.ZipFile, "open"),
    ):
        monkeypatch.setattr(where, name, dies(getattr(where, name)))


def test_killed_at_any_step_nothing_is_lost(finished, tmp_path):
    sweep, before = drumrs.Sweep.from_configs([BASE]), tmp_path / "before"
    other = [f"{case.id}*" for case in finished[0].cases[1:]]
    shutil.copytree(finished[1], before, ignore=shutil.ignore_patterns(*other))
    for step in count():
        folder = tmp_path / str(step)
        shutil.copytree(before, folder)
        with pytest.MonkeyPatch.context() as patch:
            dying_at(step, patch)
            try:
                pack(folder, progress=False)
            except Killed:
                killed = True
            else:
                killed = False
        assert_same_results(sweep, folder, before)
        again = pack(folder, progress=False)
        assert again.left == {}
        assert loose(folder) == {}
        assert_same_results(sweep, folder, before)
        assert status(folder).packed == 1
        shutil.rmtree(folder)
        if not killed:
            break
    # A folder, files into the zip file, two files onto the disk under their names, every file removed.
    assert step > 2 * len(loose(before))


def test_a_fresh_checkpoint_refuses_and_an_old_one_does_not(copy, drum):
    _, folder = copy
    path = folder / f"{'0' * 20}.checkpoint.bin"
    path.write_bytes(b"")
    path.with_name(f"{'0' * 20}.runner.json").write_text('{"machine": "another"}')
    status_, _, complaint = drum("pack", folder)
    assert status_ == 2
    assert (
        f"s ago, of case {'0' * 20}, but must be a folder in which nobody computes; wait until" in complaint
    )
    assert not (folder / "packs").exists()
    os.utime(path, (time.time() - 600, time.time() - 600))
    status_, printed, complaint = drum("pack", folder)
    assert (status_, complaint) == (0, "")
    assert printed.startswith("packed 3 cases: 2 files in place of ")
    assert loose(folder).keys() == {path.name, f"{'0' * 20}.runner.json"}


def test_what_is_damaged_stays_and_is_named(copy, drum):
    sweep, folder = copy
    case = sweep.cases[0]
    path = folder / f"{case.id}.series.parquet"
    path.write_bytes(path.read_bytes()[:-50] + bytes(50))
    status_, printed, complaint = drum("pack", folder)
    assert status_ == 1
    assert printed.startswith("packed 2 cases")
    assert complaint.startswith(f"drumrs: case {case.id} keeps files of its own: ")
    assert "damaged" in complaint
    assert {name.partition(".")[0] for name in loose(folder)} == {case.id}


def test_a_copy_that_reads_back_otherwise_keeps_the_file(copy, monkeypatch):
    sweep, folder = copy
    case = sweep.cases[1]
    name = f"{case.id}.toml"
    copy_of = packing._copy

    def other(archive, path):
        copied = copy_of(archive, path)
        if path.name == name:
            path.write_bytes(path.read_bytes().replace(b"0", b"1"))
        return copied

    monkeypatch.setattr(packing, "_copy", other)
    done = pack(folder, progress=False)
    assert done.left == {case.id: f"{name} is not what is packed under this name, and comes before it"}
    assert loose(folder).keys() == {name}


def test_a_file_that_changes_while_it_is_packed_is_left(copy, monkeypatch):
    sweep, folder = copy
    case = sweep.cases[1]
    name = f"{case.id}.toml"
    checked = packing._checked

    def then_changed(store, case, ending):
        crc = checked(store, case, ending)
        path = folder / f"{case}.{ending}"
        if path.name == name:
            path.write_bytes(path.read_bytes() + b"#")
        return crc

    monkeypatch.setattr(packing, "_checked", then_changed)
    done = pack(folder, progress=False)
    assert (done.cases, done.left) == (2, {case.id: f"{name} has changed meanwhile"})
    assert {name.partition(".")[0] for name in loose(folder)} == {case.id}


TAKEN = """
import pathlib, sys, drumrs
from drumrs.sweep import pack

def told(word):
    return 1024 * int(pathlib.Path("/proc/self/status").read_text().partition(word + ":")[2].split()[0])

def taken(action):
    pathlib.Path("/proc/self/clear_refs").write_text("5")
    before = told("VmRSS")
    action()
    return told("VmHWM") - before

few = drumrs.baseline(0.5).softer(100.0).replace({"run.duration": 0.2, "run.frame_every": 0.1})
many = few.replace({"run.duration": 1.0, "run.frame_every": 3.7e-5, "run.sample_every": 0.01})
sizes = drumrs.Simulation(many).records.sizes
for number, config in enumerate((few, many)):
    sweep, folder = drumrs.Sweep.from_configs([config]), f"{sys.argv[1]}/{number}"
    done = taken(lambda: sweep.run(folder, progress=False)), taken(lambda: pack(folder, progress=False))
print(*done, 2 * len(sweep.frames(sweep.cases[0]).times) * sizes["run.frame_every"])
"""


@pytest.mark.slow
@pytest.mark.skipif(
    not Path("/proc/self/clear_refs").exists(), reason="Linux tells how much memory was in use"
)
def test_keeping_and_packing_a_case_take_no_more_memory_than_was_checked(tmp_path):
    """27 000 frames, twice in memory as the rule counts; their file is as large as both."""
    done = subprocess.run([sys.executable, "-c", TAKEN, tmp_path], capture_output=True, text=True, check=True)
    run, packed, checked = map(int, done.stdout.split())
    assert checked > 200e6
    assert run < 1.1 * checked
    assert packed < 50e6


def test_damage_to_a_pack_costs_one_case(finished, copy):
    sweep, folder = copy
    pack(folder, progress=False)
    case = sweep.cases[0]
    [made] = Packs(folder)
    data = bytearray(made.files.read_bytes())
    series = made.read(f"{case.id}.series.parquet")
    data[bytes(data).index(series) + len(series) // 2] ^= 1
    made.files.write_bytes(data)
    with pytest.raises(ConfigError, match=rf"{made.files.name}' is damaged at {case.id}\.series\.parquet"):
        sweep.series(case, folder)
    outcome = sweep.run(folder, progress=False)
    assert (outcome.finished, outcome.computed) == (3, 1)
    assert f"{made.files.name}' is damaged" in outcome.replaced[0]
    for one in sweep.cases:
        assert sweep.series(one, folder).equals(sweep.series(one, finished[1]))
    # What was computed anew comes before what is packed, and is not lost to it.
    assert list(pack(folder, progress=False).left) == [case.id]
    assert sweep.series(case, folder).equals(sweep.series(case, finished[1]))
    assert scan_folder(folder).collect().height == 3
    made.files.unlink()
    assert sweep.table(folder).collect().height == 3
    assert sweep.run(folder, progress=False).computed == 3


def cut(data: bytes) -> bytes:
    """Leave a file that cannot be read."""
    return data[:-10]


def flipped(data: bytes) -> bytes:
    """Change a digit of the digest: the file can be read."""
    head, mark, tail = data.rpartition(b'"sha256": "')
    return head + mark + (b"1" if tail[:1] == b"0" else b"0") + tail[1:]


@pytest.mark.parametrize("damaged", [cut, flipped])
def test_damaged_rows_of_a_pack_are_no_loss(finished, copy, damaged):
    sweep, folder = copy
    pack(folder, progress=False)
    [made] = Packs(folder)
    made.rows.write_bytes(damaged(made.rows.read_bytes()))
    # What is known of packs is kept until their folder changes.
    os.utime(folder / "packs", (0, 0))
    hint = re.escape(f"unzip {made.files} -d {folder}, then remove both files of this pack")
    for use in (lambda: sweep.table(folder), lambda: scan_folder(folder)):
        with pytest.raises(ConfigError, match=rf"{made.rows.name}' is damaged.*; {hint}"):
            use()
    with zipfile.ZipFile(made.files) as archive:
        archive.extractall(folder)
    made.files.unlink()
    made.rows.unlink()
    assert_same_results(sweep, folder, finished[1])


def test_rows_of_older_columns_are_made_again_from_a_pack(copy, monkeypatch):
    sweep, folder = copy
    case = sweep.cases[0]
    path = folder / f"{case.id}.parquet"
    before, table = path.read_bytes(), sweep.table(folder).collect()
    old = pl.read_parquet(path).drop("drifting")
    with pytest.MonkeyPatch.context() as patch:
        # The version that packed it had other columns.
        for one in sweep.cases:
            row = pl.read_parquet(folder / f"{one.id}.parquet").drop("drifting")
            write_sealed(folder / f"{one.id}.parquet", one.id, "summary", row)
        for where in ("store", "packs"):
            patch.setattr(f"drumrs.sweep.{where}.schema", lambda: dict(old.schema))
        assert pack(folder, progress=False).cases == 3
    for use in (lambda: sweep.table(folder), lambda: scan_folder(folder)):
        with pytest.raises(ConfigError, match="has the columns of another version of drumrs"):
            use()
    monkeypatch.setattr("drumrs.sweep.worker.Simulation", None)
    assert sweep.run(folder, progress=False).finished == 3
    assert path.read_bytes() == before
    assert sweep.table(folder).collect().equals(table)
    assert scan_folder(folder).collect().height == 3


def test_a_folder_is_scanned_without_its_sweep(finished, copy):
    sweep, folder = copy
    columns = sweep.table(folder).collect().sort("case")
    drumrs.Sweep.from_configs([sweep.cases[0].config]).run(folder, progress=False)
    assert scan_folder(folder).collect().sort("case").equals(columns)
    pack(folder, progress=False)
    assert scan_folder(folder).collect().sort("case").equals(columns)
    # Two that packed at the same time packed the same cases; one was broken off.
    other = folder.parent / "other"
    shutil.copytree(finished[1], other)
    pack(other, progress=False)
    shutil.copytree(other / "packs", folder / "packs", dirs_exist_ok=True)
    shutil.copy(finished[1] / f"{sweep.cases[0].id}.parquet", folder)
    assert len(list(Packs(folder))) == 2
    assert scan_folder(folder).collect().sort("case").equals(columns)
    assert sweep.table(folder).collect().height == 3
    with pytest.raises(ConfigError, match="must be the folder of a sweep, with a file"):
        scan_folder(folder / "packs")


def test_halves_of_packs_that_were_killed_go(copy):
    _, folder = copy
    pack(folder, progress=False)
    whole = set((folder / "packs").iterdir())
    old, young = folder / "packs" / "0.zip", folder / "packs" / ".1.zip.0badcafe.tmp"
    for path in (old, young, *whole):
        path.touch()
        os.utime(path, (0, 0) if path != young else None)
    pack(folder, progress=False)
    assert set((folder / "packs").iterdir()) == whole | {young}


def test_a_pack_has_a_limit(copy, monkeypatch):
    sweep, folder = copy
    monkeypatch.setattr(packing, "_MOST_CASES", 2)
    assert pack(folder, progress=False).packs == 2
    assert sweep.table(folder).collect().height == 3


def test_a_case_comes_back(finished, copy, drum):
    sweep, folder = copy
    pack(folder, progress=False)
    case = sweep.cases[0]
    status_, _, complaint = drum("view", folder / case.id[:6], "--no-open")
    assert status_ == 2
    assert complaint.rstrip().endswith(f"where it is packed: drumrs pack {folder} --unpack {case.id[:6]}")
    status_, _, complaint = drum("view", folder, "--no-open")
    assert (status_, "its cases are packed; drumrs pack" in complaint) == (2, True)
    status_, printed, _ = drum("pack", folder, "--unpack", case.id[:6])
    assert status_ == 0
    assert loose(folder) == {
        name: data for name, data in loose(finished[1]).items() if name.startswith(case.id)
    }
    assert {line.rpartition("/")[2] for line in printed.splitlines()} == loose(folder).keys()
    assert drum("view", folder / case.id[:6], "--no-open")[0] == 0
    (folder / f"{case.id}.player.html").unlink()
    assert pack(folder, progress=False).files == 5
    for wrong in ("", "zz"):
        with pytest.raises(ConfigError, match="must be the id of one packed case, or its beginning"):
            unpack(folder, wrong)


def test_facts_of_the_packed_are_read(copy):
    sweep, folder = copy
    # Whatever somebody else wrote there is no fact.
    (folder / f"{sweep.cases[2].id}.facts.json").write_bytes(b"[")
    pack(folder, progress=False)
    assert sweep.facts(folder).height == 2
    drumrs.Sweep(BASE, seeds=[1, 2, 3]).write_plan(folder)
    found = status(folder)
    assert (found.planned, found.finished, found.packed, found.left, found.others) == (3, 2, 3, 1, 1)
    assert found.core_hours_left is not None
    assert 0.0 < found.core_hours_left < 1.0
    # What is packed gets no file again.
    assert loose(folder).keys() == {f"{drumrs.Sweep(BASE, seeds=[3]).cases[0].id}.toml"}
