"""A picture that fails: the numbers are saved, everything else is made, one line says which picture and why."""

import os
import subprocess
import sys

import pytest

import drumrs
from drumrs.errors import PictureWarning

SHORT = ["--set", "load.count=5", "--set", "run.duration=0.03"]
MARK = "drumrs-run.json"
NUMBERS = {"config.toml", "series.parquet", "frames.parquet", "summary.json"}
PICTURES = ["player.html", "snapshots.png", "time_series.png"]
BREAKS = {
    "time_series.png": "drumrs.figures.time_series",
    "snapshots.png": "drumrs.figures.snapshots",
    "player.html": "drumrs.viewer.page.Player.page",
}


def fail(*_, **__):
    raise RuntimeError("no font\nof that name")


@pytest.fixture(scope="module")
def result():
    return drumrs.run(drumrs.baseline().replace({"load.count": 5, "run.duration": 0.03}), progress=False)


@pytest.mark.parametrize("picture", PICTURES)
def test_save_warns_and_writes_the_rest(picture, result, monkeypatch, tmp_path):
    # Of what an earlier call wrote, the picture that fails now must not stay.
    drumrs.save(result, tmp_path)
    monkeypatch.setattr(BREAKS[picture], fail)
    with pytest.warns(
        PictureWarning, match=f"{picture} could not be made .RuntimeError: no font of that name"
    ):
        written = drumrs.save(result, tmp_path)
    there = {*NUMBERS, *PICTURES} - {picture}
    assert {path.name for path in written} == there
    assert {path.name for path in tmp_path.iterdir()} == {*there, MARK}
    assert drumrs.load(tmp_path).summary == result.summary


def test_summary_and_status_of_run(drum, monkeypatch, tmp_path):
    monkeypatch.setattr("drumrs.figures.snapshots", fail)
    status, out, err = drum("run", *SHORT, "--out", tmp_path / "out")
    assert status == 3
    assert "specific power [W/kg]" in out
    assert f"wrote {tmp_path / 'out' / 'summary.json'}" in out
    assert "snapshots.png" not in out
    lines = [line for line in err.splitlines() if "snapshots.png" in line]
    assert lines == [
        f"drumrs: {tmp_path / 'out' / 'snapshots.png'} could not be made (RuntimeError: no font of that name); "
        "the numbers are complete"
    ]
    assert not (tmp_path / "out" / "records").exists()


def test_baseline_prints_its_table(drum, monkeypatch, tmp_path):
    monkeypatch.setattr("drumrs.figures.snapshots", fail)
    status, out, err = drum("baseline", "--fill", "0.05", "--set", "run.duration=0.03", "--out", tmp_path)
    assert status == 3
    assert "with baffles" in out
    assert f"{tmp_path / 'baseline.png'} could not be made" in err


def test_the_end_of_an_unstable_run_is_told(drum, monkeypatch, tmp_path):
    monkeypatch.setattr("drumrs.viewer.page.Player.page", fail)
    soft = ["--softer", "30000", "--set", "run.duration=3", "--set", "rotation.rpm=100"]
    status, _, err = drum("run", *soft, "--out", tmp_path / "out")
    assert status == 1
    assert "player.html could not be made" in err
    assert (tmp_path / "out" / "unstable.json").exists()


def test_the_verification_s_page_goes_without_a_plot(drum, monkeypatch, tmp_path):
    monkeypatch.setattr("drumrs.verification.picture.agreement", fail)
    page = tmp_path / "page.html"
    status, _, err = drum("verify", "--only", "stack", "--html", page)
    assert status == 3
    assert "the plot of stack could not be made" in err
    assert "stack" in page.read_text(encoding="utf-8")


def test_a_backend_of_another_environment(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "drumrs", "run", *SHORT, "--out", "out"],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "module://matplotlib_inline.backend_inline"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        *NUMBERS,
        *PICTURES,
        MARK,
        "checkpoint.bin",
    }
