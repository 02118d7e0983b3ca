"""The paper's figures from made-up results: each draws, shows what it should, and gives the same bytes again."""

import math
from types import SimpleNamespace

import numpy as np
import polars as pl
import pytest
from matplotlib.collections import FillBetweenPolyCollection

import drumrs
from drumrs import figures, paper
from drumrs.paper import plots
from drumrs.paper.cases import HALF_FULL
from drumrs.paper.curves import Results
from drumrs.paper.figures import points
from drumrs.paper.thumbnails import thumbnail
from drumrs.sweep import Case
from synthetic import made_up
from worlds import world

FROM_TABLE = ["F4", "F5", "F6", "F7", "F8", "F9", "speed", "restitution"]
FROM_RUNS = ["F2", "F3", "drift"]
FROM_LONG_RUNS = ["states"]
ALL = [*FROM_TABLE, *FROM_RUNS, *FROM_LONG_RUNS]


class Runs:
    """Stands for a sweep: three seeds at three fills in both drums."""

    def __init__(self) -> None:
        configs = [
            drumrs.baseline(fill, baffles=baffles).replace({"run.seed": seed})
            for fill in (0.25, 0.5, 0.75)
            for baffles in (False, True)
            for seed in (3, 1, 2)
        ]
        self.cases = tuple(Case(config) for config in configs)
        self.asked: list[Case] = []

    def frames(self, case: Case, folder: str | None = None) -> drumrs.Frames:
        assert folder == "somewhere"
        self.asked.append(case)
        return made_up(drum_radius=1.0)

    def series(self, case: Case, folder: str | None = None) -> pl.DataFrame:
        assert folder == "somewhere"
        self.asked.append(case)
        time = np.linspace(0.0, 30.0, 1501)
        names = ("drum_work", "dissipated_normal", "dissipated_sliding")
        return pl.DataFrame({"time": time, **{name: time * (2.0 + k) for k, name in enumerate(names)}})


class LongRuns(Runs):
    """Stands for a sweep of long runs about half full, whose load turns the faster the fuller the drum."""

    def __init__(self) -> None:
        run = {"run.duration": 120.0, "run.sample_every": 0.02}
        configs = [
            drumrs.baseline(fill).replace({**run, "run.seed": seed}) for fill in HALF_FULL for seed in (1, 2)
        ]
        self.cases = tuple(Case(config) for config in configs)

    def series(self, case: Case, folder: str | None = None) -> pl.DataFrame:
        assert folder == "somewhere"
        time = 0.02 * np.arange(6001)
        names = ("drum_work", "gross_work_normal", "gross_work_tangential")
        momentum = np.full(len(time), 100.0 * case.config.load.fill)
        return pl.DataFrame({"time": time, "angular_momentum": momentum, **dict.fromkeys(names, time)})


@pytest.fixture(scope="module")
def table() -> pl.DataFrame:
    return world()


def study_data(runs: Runs | None = None) -> paper.StudyData:
    runs = runs or Runs()
    return paper.StudyData(pl.DataFrame({"case": [case.id for case in runs.cases]}), runs, "somewhere")


def drawn(number: str, table: pl.DataFrame) -> object:
    data = (
        paper.StudyData(table, SimpleNamespace(cases=()))
        if number in FROM_TABLE
        else study_data(LongRuns() if number in FROM_LONG_RUNS else None)
    )
    return paper.FIGURES[number].draw(data)


def test_every_figure_is_there():
    assert set(paper.FIGURES) == set(ALL)
    assert all(one.number == key and one.title and one.caption for key, one in paper.FIGURES.items())


@pytest.mark.parametrize("ending", ["png", "svg"])
@pytest.mark.parametrize("number", ALL)
def test_every_figure_is_written_alike(number, ending, table, tmp_path):
    for name in ("a", "b"):
        figures.write(drawn(number, table), tmp_path / f"{name}.{ending}")
    first = (tmp_path / f"a.{ending}").read_bytes()
    assert len(first) > 3000
    assert first == (tmp_path / f"b.{ending}").read_bytes()


@pytest.mark.parametrize("number", FROM_TABLE)
def test_axes_have_names_and_units(number, table):
    axes = drawn(number, table).axes[0]
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    fills = number in {"F4", "F5", "F6"}
    assert ("[%]" in axes.get_xlabel()) == fills
    assert axes.get_xlim()[1] > 70.0 if fills else True
    assert axes.get_ylim()[0] <= 0.0
    named = {text.get_text() for text in axes.texts}
    assert named >= (
        {"25 % fill", "50 % fill", "75 % fill"}
        if number in {"F8", "F9"}
        else {"without baffles", "with baffles"}
    )


def test_bars_are_the_intervals(table):
    axes = drawn("F5", table).axes[0]
    curve = Results(table).curve("fill", "drum_specific_power")
    bars = axes.collections[0].get_segments()
    assert len(bars) == len(curve)
    for bar, point in zip(bars, curve.points, strict=True):
        interval = point.estimate.interval()
        assert bar[:, 1] == pytest.approx([interval.low, interval.high])
        assert bar[0, 0] == pytest.approx(100.0 * point.x)


def marked(axes, face: str) -> int:
    lines = [
        line for line in axes.get_lines() if line.get_marker() in "os^" and line.get_markerfacecolor() == face
    ]
    return sum(len(line.get_xdata()) for line in lines)


