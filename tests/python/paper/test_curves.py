"""Curves of a table: the right rows, slopes and peaks with honest errors; and the table itself, from a real run."""

import math

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import analysis, measures, paper
from drumrs.paper.claims import power
from drumrs.paper.curves import Curve, Point, Results, peak, slope
from drumrs.paper.drums import BAFFLED
from drumrs.sweep import Case, Sweep
from worlds import DEFAULT, world


def curve(x: np.ndarray, y: np.ndarray, error: float = 0.0) -> Curve:
    """Return a curve of three seeds that agree."""
    spread = np.array([-1.0, 0.0, 1.0]) * error * math.sqrt(3.0)
    return Curve(
        "made up",
        tuple(Point(a, tuple(b + spread), (error * math.sqrt(3.0),) * 3) for a, b in zip(x, y, strict=True)),
    )


FILLS = np.array(DEFAULT.fills)


def test_peak_of_a_parabola_is_its_vertex():
    found = peak(curve(FILLS, 5.0 - 3.0 * (FILLS - 0.437) ** 2))
    assert found.place.mean == pytest.approx(0.437)
    assert found.bend.mean == pytest.approx(-3.0)


def test_peak_has_the_error_that_noise_gives_it():
    random = np.random.default_rng(6)
    places, errors = [], []
    for _ in range(300):
        noisy = 5.0 - 20.0 * (FILLS - 0.44) ** 2 + 0.05 * random.standard_normal(len(FILLS))
        found = peak(curve(FILLS, noisy, error=0.05))
        places.append(found.place.mean)
        errors.append(found.place.error)
    assert np.median(errors) == pytest.approx(np.std(places), rel=0.25)
    assert np.mean(places) == pytest.approx(0.44, abs=0.002)


def test_error_of_a_peak_is_that_of_its_derivatives():
    x = np.array([0.30, 0.36, 0.41, 0.43, 0.52])
    y, error, tiny = 1.0 - 2.0 * (x - 0.39) ** 2, 0.001, 1e-6
    moved = [peak(curve(x, y + tiny * np.eye(5)[k])).place.mean for k in range(5)]
    derivatives = (np.array(moved) - 0.39) / tiny
    assert peak(curve(x, y, error)).place.error == pytest.approx(
        error * np.linalg.norm(derivatives), rel=1e-3
    )


def test_flat_curves_have_no_peak():
    finding = power._peak(curve(FILLS, 5.0 + 0.01 * np.cos(40.0 * FILLS), error=0.2))
    assert finding.outcome == "undecided"
    assert "flat" in finding.sentence
    # A curve so flat that the vertex falls between 40 and 50 % by chance is no peak either.
    level = power._peak(curve(FILLS, 5.0 - 1e-9 * (FILLS - 0.45) ** 2, error=1e-9))
    assert "flat" in level.sentence


def test_peaks_need_neighbors():
    with pytest.raises(paper.MissingError, match="4 points"):
        peak(curve(np.array([0.1, 0.4, 0.7]), np.array([1.0, 2.0, 1.0])))


def test_slope_and_its_error():
    x = np.linspace(0.0, 1.0, 5)
    found = slope(curve(x, 2.0 - 3.0 * x, error=0.1))
    assert found.mean == pytest.approx(-3.0)
    assert found.error == pytest.approx(0.1 / math.sqrt(((x - 0.5) ** 2).sum()))
    with pytest.raises(paper.MissingError):
        slope(curve(x[:1], x[:1]))


@pytest.mark.parametrize(
    ("axis", "options", "x"),
    [
        ("fill", {}, DEFAULT.fills),
        ("fill", {"drum": BAFFLED}, DEFAULT.fills_with_baffles),
        ("size", {}, DEFAULT.sizes),
        ("friction", {"fill": 0.75}, DEFAULT.frictions),
        ("speed", {"drum": BAFFLED}, DEFAULT.speeds),
        ("restitution", {}, DEFAULT.restitutions),
    ],
)
def test_curves_have_their_points_and_no_others(axis, options, x):
    found = Results(world()).curve(axis, "drum_specific_power", **options)
    assert found.x == pytest.approx(x)
    assert all(len(point.values) == 3 for point in found.points)


def test_what_is_not_defined_is_no_point():
    # N/T without friction.
    assert Results(world()).curve("friction", "dissipation_ratio", fill=0.25).x[0] == DEFAULT.frictions[1]


