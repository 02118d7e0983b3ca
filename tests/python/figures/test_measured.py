"""Figures of measures: they show the values that they were given, under names with units."""

import numpy as np
import polars as pl
import pytest
from matplotlib.quiver import Quiver

from drumrs import figures, measures


def turning(speed: float = 2.0) -> measures.Fields:
    """Return fields of a load that fills the lower half of a drum of radius 1 and turns with it."""
    line = np.linspace(-1.0, 1.0, 81)
    x, y = np.meshgrid(line, line, indexing="ij")
    full = np.where((y < 0.0) & (np.hypot(x, y) < 1.0), 0.8, 0.0)
    velocity = speed * np.stack([-y, x], axis=-1)
    return measures.Fields(line, line, 0.05, 1000.0 * full, full, velocity, np.zeros((81, 81, 2, 2)))


def test_flow_has_arrows_where_the_load_is():
    figure = figures.flow(turning(), drum_radius=1.0)
    axes, bar = figure.axes
    (arrows,) = [one for one in axes.collections if isinstance(one, Quiver)]
    assert len(arrows.U) > 50
    np.testing.assert_allclose(np.column_stack([arrows.U, arrows.V]), 2.0 * arrows.XY @ [[0, 1], [-1, 0]])
    assert (arrows.XY[:, 1] < 0.0).all()
    fastest = float(np.hypot(arrows.U, arrows.V).max())
    assert axes.get_title(loc="left") == f"longest arrow: {fastest:.2g} m/s"
    # The swiftest arrow goes a little further than the next one's foot.
    apart = np.diff(np.unique(arrows.XY[:, 0])).min()
    assert 1.0 < fastest / arrows.scale / apart < 2.0
    assert (axes.get_xlabel(), axes.get_ylabel(), bar.get_ylabel()) == ("x [m]", "y [m]", "solid fraction")
    assert bar.get_ylim() == (0.0, 1.0)


def profile(*values: tuple[str, list[float]]) -> pl.DataFrame:
    """Return a wall profile with bins of 0.1 m on a circle of 1 m; each part begins at the angle 0."""
    rows = [
        {"part": part, "arc_start": 0.1 * k, "arc_end": 0.1 * (k + 1), "angle": 0.1 * k, "wear": one}
        for part, own in values
        for k, one in enumerate(own)
    ]
    x, y = pl.col("angle").cos(), pl.col("angle").sin()
    return pl.DataFrame(rows).with_columns(x=x, y=y, normal_x=-x, normal_y=-y)


def test_wall_profile_colors_the_outline_and_unrolls_lifters_that_are_alike():
    table = profile(("rim", [1.0] * 62), ("rail 1", [2.0, 4.0]), ("rail 2", [4.0, 8.0]))
    outline, along, shell, bar = figures.wall_profile(table, "wear", "wear [m]").axes
    (bins,) = outline.collections
    np.testing.assert_array_equal(bins.get_array(), table["wear"])
    np.testing.assert_allclose(bins.get_segments()[0], [[1.0, 0.05], [1.0, -0.05]])
    mean, band = [one.get_data() for one in along.patches]
    np.testing.assert_allclose(mean.values, [3.0, 6.0])
    np.testing.assert_allclose(mean.edges, [0.0, 0.1, 0.2])
    np.testing.assert_allclose([band.baseline, band.values], [[2.0, 4.0], [4.0, 8.0]])
    assert (along.get_xlabel(), along.get_ylabel()) == ("way over a rail [m]", "wear [m]")
    assert set(shell.patches[0].get_data().values) == {1.0}
    assert shell.get_xlabel() == "way along the shell [m]"
    assert along.get_ylim() == shell.get_ylim()
    assert [text.get_text() for axes in (along, shell) for text in axes.texts] == ["top", "shell"]
    (large,) = outline.child_axes
    assert large.get_title(loc="left") == "mean of 2 rails"
    np.testing.assert_allclose(large.collections[0].get_array()[:2], [3.0, 6.0])
    # It stands at the bottom, with its tops up.
    assert np.asarray(large.collections[0].get_segments())[:2, :, 1].mean() == pytest.approx(-1.0, abs=0.01)
    assert bar.get_ylim()[0] == 0.0


def test_wall_profile_shows_the_rim_where_there_is_nothing_else():
    along = figures.wall_profile(profile(("rim", [1.0, 3.0])), "wear", "wear [m]").axes[1]
    assert along.get_xlabel() == "way along the rim [m]"
    np.testing.assert_allclose(along.patches[0].get_data().values, [1.0, 3.0])


def test_parts_of_one_kind_that_differ_in_length_are_not_averaged():
    table = profile(("plate 1", [1.0, 3.0]), ("plate 2", [5.0]))
    legend = figures.wall_profile(table, "wear", "wear [m]").axes[1].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["plate of 2 bins", "plate of 1 bins"]


