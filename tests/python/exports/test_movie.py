"""Films: as many pictures as they ought to have, of the right moments, and no half of one."""

import re
import subprocess

import imageio_ffmpeg
import numpy as np
import polars as pl
import pytest
from PIL import Image

import drumrs
from drumrs.errors import ConfigError
from drumrs.exports.film import _schedule
from drumrs.figures import Film
from synthetic import made_up, series_of

CHANGES = {"run.duration": 0.4, "run.sample_every": 0.01, "run.frame_every": 0.04}


@pytest.fixture(scope="module")
def result() -> drumrs.Result:
    return drumrs.run(drumrs.baseline(fill=0.1, baffles=True).replace(CHANGES), progress=False)


@pytest.fixture(scope="module")
def folder(result, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    drumrs.save(result, folder, pictures=False)
    return folder


def pictures(path) -> tuple[float, list[np.ndarray]]:
    """Return pictures a second, and the pictures."""
    if path.suffix == ".mp4":
        ffmpeg = imageio_ffmpeg.get_ffmpeg_exe()
        words = ["-f", "image2pipe", "-c:v", "ppm", "-"]
        done = subprocess.run([ffmpeg, "-i", path, *words], capture_output=True, check=True)
        size = re.match(rb"P6\n(\d+) (\d+)\n255\n", done.stdout)
        width, height = int(size[1]), int(size[2])
        raw = np.frombuffer(done.stdout, np.uint8).reshape(-1, len(size[0]) + 3 * width * height)
        rate = float(re.search(rb"([\d.]+) fps", done.stderr)[1])
        return rate, [one[len(size[0]) :].reshape(height, width, 3) for one in raw]
    with Image.open(path) as film:
        film.load()
        rate = 1000.0 / film.info["duration"]
        shown = []
        for index in range(film.n_frames):
            film.seek(index)
            shown.append(np.asarray(film.convert("RGB")))
    return rate, shown


@pytest.mark.parametrize("ending", ["mp4", "gif", "webp"])
def test_a_film_has_a_picture_for_every_frame(ending, folder, drum):
    path = folder / f"drum.{ending}"
    status, printed, complaint = drum("movie", folder, "--out", path, "--width", 301)
    assert (status, printed, complaint) == (0, f"wrote {path}\n", "")
    rate, shown = pictures(path)
    assert rate == pytest.approx(25.0, rel=0.01)
    frames = drumrs.load(folder).frames
    # The first of two like pictures may be all that a gif has.
    assert len(shown) == pytest.approx(len(frames), abs=1)
    film = Film(frames, drumrs.load(folder).series, drumrs.load(folder).config.title, width=301)
    assert shown[-1].shape == (*film.size[::-1], 3)
    assert all(side % 2 == 0 for side in film.size)
    last, first = (film.picture(index)[..., :3].astype(int) for index in (-1, 0))
    # Compression and a palette of few colors change them a little.
    assert np.abs(shown[-1] - last).mean() < 6.0 < np.abs(shown[0] - last).mean()
    assert np.abs(shown[0] - first).mean() < 6.0
    before = path.read_bytes()
    assert drum("movie", folder, "--out", path, "--width", 301)[0] == 2
    assert path.read_bytes() == before


def test_speed_and_window_choose_the_frames():
    times = 0.04 * np.arange(101)
    indices, rate = _schedule(times, 1.0, 25)
    assert (indices.tolist(), rate) == (list(range(101)), pytest.approx(25.0))
    # Slower than the frames allow: as many pictures as there are frames.
    indices, rate = _schedule(times, 0.25, 25)
    assert (indices.tolist(), rate) == (list(range(101)), pytest.approx(6.25))
    indices, rate = _schedule(times, 4.0, 25)
    assert (indices.tolist(), rate) == (list(range(0, 101, 4)), 25.0)
    indices, rate = _schedule(times[:1], 1.0, 25)
    assert (indices.tolist(), rate) == ([0], 25.0)


def test_ctrl_c_leaves_no_half_film(result, tmp_path, monkeypatch):
    real = Film.picture

    def torn(self, index):
        if index == 3:
            raise KeyboardInterrupt
        return real(self, index)

    monkeypatch.setattr(Film, "picture", torn)
    for ending in ("mp4", "gif", "webp"):
        with pytest.raises(KeyboardInterrupt):
            drumrs.movie(result, tmp_path / f"drum.{ending}", width=300, progress=False)
    assert list(tmp_path.iterdir()) == []


def test_what_ffmpeg_cannot_write_is_told(folder, drum, monkeypatch):
    monkeypatch.setattr("drumrs.exports.film._LOSS", "much")
    status, _, complaint = drum("movie", folder, "--out", folder / "other.mp4", "--width", 300)
    assert status == 2
    assert complaint.startswith(
        f"drumrs: --out is '{folder / 'other.mp4'}', but must be a file that can be written: "
    )
    assert "ffmpeg ended with" in complaint
    assert not list(folder.glob("*other*"))


def reds(picture: np.ndarray) -> int:
    """Count pixels of the second color of lines, vermilion."""
    return int((np.abs(picture[..., :3].astype(int) - (213, 94, 0)).max(axis=-1) < 12).sum())


def test_colors_stand_for_species_or_for_the_height_at_the_start():
    frames = made_up(drum_radius=1.0, species=("cork",) * 6 + ("steel",) * 6)
    series = series_of(7.0)
    kinds, speeds = (
        Film(frames, series, color=color, width=400).picture(1) for color in ("species", "speed")
    )
    assert reds(kinds[:400]) > 100 > reds(speeds[:400])
    start = Film(frames, series, color="height", width=400)
    moved = np.abs(start.picture(0).astype(int) - start.picture(2)).sum()
    assert moved > 0
    with pytest.raises(ConfigError, match="color is 'species', but must be one of speed, height; the load"):
        Film(made_up(drum_radius=1.0), series, color="species")


def test_the_drum_turns_and_what_is_to_come_is_pale():
    frames = made_up(count=1, drum_radius=1.0, baffles=(np.array([[1.0, 0.1], [0.5, 0.0], [1.0, -0.1]]),))
    film = Film(frames, series_of(7.0), width=400)
    first, last = film.picture(0)[..., :3].astype(int), film.picture(2)[..., :3].astype(int)
    height = film.size[1]
    # Of a baffle that points to the right at first, and has turned by 0.4 rad at last.
    right = (round(0.42 * height), 370)
    assert first[right].tolist() == pytest.approx([140] * 3, abs=3)
    assert last[right].tolist() == [255, 255, 255]
    trace = slice(round(0.84 * height), round(0.93 * height))
    assert last[trace].sum() < first[trace].sum()
    assert (film.picture(0)[..., :3] == first).all()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"width": 100}, "width is 100, but must be from 240 to 3840"),
        ({"fps": 0}, "fps is 0, but must be from 1 to 60"),
        ({"speed": 0.0}, "speed is 0.0, but must be from 1e-06 to 1e"),
        ({"window": (5.0, 6.0)}, "the run has no frames to show; "),
        ({"color": "mood"}, "color is 'mood', but must be one of speed, height"),
    ],
)
def test_what_makes_no_film_is_one_sentence(options, says, result, tmp_path):
    with pytest.raises(ConfigError) as refused:
        drumrs.movie(result, tmp_path / "drum.gif", progress=False, **options)
    assert str(refused.value).startswith(says)
    with pytest.raises(ConfigError, match=r"must be a name that ends in \.mp4, \.gif or \.webp"):
        drumrs.movie(result, tmp_path / "drum.avi", progress=False)


def test_a_film_too_large_for_memory_is_refused(result, tmp_path, monkeypatch):
    monkeypatch.setattr("drumrs.exports.film._MOST_MEMORY", 2**20)
    with pytest.raises(ConfigError, match="at most 1 MiB of pictures: this one has 3; show a shorter part"):
        drumrs.movie(result, tmp_path / "drum.webp", width=300, progress=False)


def test_a_run_that_replaces_another_takes_its_exports_away(short, tmp_path):
    drumrs.save(drumrs.run(short, progress=False), tmp_path, pictures=False)
    for name in ("frames.mp4", "frames-drum.csv", "frames.xyz.toml", "notes.txt"):
        (tmp_path / name).touch()
    other = drumrs.run(short.replace({"run.seed": 2}), progress=False)
    drumrs.save(other, tmp_path, pictures=False, force=True)
    left = {path.name for path in tmp_path.iterdir() if not path.name.startswith("drumrs-")}
    assert left == {"config.toml", "series.parquet", "frames.parquet", "summary.json", "notes.txt"}
    assert pl.read_parquet(tmp_path / "frames.parquet").height > 0