def test_drifting_points_are_open_and_seeds_that_disagree_are_shown(table):
    assert marked(drawn("F6", table).axes[0], "white") == 0
    at_half = (pl.col("load.fill") == 0.5) & (pl.col("contact.bundle.friction") == 0.5)
    moved = table.with_columns(
        drifting=at_half & (pl.col("seed") == 1),
        gross_work_ratio=pl.when(at_half & (pl.col("seed") == 1))
        .then(1.2)
        .otherwise(pl.col("gross_work_ratio")),
    )
    axes = drawn("F6", moved).axes[0]
    assert marked(axes, "white") == 2
    dots = [line for line in axes.get_lines() if line.get_marker() == "."]
    assert sorted(min(line.get_ydata()) for line in dots) == [1.2, 1.2]


def test_unknown_errors_have_no_bar():
    lone = world(seeds=(2,)).with_columns(drum_specific_power_error=pl.lit(None, dtype=pl.Float64))
    frame = points([Results(lone).curve("fill", "drum_specific_power")])
    assert set(frame["half_width"]) == {math.inf}
    bars = plots.specific_power_against_fill(frame).axes[0].collections[0].get_segments()
    assert all(bar[0, 1] == bar[1, 1] for bar in bars)


@pytest.mark.parametrize("number", ["F6", "F9"])
def test_three_readings_of_the_ratio_are_shown(number, table):
    axes = drawn(number, table).axes[0]
    marks = {
        line.get_marker(): np.asarray(line.get_ydata())
        for line in axes.get_lines()
        if line.get_marker() in "x+"
    }
    assert {mark: len(y) for mark, y in marks.items()} == dict.fromkeys("x+", len(marks["x"]))
    assert (marks["+"] >= marks["x"]).all()
    assert axes.get_title(loc="left") == "×: by dissipation; +: by net work"
    assert axes.get_ylabel() == "gross work ratio N/T"


def test_snapshots_are_of_the_first_seed_in_the_papers_order():
    given = study_data()
    figure = paper.FIGURES["F3"].draw(given)
    chosen = [case.config for case in given.sweep.asked]
    assert [config.load.fill for config in chosen] == [0.25, 0.5, 0.75]
    assert {(config.run.seed, config.drum.baffles.count) for config in chosen} == {(1, 3)}
    titles = [axes.get_title() for axes in figure.axes[:3]]
    assert [title[:3] for title in titles] == ["(a)", "(b)", "(c)"]


def test_drift_shows_every_seed():
    given = study_data()
    figure = paper.FIGURES["drift"].draw(given)
    assert [case.config.run.seed for case in given.sweep.asked] == [1, 2, 3] * 2
    power, _, ratio, _ = figure.axes
    assert [len(axes.get_lines()) for axes in figure.axes] == [3, 3, 3, 3]
    mass = 200 * 1000.0 * math.pi * 0.02375**2 / 4.0
    assert power.get_lines()[0].get_ydata() == pytest.approx(2.0 / mass)
    assert ratio.get_lines()[0].get_ydata() == pytest.approx(3.0 / 4.0)


@pytest.mark.parametrize("number", ALL)
def test_figures_without_cases_say_so(number, table):
    empty = table.clear().with_columns(case=pl.lit(""))
    with pytest.raises(paper.MissingError):
        paper.FIGURES[number].draw(paper.StudyData(empty, SimpleNamespace(cases=())))


@pytest.mark.parametrize("number", FROM_TABLE)
def test_figures_draw_what_there_is(number, table, tmp_path):
    some = table.filter(pl.col("drum.baffles.count") == 0, pl.col("load.fill") != 0.75)
    figures.write(drawn(number, some), tmp_path / "some.png")


def test_curves_need_points():
    with pytest.raises(ValueError, match="points is empty"):
        figures.curves(pl.DataFrame({"label": [], "x": []}), figures.Labels("x", "y"))


def bands(claim: str, table: pl.DataFrame) -> list[np.ndarray]:
    """Return the corners of the bands in the picture of a claim."""
    verdict = next(one for one in paper.judge(table) if one.claim == claim)
    axes = thumbnail(verdict, Results(table)).axes[0]
    return [
        path.vertices
        for one in axes.collections
        if isinstance(one, FillBetweenPolyCollection)
        for path in one.get_paths()
    ]


def test_the_picture_of_a_claim_has_the_bands_of_its_parts(table):
    (bare, baffled) = bands("C1", table)
    assert {tuple(sorted(set(one[:, 0]))) for one in (bare, baffled)} == {(40.0, 50.0)}
    highest = 2.1  # of N/T in this world
    for one in bands("C4", table):
        assert (one[:, 1].min(), one[:, 1].max()) == pytest.approx(
            (1.0 - 0.1 * highest, 2.0 + 0.1 * highest), rel=2e-3
        )
    (about_one,) = bands("C6", table)
    assert (about_one[:, 0].min(), about_one[:, 0].max()) == (10.0, 35.0)
    with pytest.raises(paper.MissingError):
        bands("C4", table.clear())


def test_the_picture_of_a_claim_has_its_curves(table):
    for verdict in paper.judge(table):
        axes = thumbnail(verdict, Results(table)).axes[0]
        named = [text.get_text() for text in axes.get_legend().get_texts()]
        by_friction = verdict.claim in {"C8", "C9", "C10"}
        assert named == (
            ["25 % fill", "50 % fill", "75 % fill"] if by_friction else ["without baffles", "with baffles"]
        )
