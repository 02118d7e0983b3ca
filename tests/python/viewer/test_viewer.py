"""The player's data and files: what a page holds is what was recorded, and what cannot be shown is refused."""

import base64
import html
import json
import math
import re

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import viewer
from drumrs.frames import Frames
from drumrs.viewer import curves
from drumrs.viewer.recording import pack
from synthetic import series_of

SCRIPT = re.compile(r'<script type="application/json">(.*?)</script>', re.DOTALL)


def frames_of(count: int = 5, frames: int = 4, **scene) -> Frames:
    random = np.random.default_rng(2)
    times = 0.04 * np.arange(frames)
    return Frames(
        times=times,
        drum_angles=3.0 * times,
        positions=random.uniform(-0.2, 0.2, (frames, count, 2)).astype(np.float32),
        angles=random.uniform(-math.pi, math.pi, (frames, count)).astype(np.float32),
        velocities=random.uniform(-2.0, 2.0, (frames, count, 2)).astype(np.float32),
        contacts=np.zeros((frames, count), np.uint16),
        radii=np.linspace(0.01, 0.02, count),
        **scene,
    )


def read_back(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype=kind)


def test_a_page_holds_what_was_recorded():
    frames = frames_of(drum_radius=0.2375)
    data = pack(frames, None, "title", (0.0, 0.1))
    places = read_back(data["positions"], "<u2").reshape(4, 5, 2) / 65535 * 2.0 - 1.0
    assert np.abs(places * data["reach"] - frames.positions).max() < 5e-6
    turned = read_back(data["angles"], "<u1").reshape(4, 5) / 256 * math.tau
    assert np.abs(np.angle(np.exp(1j * (turned - frames.angles)))).max() < 0.0125
    speeds = read_back(data["speeds"], "<u1").reshape(4, 5) / 255 * data["fastest"]
    assert np.abs(speeds - frames.speeds).max() < 2.1e-3 * data["fastest"]
    assert np.array_equal(read_back(data["times"], "<f8"), frames.times)
    assert np.array_equal(read_back(data["drum_angles"], "<f8"), frames.drum_angles)
    assert data["window"] == [0.0, 0.1]
    assert data["drum_radius"] == data["reach"] == 0.2375


@pytest.mark.parametrize(
    ("scene", "reach"),
    [({"walls": (np.array([[-0.9, -0.5], [0.9, -0.5]]),)}, 0.9), ({"drum_radius": 0.1}, 0.19)],
)
def test_the_picture_holds_everything(scene, reach):
    # Bundles outside of a small drum are still seen.
    assert pack(frames_of(**scene), None, "", None)["reach"] == pytest.approx(reach, rel=0.05)


def test_too_many_frames_are_thinned_evenly_and_the_end_stays(monkeypatch):
    monkeypatch.setattr("drumrs.viewer.recording.MOST_PLACES", 10)
    frames = frames_of(count=5, frames=7, drum_radius=0.3)
    data = pack(frames, None, "", None)
    assert read_back(data["times"], "<f8").tolist() == frames.times[[0, 4, 6]].tolist()
    assert len(read_back(data["positions"], "<u2")) == 3 * 5 * 2


def test_a_load_at_rest_has_a_scale():
    frames = frames_of(drum_radius=0.3)
    still = Frames(**{**vars(frames), "velocities": np.zeros_like(frames.velocities)})
    assert pack(still, None, "", None)["speed_scale"] == 1.0


def test_curves_are_exact_means():
    power, energies = curves.panels_of_series(series_of(7.0))
    for line, rate in zip(power.lines, (7.0, 4.2, 2.8), strict=True):
        assert line.values == pytest.approx(rate)
    assert power.limits[0] == 0.0
    assert power.limits[1] > 7.0
    assert [float(line.values.mean()) for line in energies.lines] == pytest.approx([2.0, 2.0, 4.0])
    assert energies.logarithmic
    assert 0.0 < energies.limits[0] < 2.0
    assert energies.limits[1] > 4.0


