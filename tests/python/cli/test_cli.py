"""The command line: JSON, folders, layers, checkpoints, Ctrl-C."""

import json
import signal
import subprocess
import sys
import time
import tomllib

import polars as pl
import pytest

import drumrs
from drumrs.cli import run_command
from drumrs.config import presets

SHORT = ["--set", "run.duration=0.03", "--set", "run.frame_every=0.01", "--set", "load.count=20"]
KEYS = {
    "bundle_count",
    "fill",
    "steps",
    "time_step",
    "drum_torque",
    "drum_power",
    "drum_specific_power",
    "drum_specific_power_error",
    "normal_power",
    "tangential_power",
    "work_ratio",
    "center_of_mass_x",
    "center_of_mass_y",
    "coordination",
    "max_overlap_ratio",
    "energy_residual",
    "power_disagreement",
    "wall_time",
    "particle_steps_per_second",
}
TIMINGS = {"wall_time", "particle_steps_per_second"}


def summary(folder) -> dict:
    values = json.loads((folder / "summary.json").read_text())
    return {key: value for key, value in values.items() if key not in TIMINGS}


def test_json_is_one_object(drum):
    status, printed, _ = drum("run", *SHORT, "--json")
    values = json.loads(printed)
    assert status == 0
    assert set(values) >= KEYS
    assert values["bundle_count"] == 20


def test_out_holds_everything(drum, tmp_path):
    out = tmp_path / "deep" / "out"
    status, printed, _ = drum("run", *SHORT, "--seed", "7", "--out", out)
    assert status == 0
    assert "wall time [s]" in printed
    tables = "summary.json series.parquet frames.parquet config.toml"
    names = f"{tables} snapshots.png time_series.png player.html checkpoint.bin drumrs-run.json"
    assert {path.name for path in out.iterdir()} == set(names.split())
    assert drumrs.load(out).config.run.seed == 7
    assert json.loads(pl.read_parquet_metadata(out / "series.parquet")["units"])["drum_power"] == "W/m"


def test_layers(drum, tmp_path):
    case = tmp_path / "case.toml"
    case.write_text("[load]\ncount = 30\n[run]\nseed = 5\n")
    words = [case, "--set", "run.duration=0.03", "--set", "run.seed=6", "--set", "load.fill=0.05"]
    assert json.loads(drum("run", case, "--set", "run.duration=0.03", "--json")[1])["bundle_count"] == 30
    assert json.loads(drum("run", *words, "--json")[1])["bundle_count"] == 20
    drum("run", *words, "--seed", "7", "--out", tmp_path / "out")
    assert drumrs.Config.read(tmp_path / "out" / "config.toml").run.seed == 7


def test_config_prints_the_presets_of_species(drum):
    status, printed, _ = drum("config", "--species")
    assert status == 0
    assert tomllib.loads(printed) == presets()


def test_config_command_round_trips(drum):
    status, printed, _ = drum("config")
    assert status == 0
    assert drumrs.Config.from_toml(printed) == drumrs.baseline()


def test_info_and_version(drum):
    assert drum("--version")[1].strip() == drumrs.__version__
    printed = drum("info")[1]
    assert "build_profile: " in printed
    assert "cpu_features: " in printed


def test_help_teaches(drum):
    status, printed, _ = drum("--help")
    assert status == 0
    assert "drumrs run case.toml" in printed


def test_resume_is_byte_identical(drum, tmp_path):
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    assert drum("run", *SHORT, "--out", whole)[0] == 0
    # As after a power cut: a folder with nothing but the checkpoint of a run's middle.
    broken.mkdir()
    config = drumrs.Config.read(whole / "config.toml")
    simulation = drumrs.Simulation(config)
    simulation.run(steps=1001)
    simulation.save(broken / "checkpoint.bin")
    assert drum("run", "--resume", broken)[0] == 0
    for name in ("series.parquet", "frames.parquet", "config.toml", "snapshots.png", "time_series.png"):
        assert (whole / name).read_bytes() == (broken / name).read_bytes(), name
    assert summary(whole) == summary(broken)


LONG = [
    "--set",
    "run.checkpoint_every=0.02",
    *SHORT,
    "--set",
    "run.duration=2",
    "--set",
    "run.frame_every=0.5",
]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of a run that nothing has stopped; not to be changed."""
    folder = tmp_path_factory.mktemp("whole")
    assert run_command(["run", *LONG, "--quiet", "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize("blow", [signal.SIGKILL, signal.SIGINT])
def test_resume_after_a_blow_is_byte_identical(drum, tmp_path, whole, blow):
    broken = tmp_path / "broken"
    command = [sys.executable, "-m", "drumrs", "run", *LONG, "--out", broken]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    seen = _wait_for_checkpoint(broken, process)
    process.send_signal(blow)
    _, complaint = process.communicate(timeout=20)
    assert not (broken / "summary.json").exists(), "the blow came too late to test anything"
    assert "Traceback" not in complaint
    if blow == signal.SIGINT:
        assert process.returncode == 130
        assert f"drumrs run --resume {broken}" in complaint
    assert drumrs.Simulation.load(broken / "checkpoint.bin").step >= seen
    assert drum("run", "--resume", broken)[0] == 0
    for name in ("series.parquet", "frames.parquet", "config.toml"):
        assert (whole / name).read_bytes() == (broken / name).read_bytes(), name
    assert summary(whole) == summary(broken)


def _wait_for_checkpoint(folder, process) -> int:
    """Wait for a checkpoint of a run under way, and return its step."""
    path, end = folder / "checkpoint.bin", time.monotonic() + 20
    while time.monotonic() < end and process.poll() is None:
        step = drumrs.Simulation.load(path).step if path.exists() else 0
        if step > 0:
            return step
        time.sleep(0.01)
    raise AssertionError("no checkpoint came")


def test_unstable_run_keeps_the_last_good_checkpoint(drum, tmp_path):
    soft = ["--set", "contact.drum.normal_stiffness=1e3", "--set", "contact.bundle.normal_stiffness=1e3"]
    limit = ["--set", "run.overlap_limit=0.01", "--set", "run.duration=5"]
    status, printed, complaint = drum("run", *soft, *limit, "--out", tmp_path / "out")
    assert (status, printed) == (1, "")
    assert "step" in complaint.splitlines()[-1]
    assert drumrs.Simulation.load(tmp_path / "out" / "checkpoint.bin").step >= 0


def test_baseline_compares_both(drum, tmp_path):
    status, printed, _ = drum("baseline", *SHORT[:4], "--fill", "0.05", "--out", tmp_path)
    assert status == 0
    assert "without baffles" in printed
    assert (tmp_path / "baseline.png").is_file()
    assert (tmp_path / "with_baffles" / "summary.json").is_file()


def test_examples_end_the_help_of_drumrs_alone(drum):
    assert "Examples:" in drum("--help")[1]
    for command in ("run", "sweep", "verify"):
        assert "Examples:" not in drum(command, "--help")[1]
