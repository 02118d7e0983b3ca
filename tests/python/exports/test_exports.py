"""Exports read back by the libraries that other programs read them with; by those programs in test_programs.py."""

import csv
import json
import sys
import tomllib

import duckdb
import gsd.hoomd
import h5py
import numpy as np
import pytest
import xarray

import drumrs
from drumrs.errors import ConfigError
from drumrs.exports import FORMATS
from drumrs.frames import Frames
from drumrs.outline import turned
from synthetic import made_up

STEEL = {"name": "steel", "share": 0.5, "diameter": 0.03, "density": 1500.0}
CORK = {"name": "cork", "share": 0.5, "diameter": 0.02, "density": 300.0}
SCENE = {
    "load.species": [STEEL, CORK],
    "load.share_by": "mass",
    "load.fill": 0.1,
    "drum.baffles.count": 2,
    "run.duration": 0.1,
    "run.sample_every": 0.01,
    "run.frame_every": 0.02,
}


@pytest.fixture(scope="module")
def result() -> drumrs.Result:
    return drumrs.run(drumrs.baseline().replace(SCENE), progress=False)


@pytest.fixture(scope="module")
def folder(result, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    drumrs.save(result, folder, pictures=False)
    return folder


def corners(frames: Frames, index: int) -> np.ndarray:
    """Return the corners of all baffles at the time of a frame."""
    return np.concatenate([turned(line, frames.drum_angles[index]) for line in frames.baffles])


def nearest(points: np.ndarray, wanted: np.ndarray) -> float:
    """Return how far the farthest of the wanted points is from the points."""
    return np.hypot(*(points[:, np.newaxis] - wanted).T).min(axis=1).max()


def test_vtkhdf_has_every_time_at_its_offset(result, tmp_path):
    frames, path = result.frames, tmp_path / "run.vtkhdf"
    assert drumrs.export(result, path) == [path, tmp_path / "run-drum.vtkhdf"]
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert (root.attrs["Type"], root.attrs["digest"]) == (b"PolyData", result.config.digest)
        assert drumrs.Config.from_toml(root.attrs["configuration"]) == result.config
        assert list(root.attrs["species"]) == ["cork", "steel"]
        steps, count = root["Steps"], frames.count
        assert steps["Values"][:] == pytest.approx(frames.times)
        for index in (0, 3, len(frames) - 1):
            start = steps["PointOffsets"][index]
            assert (root["Points"][start : start + count, :2] == frames.positions[index]).all()
            for name, values in (("speed", frames.speeds), ("angle", frames.angles)):
                start = steps["PointDataOffsets"][name][index]
                assert (root["PointData"][name][start : start + count] == values[index]).all()
        assert (root["PointData/radius"][:] == frames.radii).all()
        assert [("cork", "steel")[kind] for kind in root["PointData/species"]] == list(frames.species)
    with h5py.File(tmp_path / "run-drum.vtkhdf") as file:
        root = file["VTKHDF"]
        count = root["NumberOfPoints"][0]
        ends = root["Polygons/Connectivity"][:]
        for index in (0, len(frames) - 1):
            start = root["Steps/PointOffsets"][index]
            shown = root["Points"][start : start + count][ends, :2]
            assert shown == pytest.approx(corners(frames, index))


def test_gsd_has_orientations_and_a_drum_that_turns(result, tmp_path):
    frames, path = result.frames, tmp_path / "run.gsd"
    assert drumrs.export(result, path) == [path]
    (tmp_path / "other").touch()
    assert path.stat().st_mode == (tmp_path / "other").stat().st_mode
    with gsd.hoomd.open(path) as file:
        told = json.loads(bytes(file.file.read_chunk(0, "user/provenance")))
        assert drumrs.Config.from_toml(told["configuration"]) == result.config
        assert len(file) == len(frames)
        index, count = 4, frames.count
        frame = file[index]
        assert frame.log["time"] == pytest.approx(frames.times[index])
        assert frame.particles.types == ["cork", "steel", "drum"]
        kinds = [frame.particles.types[kind] for kind in frame.particles.typeid]
        assert kinds[:count] == list(frames.species)
        assert set(kinds[count:]) == {"drum"}
        assert (frame.particles.position[:count, :2] == frames.positions[index]).all()
        assert frame.particles.diameter[:count] == pytest.approx(2.0 * frames.radii)
        cos, _, _, sin = frame.particles.orientation[:count].T
        assert 2.0 * np.arctan2(sin, cos) == pytest.approx(frames.angles[index], abs=1e-5)
        beads, size = frame.particles.position[count:, :2], frame.particles.diameter[-1]
        assert nearest(beads, corners(frames, index)) < size
        assert nearest(beads, corners(frames, 0)) > size


def test_lammps_has_a_block_a_frame(result, tmp_path):
    frames, path = result.frames, tmp_path / "run.lammpstrj"
    assert drumrs.export(result, path) == [path, tmp_path / "run.lammpstrj.toml"]
    blocks = path.read_text().split("ITEM: TIME\n")
    assert blocks[0] == "ITEM: UNITS\nsi\n"
    assert len(blocks) == len(frames) + 1
    head, _, rows = blocks[-1].partition("ITEM: ATOMS ")
    names, *lines = rows.splitlines()
    values = dict(zip(names.split(), np.array([line.split() for line in lines], float).T, strict=True))
    assert int(head.split("ITEM: NUMBER OF ATOMS\n")[1].split()[0]) == len(lines)
    assert values["x"][: frames.count] == pytest.approx(frames.positions[-1, :, 0], abs=1e-7)
    assert values["vy"][: frames.count] == pytest.approx(frames.velocities[-1, :, 1], rel=1e-5, abs=1e-7)
    assert values["radius"][: frames.count] == pytest.approx(frames.radii)
    assert (values["contacts"][: frames.count] == frames.contacts[-1]).all()
    assert drumrs.Config.read(tmp_path / "run.lammpstrj.toml") == result.config


def test_xyz_names_its_columns(result, tmp_path):
    frames, path = result.frames, tmp_path / "run.xyz"
    drumrs.export(result, path)
    lines = path.read_text(encoding="utf-8").splitlines()
    size = int(lines[0])
    assert len(lines) == (size + 2) * len(frames)
    assert "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:angle:R:1:contacts:I:1" in lines[1]
    assert f"digest={result.config.digest}" in lines[1]
    kind, x, y, _, *_, radius, angle, _ = lines[-size].split()
    assert kind == frames.species[0]
    assert [float(word) for word in (x, y)] == pytest.approx(frames.positions[-1, 0], abs=1e-6)
    assert [float(radius), float(angle)] == pytest.approx([frames.radii[0], frames.angles[-1, 0]], abs=1e-5)


def test_csv_has_units_in_its_head(result, tmp_path):
    frames = result.frames
    written = drumrs.export(result, tmp_path / "run.csv")
    assert [path.name for path in written] == ["run.csv", "run-drum.csv", "run.csv.toml"]
    with written[0].open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == frames.angles.size
    assert float(rows[-1]["velocity x [m/s]"]) == pytest.approx(float(frames.velocities[-1, -1, 0]), rel=1e-6)
    assert rows[0]["species"] == frames.species[0]
    with written[1].open(newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if int(row["frame"]) == len(frames) - 1]
    shown = np.array([[float(row["x [m]"]), float(row["y [m]"])] for row in rows])
    assert nearest(shown, corners(frames, -1)) < 1e-9
    assert {row["part"] for row in rows} == {"rim", "baffle 1", "baffle 2"}


def test_netcdf_has_units_series_and_configuration(result, tmp_path):
    path = tmp_path / "run.nc"
    drumrs.export(result, path)
    with xarray.open_dataset(path) as run:
        assert run.x.dims == ("frame", "bundle")
        assert (run.x.values == result.frames.positions[..., 0]).all()
        assert run.time.values == pytest.approx(result.frames.times)
        assert (run.velocity_y.units, run.drum_power.units, run.outline_x.units) == ("m/s", "W/m", "m")
        assert run.drum_power.values == pytest.approx(result.series["drum_power"].to_numpy())
        assert run.sample_drum_angle.values == pytest.approx(result.series["drum_angle"].to_numpy())
        assert run.species.values.tolist() == list(result.frames.species)
        assert tomllib.loads(run.attrs["configuration"])["load"]["fill"] == 0.1
        assert (run.attrs["Conventions"], run.attrs["digest"]) == ("CF-1.11", result.config.digest)


def test_duckdb_finds_columns_and_units_of_a_run(folder, result):
    series = str(folder / "series.parquet")
    power = duckdb.read_parquet(series).max("drum_power").fetchall()
    assert power == [(result.series["drum_power"].max(),)]
    query = "select decode(value) from parquet_kv_metadata($1) where decode(key) = 'units'"
    told = duckdb.sql(query, params=[series])
    assert json.loads(told.fetchall()[0][0])["drum_power"] == "W/m"


@pytest.mark.parametrize("to", FORMATS)
def test_the_command_writes_beside_the_frames_and_replaces_nothing(to, folder, drum):
    status, printed, complaint = drum("export", folder, "--to", to)
    assert (status, complaint) == (0, "")
    path = folder / f"frames{FORMATS[to].ending}"
    assert printed.splitlines()[0] == f"wrote {path}"
    before = path.read_bytes()
    path.write_bytes(b"mine")
    status, _, complaint = drum("export", folder, "--to", to)
    assert (status, path.read_bytes()) == (2, b"mine")
    assert complaint.startswith(f"drumrs: --out is {str(path)!r}, but must be a file that is not there yet; ")
    assert drum("export", folder, "--to", to, "--force")[0] == 0
    # GSD and HDF5 write times or places of memory into their files.
    assert abs(path.stat().st_size - len(before)) < 1000


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([], "--to is missing; give one of vtkhdf, gsd, "),
        (["--to", "stl"], "--to is 'stl', but must be one of vtkhdf, gsd, "),
        (["--out", "run.stl"], "--out is 'run.stl', but must be a name that ends in one of .vtkhdf, .gsd, "),
        (
            ["--to", "csv", "--out", "nowhere/run.csv"],
            "--out is 'nowhere/run.csv', but must be a file that can",
        ),
    ],
)
def test_what_cannot_be_exported_is_one_sentence(words, says, folder, drum):
    status, _, complaint = drum("export", folder, *words)
    assert status == 2
    assert complaint.startswith(f"drumrs: {says}")
    assert len(complaint.splitlines()) == 1


