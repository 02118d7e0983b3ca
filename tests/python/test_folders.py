"""A folder is one run's: another run is refused, and so is what would overwrite a file that drumrs did not write."""

import json
import shutil

import pytest

import drumrs
from drumrs.errors import ConfigError
from drumrs.folders import RUN_FILES
from drumrs.run_folder import RunFolder

SHORT = ["--set", "load.count=5", "--set", "run.duration=0.03"]
CONFIG = drumrs.baseline().replace({"load.count": 5, "run.duration": 0.03, "run.frame_every": 0.01})


@pytest.fixture(scope="module")
def result():
    return drumrs.run(CONFIG, progress=False)


@pytest.fixture(scope="module")
def finished(result, tmp_path_factory):
    """The folder of a finished run; not to be changed."""
    folder = tmp_path_factory.mktemp("finished")
    drumrs.save(result, folder, pictures=False)
    return folder


@pytest.fixture
def folder(finished, tmp_path):
    shutil.copytree(finished, tmp_path / "out")
    return tmp_path / "out"


def contents(folder) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_a_config_of_the_users_is_never_overwritten(drum, tmp_path, monkeypatch):
    own = "# my machine\n[load]\ncount = 5\n"
    (tmp_path / "config.toml").write_text(own)
    monkeypatch.chdir(tmp_path)
    for words in ((), ("--force",)):
        status, _, told = drum("run", "config.toml", *SHORT, "--out", ".", *words)
        assert status == 2
        assert "must be another folder than that of 'config.toml', which would be overwritten" in told
    status, _, told = drum("run", *SHORT, "--out", ".", "--force")
    assert status == 2
    assert "has a config.toml that is not overwritten, for drumrs did not write it" in told
    assert contents(tmp_path) == {"config.toml": own.encode()}


@pytest.mark.parametrize("name", RUN_FILES)
def test_no_file_of_another_is_overwritten(result, tmp_path, name):
    (tmp_path / name).write_text("mine")
    with pytest.raises(ConfigError, match=f"this one has a {name} that is not overwritten"):
        drumrs.save(result, tmp_path, force=True)
    assert contents(tmp_path) == {name: b"mine"}