def test_spectrum_shows_rates_and_shares():
    contacts = pl.DataFrame({"particle": [0, 1, 2], "dissipated_normal": [0.02, 0.5, 0.5]})
    spectrum = measures.collision_spectrum(contacts, mass=2.0, duration=1.0, kind="normal", per_decade=1)
    empty = spectrum.clear()
    rates, shares = figures.collision_spectrum({"normal": spectrum, "none": empty}, unit="J/kg").axes
    (steps,) = rates.patches
    np.testing.assert_allclose(steps.get_data().values, [0.5, 1.0])
    np.testing.assert_allclose(steps.get_data().edges, [0.01, 0.1, 1.0])
    (line,) = shares.get_lines()
    np.testing.assert_allclose(line.get_xydata(), [[0.01, 100.0], [0.1, 100.0 / 1.02]])
    assert {rates.get_xlabel(), shares.get_xlabel()} == {"energy of a collision [J/kg]"}
    assert rates.get_xscale() == rates.get_yscale() == shares.get_xscale() == "log"


def test_mixing_curves_have_their_names_and_fits():
    turns = np.linspace(0.0, 5.0, 21)
    index = 1.0 - np.exp(-turns)
    curves = {"side": (turns, np.array([index - 0.1, index, index + 0.1])), "layer": (turns, index[None])}
    fit = measures.mixing_rate(turns, index)
    (axes,) = figures.mixing_curve(curves, {"side": fit}).axes
    chance, side, fitted, layer = axes.get_lines()
    assert set(chance.get_ydata()) == {1.0}
    np.testing.assert_array_equal(side.get_ydata(), index)
    np.testing.assert_array_equal(fitted.get_ydata(), fit.at(turns))
    assert fitted.get_color() == side.get_color() != layer.get_color()
    assert [text.get_text() for text in axes.texts] == ["side", "layer"]


def test_landing_rose_stacks_shares_of_the_energy():
    flights = pl.DataFrame(
        {
            "particle": [0, 1, 1, 0],
            "end_x": [-1.0, -1.0, 0.0, 1.0],
            "end_y": [-0.1, -0.1, -1.0, 0.0],
            "speed": [1.0, 1.0, 2.0, 9.0],
            "onto": ["drum", "load", "load", "load"],
            "is_fall": [True, True, True, False],
        }
    )
    (axes,) = figures.landing_rose(flights, masses=np.array([2.0, 1.0])).axes
    drum, load = axes.containers
    # 1, 0.5 and 2 J: the one that does not fall is left out.
    assert sum(bar.get_height() for bar in drum) == pytest.approx(100.0 / 3.5)
    stacked = next(bar for bar in load if bar.get_y() > 0.0)
    assert stacked.get_y() == pytest.approx(100.0 / 3.5)
    assert np.degrees(stacked.get_x()) == pytest.approx(180.0)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "on the drum, 29 %",
        "on the load, 71 %",
    ]


def test_unbalance_is_a_share_of_the_frames():
    (axes,) = figures.unbalance_histogram([0.1, 0.1, 0.2, 0.4], limit=0.5).axes
    assert sum(bar.get_height() for bar in axes.patches) == pytest.approx(100.0)
    assert [line.get_xdata()[0] for line in axes.get_lines()] == pytest.approx([0.15, 0.37, 0.5])
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "unbalance |U| [kg m per m of depth]",
        "share of the frames [%]",
    )


def test_regime_map_has_a_mark_for_each_regime():
    cases = {"critical_share": [0.1, 0.2, 1.2, 0.5], "load.fill": [0.3, 0.4, 0.3, 0.2]}
    table = pl.DataFrame({**cases, "regime": ["rolling", "rolling", "centrifuging", "another"]})
    (axes,) = figures.regime_map(table).axes
    lines = {line.get_label(): line for line in axes.get_lines()}
    assert list(lines) == ["rolling", "centrifuging", "another"]
    np.testing.assert_allclose(lines["rolling"].get_xydata(), [[0.1, 0.3], [0.2, 0.4]])
    assert len({line.get_marker() for line in lines.values()}) == 3
    assert len({line.get_color() for line in lines.values()}) == 3


@pytest.mark.parametrize(
    "draw",
    [
        lambda: figures.wall_profile(profile(("rim", [1.0])).clear(), "wear", "wear"),
        lambda: figures.collision_spectrum({}),
        lambda: figures.mixing_curve({}),
        lambda: figures.landing_rose(pl.DataFrame({"is_fall": [False]}), np.ones(1)),
        lambda: figures.unbalance_histogram([]),
        lambda: figures.regime_map(pl.DataFrame({"regime": []})),
    ],
)
def test_nothing_to_draw_is_an_error(draw):
    with pytest.raises(ValueError, match=r"must hold (at least one|one at least)"):
        draw()
