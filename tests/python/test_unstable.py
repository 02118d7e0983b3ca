"""A run that ends unstable: what it leaves, and what --resume answers."""

import json

import polars as pl
import pytest

import drumrs
from drumrs import ConfigError, Frames, UnstableError

# So soft that the load crushes itself.
SOFT = ["--softer", "30000", "--set", "run.duration=3", "--set", "rotation.rpm=100"]


@pytest.fixture
def ended(drum, tmp_path):
    folder = tmp_path / "out"
    status, _, told = drum("run", *SOFT, "--out", str(folder))
    assert status == 1
    return folder, told


def test_what_was_recorded_is_kept(ended, drum):
    folder, told = ended
    kept = json.loads((folder / "unstable.json").read_text())
    assert f"look at its end with: drumrs view {folder}" in told
    assert f"drumrs: {kept['error']}" in told
    assert f"at step {kept['step']} (t = {kept['time']:.6f} s)" in kept["error"]
    assert {"config.toml", "series.parquet", "frames.parquet", "player.html"} <= {
        p.name for p in folder.iterdir()
    }
    assert not (folder / "summary.json").exists()
    frames = Frames.load(folder / "frames.parquet")
    assert frames.times[-1] == pytest.approx(kept["time"], rel=1e-12)
    assert (frames.times[1:] > frames.times[:-1]).all()
    assert pl.read_parquet(folder / "series.parquet")["time"][-1] <= kept["time"]
    page = (folder / "player.html").read_bytes()
    assert b"ended unstable at t = " in page
    # Who views it later reads the same title.
    (folder / "player.html").unlink()
    assert drum("view", folder, "--no-open")[0] == 0
    assert (folder / "player.html").read_bytes() == page


def test_resume_does_not_repeat_it(ended, drum):
    folder, _ = ended
    status, _, told = drum("run", "--resume", str(folder))
    assert status == 2
    assert "ended unstable, and going on would repeat that: the overlap of bundle" in told
    assert f"drumrs run {folder / 'config.toml'} --set run.time_step=auto --set contact.bundle" in told
    with pytest.raises(ConfigError, match="holds a run that ended unstable"):
        drumrs.load(folder)


def test_the_folder_may_be_used_again_where_asked_for(ended, drum):
    folder, _ = ended
    status, _, _ = drum(
        "run", "--set", "load.count=5", "--set", "run.duration=0.03", "--out", folder, "--force"
    )
    assert status == 0
    assert not (folder / "unstable.json").exists()
    assert len(drumrs.load(folder).frames) > 0


def test_means_over_what_there_is_of_the_window_are_kept(drum, tmp_path):
    # The drum is torn round after the window has begun.
    settings = [
        "rotation.program=[[0, 0], [0.05, 0], [0.06, 1e6]]",
        "run.window=[0.01, 0.1]",
        "run.duration=0.2",
    ]
    words = [word for setting in settings for word in ("--set", setting)]
    status, _, _ = drum("run", *words, "--set", "load.count=5", "--softer", "100", "--out", str(tmp_path))
    assert status == 1
    summary = json.loads((tmp_path / "unstable.json").read_text())["summary"]
    assert summary["window_start"] == pytest.approx(0.01, abs=0.002)
    assert 0.045 < summary["window_end"] < 0.1


def test_a_simulation_keeps_its_series_and_the_last_frame():
    state = drumrs.State([[0.0, 0.0], [0.1, 0.0]], [[1e4, 0.0], [-1e4, 0.0]])
    simulation = drumrs.Simulation(drumrs.baseline(), state=state)
    with pytest.raises(UnstableError) as first:
        simulation.run(steps=1000)
    assert simulation.frames.times[-1] == simulation.time
    assert simulation.series.height >= 1
    with pytest.raises(UnstableError) as second:
        simulation.run(steps=1000)
    assert str(first.value) == str(second.value)
    assert len(simulation.frames) == 2


def test_who_made_springs_softer_is_told_the_way_out(drum):
    status, _, told = drum("run", *SOFT)
    assert status != 0
    assert "the springs are 30000 times softer than the case's: overlaps go with the root of --softer" in told