@pytest.mark.parametrize(("to", "package"), [("vtkhdf", "h5py"), ("gsd", "gsd"), ("netcdf", "xarray")])
def test_a_missing_package_is_told_with_how_to_install_it(to, package, result, tmp_path, monkeypatch):
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ConfigError, match=rf"needs the package {package}.*pip install 'drumrs\[export\]'"):
        drumrs.export(result, tmp_path / f"run{FORMATS[to].ending}")
    assert list(tmp_path.iterdir()) == []


def test_a_run_without_frames_is_refused(short, tmp_path):
    result = drumrs.run(short, progress=False)
    empty = drumrs.Result(result.config, result.summary, result.series, Frames.none())
    with pytest.raises(
        ConfigError, match=r"the run has no frames to export; run\.frame_every must be smaller"
    ):
        drumrs.export(empty, tmp_path / "run.xyz")


def test_a_case_of_a_sweep_is_found_by_its_id(short, tmp_path, drum):
    sweep = drumrs.Sweep(short, axes={"run.seed": [1, 2]})
    sweep.run(tmp_path, progress=False)
    case = sweep.cases[1]
    assert drum("export", tmp_path / case.id[:8], "--to", "xyz")[0] == 0
    assert (tmp_path / f"{case.id}.frames.xyz").is_file()


def test_a_drum_that_is_not_round_and_walls_come_along():
    square = np.array([[0.7, 0.7], [0.7, -0.7], [-0.7, -0.7], [-0.7, 0.7]])
    frames = made_up(shell=square, walls=(np.array([[0.0, 0.0], [0.3, 0.3]]),))
    lines = {line.part: line.points for line in frames.outline()}
    assert list(lines) == ["shell", "wall 1"]
    assert (lines["shell"][-1] == lines["shell"][0]).all()
    assert len(lines["wall 1"]) == 2
    assert made_up().outline() == []
