"""Exports as ParaView and OVITO see them: their own readers, in an environment of their own."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import drumrs
from drumrs.exports import FORMATS
from drumrs.outline import turned

PYTHON = Path(__file__).parents[3] / "target" / "programs" / "bin" / "python"
INDEX = 5


@pytest.fixture(scope="module")
def result() -> drumrs.Result:
    changes = {"run.duration": 0.2, "run.sample_every": 0.01, "run.frame_every": 0.02}
    return drumrs.run(drumrs.baseline(fill=0.1, baffles=True).replace(changes), progress=False)


def seen(path: Path) -> dict:
    if not PYTHON.exists():
        sentence = f"{PYTHON} is not there: make check-long makes it"
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(sentence)
    command = [PYTHON, Path(__file__).with_name("read_by_programs.py"), path, str(INDEX)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "ERR|" not in done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.slow
def test_paraview_sees_bundles_and_a_drum_that_turns(result, tmp_path):
    frames = result.frames
    drumrs.export(result, tmp_path / "run.vtkhdf")
    bundles, drum = seen(tmp_path / "run.vtkhdf"), seen(tmp_path / "run-drum.vtkhdf")
    assert bundles["times"] == drum["times"] == pytest.approx(frames.times)
    assert np.array(bundles["points"]) == pytest.approx(frames.positions[INDEX])
    assert bundles["cells"] == [frames.count, 0, 0]
    assert bundles["last"]["radius"] == pytest.approx([frames.radii[-1]])
    assert bundles["last"]["speed"] == pytest.approx([frames.speeds[INDEX, -1]])
    assert drum["cells"] == [0, 1, 3]
    tips = np.concatenate([turned(line, frames.drum_angles[INDEX]) for line in frames.baffles])
    shown = np.array(drum["points"])
    assert np.hypot(*(shown[:, np.newaxis] - tips).T).min(axis=1).max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("to", ["gsd", "lammps", "xyz"])
def test_ovito_sees_particles_with_radius_and_orientation(to, result, tmp_path):
    frames, path = result.frames, tmp_path / f"run{FORMATS[to].ending}"
    drumrs.export(result, path)
    told, count = seen(path), frames.count
    assert told["frames"] == len(frames)
    assert np.array(told["Position"])[:count, :2] == pytest.approx(frames.positions[INDEX], abs=1e-6)
    assert np.array(told["Velocity"])[:count, :2] == pytest.approx(frames.velocities[INDEX], abs=1e-5)
    assert told["Radius"][:count] == pytest.approx(frames.radii)
    kinds = told["Particle Type"]
    assert len(set(kinds[:count])) == 1
    assert set(kinds[count:]) == {max(kinds)} != set(kinds[:count])
    if to != "lammps":
        assert list(told["types"].values()) == ["bundle", "drum"]
    if to != "xyz":
        *_, sin, cos = np.array(told["Orientation"])[:count].T
        assert 2.0 * np.arctan2(sin, cos) == pytest.approx(frames.angles[INDEX], abs=1e-5)