def test_curves_show_the_terms_that_act():
    series = series_of(7.0)
    idle = series.with_columns(dissipated_rolling=0.0 * series["time"], adhesion=0.0 * series["time"])
    told = [[line.name for line in panel.lines] for panel in curves.panels_of_series(idle)]
    assert told == [
        ["drum", "dissipated normal", "dissipated sliding"],
        ["kinetic translation", "kinetic rotation", "elastic"],
    ]
    acting = series.with_columns(
        dissipated_tangential=series["time"],
        dissipated_rolling=2.0 * series["time"],
        elastic_rolling=pl.lit(3.0),
        adhesion=pl.lit(-1.5),
    )
    power, energies = curves.panels_of_series(acting)
    assert [line.name for line in power.lines[3:]] == ["dissipated tangential", "dissipated rolling"]
    assert power.lines[4].values == pytest.approx(2.0)
    assert [line.name for line in energies.lines[2:]] == ["elastic", "adhesion (−)"]
    assert [float(line.values.mean()) for line in energies.lines[2:]] == pytest.approx([7.0, 1.5])


def test_a_few_samples_are_no_curve():
    assert curves.panels_of_series(series_of(1.0, rows=2)) == []
    assert curves.panels_of_frames(frames_of(frames=1)) == []
    titles = [panel.title for panel in curves.panels_of_frames(frames_of())]
    assert titles == ["Speed of the bundles", "Mean position of the bundles"]


def test_a_title_cannot_end_its_script():
    title = "</script><b>50 % & more"
    page = viewer.Player(frames_of(), title=title).page()
    assert json.loads(SCRIPT.search(page).group(1))["title"] == title
    assert "</script><b>" not in page
    assert f"<title>{html.escape(title)}</title>" in page


def test_a_page_asks_for_nothing():
    page = viewer.Player(frames_of(drum_radius=0.2)).page()
    assert not re.findall(r"(?:src|href)\s*=|@import|url\(|fetch\(|https?:", page)


def test_a_notebook_shows_the_page_in_a_frame_of_its_own():
    player = viewer.Player(frames_of())
    shown = player._repr_html_()
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', shown).group(1)) == player.page(autoplay=False)
    assert 'sandbox="allow-scripts"' in shown


