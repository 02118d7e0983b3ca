"""Figures from made-up frames and tables: each kind of scene gives a picture, the same bytes each time."""

from dataclasses import replace

import numpy as np
import polars as pl
import pytest

from drumrs import figures
from drumrs.figures import history, shared
from drumrs.frames import Frames
from synthetic import made_up

TRIANGLE = np.array([[0.98, -0.2], [0.8, 0.0], [0.98, 0.2]])


SCENES = {
    "bare drum": made_up(drum_radius=1.0),
    "baffles": made_up(drum_radius=1.0, baffles=(TRIANGLE,)),
    "walls alone": made_up(walls=(np.array([[-1.0, -1.0], [1.0, -1.0]]),)),
    "one bundle, one frame": made_up(count=1, frames=1, drum_radius=1.0),
}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("ending", ["png", "svg"])
def test_snapshot_is_written(scene, ending, tmp_path):
    for name in ("a", "b"):
        figures.write(figures.snapshot(SCENES[scene], label=scene), tmp_path / f"{name}.{ending}")
    first = (tmp_path / f"a.{ending}").read_bytes()
    assert len(first) > 1000
    assert first == (tmp_path / f"b.{ending}").read_bytes()


def test_snapshots_share_one_scale_of_speed():
    frames = SCENES["bare drum"]
    figure = figures.snapshots([figures.View(frames, 0), figures.View(frames, 2)])
    *drums, _bar = figure.axes
    norms = [axes.collections[-2].norm for axes in drums]
    assert norms[0] is norms[1]
    assert norms[0].vmax == max(frames.speeds[0].max(), frames.speeds[2].max())


def test_snapshots_of_several_species_show_them_in_a_second_row():
    frames = replace(SCENES["bare drum"], species=("ore", "ball") * 6)
    figure = figures.snapshots([figures.View(frames, 0), figures.View(frames, 2)])
    discs = [axes.collections[-2] for axes in figure.axes if axes.get_title()]
    assert [len(set(disc.get_array())) for disc in discs[2:]] == [2, 2]
    assert np.array_equal(discs[2].get_array(), [1.0, 0.0] * 6)
    assert [label.get_text() for label in figure.axes[-1].get_yticklabels()] == ["ball", "ore"]
    # One of them, or frames that do not say: one row.
    for views in ([replace(frames, species=("ore",) * 12)], [frames, SCENES["bare drum"]]):
        drums = [
            axes
            for axes in figures.snapshots([figures.View(each) for each in views]).axes
            if axes.get_title()
        ]
        assert len(drums) == len(views)


def test_snapshots_need_a_view():
    with pytest.raises(ValueError, match="views is empty"):
        figures.snapshots([])


def series(rows: int) -> pl.DataFrame:
    time = 0.01 * np.arange(rows)
    names = (
        "drum_work dissipated_normal dissipated_sliding kinetic_translation kinetic_rotation elastic_normal "
        "elastic_tangential energy_residual center_of_mass_x center_of_mass_y"
    )
    return pl.DataFrame({"time": time, **{name: time * (1 + k) for k, name in enumerate(names.split())}})


@pytest.mark.parametrize("rows", [1, 2, 50, 5000])
def test_time_series_is_written(rows, tmp_path):
    figures.write(figures.time_series(series(rows), window=(0.0, 1.0)), tmp_path / "series.png")
    assert (tmp_path / "series.png").stat().st_size > 1000


def test_time_series_marks_where_phases_begin_unless_they_are_too_many():
    plain, table = figures.time_series(series(50)), series(50)
    for count, marks in ((3, 1), (1000, 0)):
        figure = figures.time_series(table, starts=[0.1 * k for k in range(count)])
        assert [len(axes.collections) for axes in figure.axes] == [marks] * 4
        assert [axes.get_ylim() for axes in figure.axes] == [axes.get_ylim() for axes in plain.axes]


def test_time_series_shows_the_terms_that_act():
    plain = series(50)
    terms = ("dissipated_tangential", "dissipated_rolling", "elastic_rolling")
    acting = plain.with_columns(*(plain["time"].alias(name) for name in terms), adhesion=-plain["time"])
    for table, more in ((plain, [0, 0]), (acting, [2, 1])):
        power, energies = figures.time_series(table).axes[:2]
        assert [len(power.lines) - 3, len(energies.lines) - 3] == more


def test_means_of_power_are_exact():
    time = 0.01 * np.arange(301)
    _, power = history.mean_rate(time, 7.0 * time, 1.0)
    assert power == pytest.approx(7.0)


def test_direction_of_rotation():
    frames = SCENES["bare drum"]
    assert [frames.turning(index) for index in range(3)] == [1, 1, 1]
    assert made_up(frames=1).turning(0) == 0


def test_frames_survive_a_file(tmp_path):
    frames = SCENES["baffles"]
    frames.save(tmp_path / "frames.parquet")
    again = Frames.load(tmp_path / "frames.parquet")
    for name in ("times", "drum_angles", "positions", "angles", "velocities", "contacts", "radii"):
        assert np.array_equal(getattr(again, name), getattr(frames, name)), name
    assert again.drum_radius == frames.drum_radius
    assert np.array_equal(again.baffles[0], TRIANGLE)
    units = pl.read_parquet_metadata(tmp_path / "frames.parquet")["units"]
    assert '"velocity_x": "m/s"' in units


def test_names_stand_where_lines_leave_the_picture():
    with figures.drumrs_style():
        figure = figures.new_figure(4.0, 1.0)
        axes = figure.subplots()
        axes.plot([0.0, 1.0, 2.0], [5.0, 5.0, 0.0], label="high")
        axes.plot([0.0, 1.0, 2.0], [1.0, 1.0, 6.0], label="low")
        axes.set_xlim(0.0, 1.0)
        shared.label_lines(axes)
    places = {text.get_text(): text.xy[1] for text in axes.texts}
    # A line of text is a fifth of the height of these axes.
    assert places["high"] > places["low"] + 0.18


def test_names_of_equal_lines_are_kept_apart_in_low_axes():
    with figures.drumrs_style():
        axes = figures.new_figure(4.0, 1.0).subplots()
        for name in ("one", "other"):
            axes.plot([0.0, 1.0], [1.0, 1.0], label=name)
        shared.label_lines(axes)
    one, other = (text.xy[1] for text in axes.texts)
    assert abs(one - other) > 0.18


def test_labels_are_kept_apart():
    places = shared.apart([0.1, 0.1, 0.12, 0.8])
    assert np.diff(places).min() > 0.0749
    assert places[3] == 0.8
    assert np.mean(places[:3]) == pytest.approx(0.32 / 3.0)
