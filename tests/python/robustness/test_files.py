"""Any bytes as a checkpoint, any content of a folder of results: named and refused, or computed again."""

import contextlib
import hashlib
import json
import os
import random
import shutil

import polars as pl
import pytest

import drumrs
from drumrs.errors import CheckpointError, ConfigError, UnstableError
from drumrs.sweep.sealed import _BLANK, read_sealed, write_sealed

BASE = drumrs.baseline(fill=0.02).replace(
    {"run.duration": 0.01, "run.sample_every": 0.001, "run.frame_every": 0.005}
)


@pytest.fixture(scope="module")
def checkpoint(tmp_path_factory) -> bytes:
    simulation = drumrs.Simulation(BASE.replace({"load.fill": None, "load.count": 2}))
    simulation.run(steps=20)
    path = tmp_path_factory.mktemp("checkpoint") / "checkpoint.bin"
    simulation.save(path)
    return path.read_bytes()


def load(path, data: bytes) -> str:
    """Load bytes as a checkpoint and go on from them, if they are one."""
    path.write_bytes(data)
    try:
        simulation = drumrs.Simulation.load(path)
        simulation.run(steps=5)
        assert simulation.summary((0.0, simulation.time)).steps == simulation.step
    except (CheckpointError, UnstableError, ConfigError) as error:
        return type(error).__name__
    return "loaded"


def test_every_byte_of_a_checkpoint_counts(checkpoint, tmp_path):
    for index in range(0, len(checkpoint), 23):
        data = bytearray(checkpoint)
        data[index] ^= 1 << index % 8
        assert load(tmp_path / "c", bytes(data)) == "CheckpointError", index


def test_a_checkpoint_cut_anywhere_is_refused(checkpoint, tmp_path):
    for length in [*range(64), *range(64, len(checkpoint), 97)]:
        assert load(tmp_path / "c", checkpoint[:length]) == "CheckpointError", length


def resealed(head: bytes, core: bytes) -> bytes:
    """Return a file whose digests all match, whatever it holds."""
    body = core[44:]
    core = core[:12] + hashlib.sha256(body).digest() + body
    whole = b"drumrs checkpoint 1\n" + head + b"\n" + core
    return whole + hashlib.sha256(whole).digest()


def parts(checkpoint: bytes) -> tuple[bytes, bytes]:
    _, head, core = checkpoint[:-32].split(b"\n", 2)
    return head, core


def test_forged_checkpoints_with_digests_that_match_do_no_harm(checkpoint, tmp_path):
    head, core = parts(checkpoint)
    draw = random.Random(1)
    seen = set()
    for _ in range(150):
        forged = bytearray(core)
        for _ in range(draw.choice([1, 1, 2, 5])):
            # 0xff … makes lengths that no memory could hold.
            forged[draw.randrange(44, len(core))] = draw.choice([0, 1, 127, 128, 255, draw.randrange(256)])
        seen.add(load(tmp_path / "c", resealed(head, bytes(forged))))
    assert "CheckpointError" in seen


@pytest.mark.parametrize("head", [b"", b"[]", b"{", b"[" * 100_000, b'{"load": 3}', b"\xff", b"1" * 5000])
def test_a_checkpoint_without_a_configuration_is_refused(checkpoint, tmp_path, head):
    assert load(tmp_path / "c", resealed(head, parts(checkpoint)[1])) == "CheckpointError"


def test_a_checkpoint_with_another_configuration_is_refused(checkpoint, tmp_path):
    other = json.dumps(BASE.replace({"drum.baffles.count": 3}).model_dump(mode="json", exclude_none=True))
    assert load(tmp_path / "c", resealed(other.encode(), parts(checkpoint)[1])) == "CheckpointError"