def test_nothing_to_show_is_refused():
    with pytest.raises(drumrs.ConfigError, match="0 frames of 5 bundles, but must have at least one"):
        viewer.Player(frames_of(frames=0))


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Return the folder of a finished run."""
    folder = tmp_path_factory.mktemp("view") / "run"
    config = drumrs.baseline(fill=0.05, baffles=True).replace({"run.duration": 0.2})
    drumrs.save(drumrs.run(config, progress=False), folder, pictures=False)
    return folder


def test_a_result_shows_itself(finished):
    result = drumrs.load(finished)
    data = json.loads(SCRIPT.search(drumrs.player(result).page()).group(1))
    assert data["title"] == "20 bundles (5 % fill), 3 baffles, 54 rpm, seed 1"
    assert data["window"] == pytest.approx([0.2 * 2 / 3, 0.2])
    assert [panel["unit"] for panel in data["panels"]] == ["W/m", "J/m"]
    assert len(data["baffles"]) == 3
    assert data["facts"] == result.config.facts
    assert "Froude number 0.774" in data["facts"]


def test_titles_tell_what_was_simulated(tmp_path):
    state = drumrs.State([[0.0, 0.0], [0.1, 0.0], [0.0, -0.1]], radii=[0.01, 0.02, 0.02])
    config = drumrs.baseline().replace({"run.duration": 0.02})
    simulation = drumrs.Simulation(config, state=state)
    simulation.run()
    result = simulation.result()
    # 4 (0.01² + 0.02² + 0.02²)/0.475², where the configuration had 100 bundles and 25 %.
    title = "3 bundles (1.6 % fill), no baffles, 54 rpm, seed 1"
    assert drumrs.player(result).title == title
    assert f"load {simulation.masses.sum():.3g} kg per m of depth" in drumrs.player(result).facts
    drumrs.save(result, tmp_path)
    assert result.config.bundle_count == drumrs.Config.read(tmp_path / "config.toml").bundle_count == 3
    assert drumrs.load(tmp_path).summary.bundle_count == 3
    assert viewer.read(tmp_path).title == title
    assert f"<title>{title}</title>" in (tmp_path / "player.html").read_text(encoding="utf-8")


def test_view_writes_the_page_and_opens_it(finished, drum, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", lambda address: not opened.append(address))
    status, out, _ = drum("view", finished)
    page = finished / "player.html"
    assert (status, out) == (0, f"wrote {page}\n")
    assert opened == [page.as_uri()]
    assert "<title>20 bundles" in page.read_text(encoding="utf-8")
    drum("view", finished, "--no-open")
    other = finished / "other.html"
    drum("view", finished / "frames.parquet", "--out", other)
    assert opened == [page.as_uri()]
    assert other.read_bytes() == page.read_bytes()


def test_view_reads_a_case_of_a_sweep(finished, drum, tmp_path):
    for name, case in (("config.toml", "1a2b.toml"), ("frames.parquet", "1a2b.frames.parquet")):
        (tmp_path / case).write_bytes((finished / name).read_bytes())
    assert drum("view", tmp_path / "1a2b.frames.parquet", "--no-open")[0] == 0
    data = json.loads(SCRIPT.search((tmp_path / "1a2b.player.html").read_text(encoding="utf-8")).group(1))
    assert data["title"].startswith("20 bundles")
    assert data["panels"][0]["title"] == "Speed of the bundles"


@pytest.fixture(scope="module")
def sweep(finished, tmp_path_factory):
    """Return a folder with a sweep's folder of three cases that differ in fill and seed."""
    folder = tmp_path_factory.mktemp("cases") / "study"
    folder.mkdir()
    for case, fill, seed in (("1a2b3c4d5e", 0.1, 0), ("1a9f3c4d5e", 0.1, 1), ("77003c4d5e", 0.2, 0)):
        config = drumrs.baseline(fill).replace({"run.seed": seed})
        (folder / f"{case}.toml").write_text(config.to_toml(), encoding="utf-8")
        (folder / f"{case}.frames.parquet").write_bytes((finished / "frames.parquet").read_bytes())
    return folder


def test_view_lists_the_cases_of_a_sweep(sweep, drum):
    status, out, err = drum("view", sweep, "--no-open")
    assert (status, out) == (2, "")
    assert err.splitlines() == [
        f"drumrs: {str(sweep)!r} has 3 runs to view; choose one:",
        f"  drumrs view {sweep}/1a2b3c4d  load.fill=0.1, run.seed=0",
        f"  drumrs view {sweep}/1a9f3c4d  load.fill=0.1, run.seed=1",
        f"  drumrs view {sweep}/77003c4d  load.fill=0.2, run.seed=0",
    ]
    # The folder above has nothing else.
    assert drum("view", sweep.parent)[2].splitlines()[1:] == err.splitlines()[1:]


@pytest.mark.parametrize(
    ("words", "case"),
    [
        (["77"], "77003c4d5e"),
        (["1a2b3c4d"], "1a2b3c4d5e"),
        (["", "--case", "load.fill=.2"], "77003c4d5e"),
        (["", "--case", "load.fill=0.1", "--case", "run.seed=1"], "1a9f3c4d5e"),
        (["", "--case", "1a", "--case", "run.seed=1"], "1a9f3c4d5e"),
    ],
)
def test_view_takes_a_case_by_id_or_values(words, case, sweep, drum):
    start, *options = words
    page = sweep / f"{case}.player.html"
    assert drum("view", sweep / start, *options, "--no-open") == (0, f"wrote {page}\n", "")