def test_a_curve_is_of_one_stiffness():
    stiffness, fill = "contact.bundle.normal_stiffness", pl.col("load.fill")
    soft = world().with_columns(pl.col(stiffness) / 100.0, pl.col("drum_power") * 0.5)
    few, many = soft.filter(fill < 0.3), soft.with_columns(fill + 0.01)
    stiff = Results(world()).curve("fill", "drum_power")
    # The one of more points, of as many the stiffer.
    for other, factor in ((few, 1.0), (soft, 1.0), (pl.concat([soft, many]), 100.0)):
        found = Results(pl.concat([world(), other])).curve("fill", "drum_power")
        assert found.softer == factor
        assert len(found.points[0].values) == 3
    chosen = Results(pl.concat([world(), few])).curve("fill", "drum_power", softer=100.0)
    assert [one.mean for one in chosen.estimates] == [
        0.5 * one.mean for one in stiff.estimates[: len(chosen)]
    ]


def test_parts_of_a_curve():
    found = curve(FILLS, FILLS)
    assert found.below(0.4).x[-1] == 0.35
    assert found.above(0.4).x[0] == 0.425
    assert found.between(0.4, 0.5).x == pytest.approx([0.4, 0.425, 0.45, 0.475, 0.5])
    assert found.at(0.425).mean == pytest.approx(0.425)
    with pytest.raises(paper.MissingError):
        found.at(0.42)
    with pytest.raises(paper.MissingError):
        found.below(0.1)
    other = curve(np.array([0.1, 0.3, 0.99]), np.array([1.0, 2.0, 3.0]))
    ratios = found.against(other, lambda a, b: b / a)
    assert [(x, one.mean) for x, one in ratios] == [
        (0.1, pytest.approx(10.0)),
        (0.3, pytest.approx(2.0 / 0.3)),
    ]


@pytest.fixture(scope="module")
def measured(tmp_path_factory) -> tuple[pl.DataFrame, Sweep]:
    base = drumrs.baseline(0.1).replace(
        {"run.duration": 0.4, "run.window": [0.2, 0.4], "run.sample_every": 0.005, "run.frame_every": 0.02}
    )
    configs = [base, base.replace({"run.frame_every": 0.4, "run.seed": 2})]
    sweep = Sweep.from_configs(configs)
    sweep.run(tmp_path_factory.mktemp("sweep"), jobs=1, progress=False)
    return paper.measure(sweep), sweep


def test_the_table_has_every_measure(measured):
    table, sweep = measured
    with_frames = table.filter(pl.col("seed") == 1).row(0, named=True)
    case = next(case for case in sweep.cases if case.seed == 1)
    series, frames = sweep.series(case), sweep.frames(case)
    mass = 40 * 1000.0 * math.pi * 0.02375**2 / 4.0
    expected = analysis.statistics(series, (0.2, 0.4), mass)
    assert {name: with_frames[name] for name in expected} == expected
    assert with_frames["drum_specific_power"] == pytest.approx(with_frames["drum_power"] / mass)
    assert with_frames["drum_power_error"] == pytest.approx(mass * with_frames["drum_specific_power_error"])
    assert with_frames["size_ratio"] == pytest.approx(20.0)
    assert with_frames["along_the_rim"] == measures.along_the_rim(frames, (0.2, 0.4)).value
    assert with_frames["carried_round"] == measures.carried_round(frames, (0.2, 0.4)).value
    surface, middle, deep = measures.depth_profile(frames, (0.2, 0.4))
    assert with_frames["surface_speed"] == surface.value
    assert (with_frames["middle_speed"], with_frames["deep_speed"]) == (
        middle and middle.value,
        deep and deep.value,
    )
    # A fifth of a turn is too short for mixing.
    assert with_frames["mixed_in_a_turn"] is None


def test_cases_without_frames_have_no_motion(measured):
    table, _ = measured
    without = table.filter(pl.col("seed") == 2).row(0, named=True)
    assert without["carried_round"] is None
    assert without["deep_speed_error"] is None
    assert without["dissipation_ratio"] is not None


def test_the_table_keeps_the_sweeps_order(measured):
    table, sweep = measured
    assert table["case"].to_list() == sweep.table().collect()["case"].to_list()
    assert Case(sweep.cases[0].config).id in set(table["case"])