def test_what_is_no_file_is_no_checkpoint(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    for path in (tmp_path / "pipe", tmp_path / "folder", tmp_path / "nothing", "/dev/zero"):
        with pytest.raises(CheckpointError, match="it cannot be read"):
            drumrs.Simulation.load(path)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    folder = tmp_path_factory.mktemp("finished")
    sweep = drumrs.Sweep(BASE, {"load.fill": [0.02, 0.03]})
    sweep.run(folder, progress=False)
    return sweep, folder


@pytest.fixture
def copy(finished, tmp_path):
    sweep, folder = finished
    shutil.copytree(folder, tmp_path / "copy")
    return sweep, tmp_path / "copy"


ENDINGS = ["toml", "parquet", "series.parquet", "frames.parquet", "facts.json", "error.json"]


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_folder_in_the_place_of_a_result_is_named_before_anything_runs(copy, monkeypatch, ending):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.{ending}"
    path.unlink(missing_ok=True)
    path.mkdir()
    monkeypatch.setattr("drumrs.sweep.worker.Simulation", None)
    with pytest.raises(ConfigError, match=f"{path.name}' is a folder, but must be a file of results"):
        sweep.run(folder, progress=False)
    assert path.is_dir()


def nothing_there(path):
    path.symlink_to("nothing")


def itself(path):
    path.symlink_to(path.name)


def device(path):
    path.symlink_to("/dev/zero")


def pipe(path):
    os.mkfifo(path)


def huge(path):
    with path.open("wb") as file:
        file.truncate(2**40)


def huge_with_an_end(path):
    with path.open("wb") as file:
        file.truncate(2**40)
        file.seek(0, os.SEEK_END)
        file.write(b"PAR1")


STRANGE = [nothing_there, itself, device, pipe, huge, huge_with_an_end]


@pytest.mark.parametrize("ending", ["parquet", "series.parquet", "frames.parquet"])
@pytest.mark.parametrize("strange", STRANGE, ids=lambda make: make.__name__)
def test_what_is_no_table_is_computed_again(copy, strange, ending):
    sweep, folder = copy
    path = folder / f"{sweep.cases[0].id}.{ending}"
    before = path.read_bytes()
    path.unlink()
    strange(path)
    outcome = sweep.run(folder, progress=False)
    assert (outcome.computed, outcome.finished) == (1, 2)
    assert path.read_bytes() == before
    assert not path.is_symlink()


@pytest.mark.parametrize("text", [b"", b"[]", b"[" * 100_000, b"1" * 5000, b'{"wall_time": "long"}', b"\xff"])
def test_words_on_a_case_may_be_anything(copy, text):
    sweep, folder = copy
    for ending in ("facts.json", "error.json", "toml"):
        (folder / f"{sweep.cases[0].id}.{ending}").write_bytes(text)
    (folder / f"{sweep.cases[1].id}.facts.json").unlink()
    os.mkfifo(folder / f"{sweep.cases[1].id}.facts.json")
    assert sweep.run(folder, progress=False).finished == 2
    assert sweep.facts().height <= 1


@pytest.mark.parametrize("make", [itself, device, pipe, lambda path: path.write_bytes(b"[" * 100_000)])
def test_a_strange_mark_is_refused(copy, make):
    sweep, folder = copy
    (folder / "drumrs-sweep.json").unlink()
    make(folder / "drumrs-sweep.json")
    if make is itself:
        # A name that leads nowhere is no mark: the folder gets one, where nothing says that it is another's.
        (folder / "plan.parquet").unlink()
        assert sweep.run(folder, progress=False).finished == 2
        return
    with pytest.raises(ConfigError, match=r"drumrs-sweep\.json' is damaged"):
        sweep.run(folder, progress=False)


def test_any_damage_to_a_table_is_named(copy):
    sweep, folder = copy
    case = sweep.cases[0]
    path = folder / f"{case.id}.parquet"
    whole, draw = path.read_bytes(), random.Random(2)
    for number in range(100):
        data = bytearray(whole)
        for _ in range(draw.choice([1, 2, 8])):
            index = draw.randrange(len(data) * 2 // 3 if number % 2 else 0, len(data))
            data[index] ^= draw.randrange(1, 256)
        path.write_bytes(data)
        with pytest.raises(ConfigError, match=path.name):
            read_sealed(path, case.id, "summary")


def test_a_forged_seal_on_any_bytes_is_refused_or_computed_again(copy):
    """The digest matches whatever the parser then meets; polars may panic over it."""
    sweep, folder = copy
    case = sweep.cases[0]
    path = folder / f"{case.id}.parquet"
    whole, draw = path.read_bytes(), random.Random(3)
    before = whole
    head, _, tail = whole.rpartition(b'"sha256": "')
    whole = head + b'"sha256": "' + _BLANK.encode() + tail[len(_BLANK) :]
    for _ in range(100):
        data = bytearray(whole)
        data[draw.randrange(len(data))] ^= draw.randrange(1, 256)
        first, _, last = bytes(data).rpartition(_BLANK.encode())
        path.write_bytes(first + hashlib.sha256(data).hexdigest().encode() + last)
        # Where the change does not matter to the parser, the file is what it says.
        with contextlib.suppress(ConfigError):
            sweep.table(folder)
    path.write_bytes(before[:-100])
    assert sweep.run(folder, progress=False).computed == 1
    assert path.read_bytes() == before


def test_a_table_of_another_kind_is_computed_again(copy):
    sweep, folder = copy
    case = sweep.cases[0]
    path = folder / f"{case.id}.series.parquet"
    before = path.read_bytes()
    write_sealed(path, case.id, "frames", pl.DataFrame({"a": [1]}))
    assert sweep.run(folder, progress=False).computed == 1
    assert path.read_bytes() == before


@pytest.mark.parametrize("name", ["summary.json", "series.parquet", "frames.parquet", "config.toml"])
@pytest.mark.parametrize("content", [b"", b"{}", b"[" * 100_000, b"PAR1" * 100])
def test_a_damaged_folder_of_a_run_is_named(tmp_path, name, content):
    drumrs.save(drumrs.run(BASE, progress=False), tmp_path / "run", pictures=False)
    (tmp_path / "run" / name).write_bytes(content)
    if (name, content) == ("config.toml", b""):
        assert drumrs.load(tmp_path / "run").config == drumrs.baseline()
        return
    with pytest.raises(ConfigError, match="run"):
        drumrs.load(tmp_path / "run")