def test_view_says_which_cases_are_meant(sweep, drum):
    status, _, err = drum("view", sweep / "1a", "--no-open")
    assert status == 2
    assert [line.split()[2][-8:] for line in err.splitlines()[1:]] == ["1a2b3c4d", "1a9f3c4d"]
    status, _, err = drum("view", sweep, "--case", "load.fill=0.3")
    assert (status, "has nothing to view with load.fill=0.3" in err) == (2, True)


def test_view_finds_runs_in_folders(finished, drum, tmp_path):
    (tmp_path / "one").mkdir()
    for name in ("frames.parquet", "config.toml"):
        (tmp_path / "one" / name).write_bytes((finished / name).read_bytes())
    # The only one is meant.
    assert drum("view", tmp_path, "--no-open")[1] == f"wrote {tmp_path / 'one' / 'player.html'}\n"
    (tmp_path / "two").mkdir()
    (tmp_path / "two" / "frames.parquet").write_bytes((finished / "frames.parquet").read_bytes())
    assert drum("view", tmp_path)[2].count(f"  drumrs view {tmp_path}/") == 2


@pytest.mark.parametrize(
    ("there", "says"),
    [
        ("records/", "its run has not come to an end; go on with: drumrs run --resume"),
        (
            "3f2a.series.parquet",
            "its cases keep no frames, as run.frame_every is not smaller than run.duration",
        ),
        ("notes.txt", "there is no frames.parquet in it, nor in its folders; it holds notes.txt"),
    ],
)
def test_view_says_why_there_is_nothing(there, says, drum, tmp_path):
    place = tmp_path / there
    place.mkdir() if there.endswith("/") else place.touch()
    status, _, err = drum("view", tmp_path)
    assert status == 2
    assert f"{str(tmp_path)!r} has nothing to view: {says}" in err


def test_view_without_a_browser_says_where_the_page_is(finished, drum, monkeypatch):
    monkeypatch.setattr("webbrowser.open", lambda _: False)
    status, _, err = drum("view", finished)
    assert status == 0
    assert f"found no browser here; open {(finished / 'player.html').as_uri()} in one" in err


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("missing.parquet", None, "is not there, but must be the frames.parquet of a run, its folder, or"),
        ("text.parquet", b"no parquet at all", "holds no frames, but must be a file that drumrs wrote"),
        ("cut.parquet", "frames.parquet", "holds no frames, but must be a file that drumrs wrote"),
        ("foreign.parquet", "series.parquet", "holds no frames, but must be a file that drumrs wrote"),
    ],
)
def test_view_refuses_what_holds_no_frames(name, content, says, finished, drum, tmp_path):
    if isinstance(content, str):
        whole = (finished / content).read_bytes()
        content = whole[: len(whole) // 2] if name.startswith("cut") else whole
    if content is not None:
        (tmp_path / name).write_bytes(content)
    status, out, err = drum("view", tmp_path / name)
    assert (status, out) == (2, "")
    assert says in err
    assert repr(str(tmp_path / name)) in err
    assert not list(tmp_path.glob("*.html"))


def test_view_refuses_a_damaged_series(finished, drum, tmp_path):
    (tmp_path / "frames.parquet").write_bytes((finished / "frames.parquet").read_bytes())
    (tmp_path / "series.parquet").write_bytes(b"PAR1")
    status, _, err = drum("view", tmp_path)
    assert status == 2
    assert "series.parquet' is damaged, but must be the series that drumrs wrote" in err


def test_view_overwrites_pages_of_its_own_only(finished, drum, tmp_path):
    page = tmp_path / "page.html"
    assert [drum("view", finished, "--out", page)[0] for _ in range(2)] == [0, 0]
    page.write_text("<h1>Notes</h1>")
    status, _, err = drum("view", finished, "--out", page)
    assert status == 2
    assert f"--out is {str(page)!r}, but must be a new file or a page of drumrs" in err
    assert page.read_text() == "<h1>Notes</h1>"


def test_view_refuses_a_page_that_cannot_be_written(finished, drum, tmp_path):
    status, _, err = drum("view", finished, "--out", tmp_path / "none" / "page.html")
    assert status == 2
    assert "but must be a file that can be written (--out): No such file or directory" in err