def test_files_beside_the_results_do_no_harm(result, tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    drumrs.save(result, tmp_path, pictures=False)
    assert drumrs.load(tmp_path).config == CONFIG
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_a_run_does_not_take_the_place_of_another(drum, folder):
    before = contents(folder)
    status, _, told = drum("run", *SHORT, "--seed", "2", "--out", folder)
    assert status == 2
    assert "must be a folder without a run: it holds that of 5 bundles" in told
    assert "replace it: --force; or choose another folder" in told
    assert "--resume" not in told
    assert contents(folder) == before


def test_forced_it_leaves_nothing_of_the_other(drum, folder):
    for name in ("player.html", "snapshots.png", "time_series.png"):
        (folder / name).write_text("of the other run")
    config = CONFIG.replace({"run.seed": 2})
    # As after a kill at the start of the run.
    RunFolder(folder).begin(config)
    assert set(contents(folder)) == {"config.toml", "drumrs-run.json"}
    assert drumrs.Config.read(folder / "config.toml") == config
    # Nothing that one could miss is there: no --force is needed.
    assert drum("run", *SHORT, "--seed", "3", "--out", folder)[0] == 0
    assert drum("run", *SHORT, "--seed", "4", "--out", folder, "--force")[0] == 0
    assert drumrs.load(folder).config.run.seed == 4


def test_an_unfinished_run_says_how_to_go_on(drum, tmp_path):
    folder = RunFolder(tmp_path)
    folder.begin(CONFIG)
    simulation = drumrs.Simulation(CONFIG)
    simulation.run(steps=10)
    folder.save(simulation)
    status, _, told = drum("run", *SHORT, "--out", tmp_path)
    assert status == 2
    assert f"go on with it: drumrs run --resume {tmp_path}; replace it: --force" in told
    assert drum("run", "--resume", tmp_path)[0] == 0


def test_resume_takes_no_folder_of_others(drum, tmp_path):
    simulation = drumrs.Simulation(CONFIG)
    simulation.run(steps=10)
    simulation.save(tmp_path / "checkpoint.bin")
    for name, told in (
        ("drumrs-sweep.json", "must be a new folder or one of a run: it is that of a sweep"),
        ("config.toml", "this one has a config.toml that is not overwritten, for drumrs did not write it"),
    ):
        (tmp_path / name).write_text("")
        before = contents(tmp_path)
        status, _, complaint = drum("run", "--resume", tmp_path)
        assert status == 2
        assert f"--resume is {str(tmp_path)!r}" in complaint
        assert told in complaint
        assert contents(tmp_path) == before
        (tmp_path / name).unlink()


def test_save_writes_the_same_run_again_but_no_other(result, folder):
    drumrs.save(result, folder, pictures=False)
    other = drumrs.run(CONFIG, seed=2, progress=False)
    with pytest.raises(ConfigError, match="replace it: force=True; or choose another folder"):
        drumrs.save(other, folder)
    assert drumrs.load(folder).config == CONFIG
    (folder / "player.html").write_text("of the other run")
    drumrs.save(other, folder, pictures=False, force=True)
    assert drumrs.load(folder).config.run.seed == 2
    assert not (folder / "player.html").exists()


def test_a_damaged_marker_does_not_give_a_run_away(result, folder):
    (folder / "drumrs-run.json").write_text("{")
    with pytest.raises(ConfigError, match="it holds that of an unknown case"):
        drumrs.save(result, folder)


@pytest.mark.parametrize("found", [2, "x"])
def test_a_run_of_a_newer_format_is_not_read(folder, found):
    mark = json.loads((folder / "drumrs-run.json").read_text())
    (folder / "drumrs-run.json").write_text(json.dumps({**mark, "format": found}))
    with pytest.raises(ConfigError, match=f"is of format {found}, but must be of format 1 at most: a newer"):
        drumrs.load(folder)


def test_results_of_several_kinds_do_not_share_a_folder(drum, folder, tmp_path):
    from drumrs.paper import Reproduction

    sweep = drumrs.Sweep(CONFIG, seeds=1)
    sweep.run(tmp_path / "sweep", progress=False)
    for use in (lambda: sweep.run(folder), lambda: Reproduction("quick", folder)):
        with pytest.raises(ConfigError, match="it is that of a run; choose another"):
            use()
    for command in ("run", "baseline"):
        status, _, told = drum(command, *SHORT, "--out", tmp_path / "sweep")
        assert status == 2
        assert "it is that of a sweep; choose another" in told


def test_a_table_of_the_users_is_not_overwritten(tmp_path):
    from drumrs.paper import Reproduction

    (tmp_path / "table.parquet").write_text("mine")
    sweep = drumrs.Sweep(CONFIG, seeds=1)
    uses = (
        lambda: sweep.run(tmp_path),
        lambda: sweep.write_table(tmp_path),
        lambda: Reproduction("quick", tmp_path),
    )
    for use in uses:
        with pytest.raises(ConfigError, match=r"this one has a table\.parquet that is not overwritten"):
            use()
    assert contents(tmp_path) == {"table.parquet": b"mine"}


def test_a_comparison_is_written_again_but_no_other(drum, tmp_path):
    words = ["baseline", "--fill", "0.02", *SHORT[2:], "--out", tmp_path]
    assert drum(*words)[0] == 0
    assert drum(*words)[0] == 0
    status, _, told = drum(*words, "--seed", "2")
    assert status == 2
    assert "must be a folder without a run: it holds that of 8 bundles" in told
    assert drum(*words, "--seed", "2", "--force")[0] == 0
    assert json.loads((tmp_path / "without_baffles" / "drumrs-run.json").read_text())["title"].endswith(
        "seed 2"
    )


def test_verify_overwrites_its_own_page_only(drum, tmp_path):
    page = tmp_path / "page.html"
    words = ["verify", "--only", "restitution-clipped", "--html", page]
    assert drum(*words)[0] == 0
    assert drum(*words)[0] == 0
    page.write_text("<html>mine</html>")
    status, _, told = drum(*words)
    assert status == 2
    assert "this one is another's, and is not overwritten" in told
    assert page.read_text() == "<html>mine</html>"
