"""Wall profiles folded over lifters: what is hidden is left out, faces are named by the way the drum turns."""

import math

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import measures
from drumrs.errors import ConfigError

RAILS = {"count": 6, "height": 0.03, "width": 0.04, "face_angle": 20.0, "back_angle": 20.0, "phase": 10.0}


def profile_of(**drum) -> pl.DataFrame:
    """Return the bins of a drum, with an angle and the part of each normal along the radius and ahead of it."""
    keys = {"run.duration": 0.01, "run.record": ["wall_profile"], "run.arc_bin": 0.005, **drum}
    result = drumrs.run(drumrs.baseline(fill=0.05).softer(100.0).replace(keys), progress=False)
    x, y, across, up = (pl.col(name) for name in ("x", "y", "normal_x", "normal_y"))
    distance = (x**2 + y**2).sqrt()
    return result.wall_profile.with_columns(
        angle=pl.arctan2(y, x),
        distance=distance,
        inward=-(x * across + y * up) / distance,
        ahead=(x * up - y * across) / distance,
    )


@pytest.fixture(scope="module")
def rails() -> pl.DataFrame:
    return profile_of(**{f"drum.liner.rail.{name}": value for name, value in RAILS.items()})


def test_what_lies_behind_lifters_is_hidden(rails):
    shown = measures.exposed(rails)
    # A rail shows its two faces and its top; under it, neither its base nor the rim.
    radius, side = 0.2375, 0.03 / math.cos(math.radians(20.0))
    lengths = {
        kind: shown.filter(pl.col("part").cast(pl.String).str.starts_with(kind)).select(
            (pl.col("arc_end") - pl.col("arc_start")).sum()
        )
        for kind in ("rail", "rim")
    }
    foot = 2.0 * (0.02 + 0.03 * math.tan(math.radians(20.0)))
    assert lengths["rail"].item() == pytest.approx(6.0 * (0.04 + 2.0 * side), rel=0.06)
    assert lengths["rim"].item() == pytest.approx(math.tau * radius - 6.0 * foot, rel=0.06)


@pytest.mark.parametrize("clockwise", [False, True])
def test_faces_are_named_by_the_way_the_drum_turns(rails, clockwise):
    ahead = -pl.col("ahead") if clockwise else pl.col("ahead")
    part = pl.col("part").cast(pl.String)
    worn = rails.with_columns(
        value=pl.when(part == "rim")
        .then(4.0)
        .when(pl.col("inward") > 0.9)
        .then(2.0)
        .when(ahead > 0.0)
        .then(1.0)
        .otherwise(3.0)
    )
    folded = measures.folded_lifter(worn, "value", clockwise=clockwise)
    assert (folded.kind, folded.count) == ("rail", 6)
    assert folded.profile["face"].unique(maintain_order=True).to_list() == [
        "trailing",
        "top",
        "leading",
        "shell",
    ]
    expected = {"trailing": 3.0, "top": 2.0, "leading": 1.0, "shell": 4.0}
    for face, mean, least, greatest in folded.profile.select("face", "mean", "least", "greatest").iter_rows():
        assert (mean, least, greatest) == (expected[face],) * 3


def test_the_way_goes_over_the_lifter_and_on_to_the_next(rails):
    folded = measures.folded_lifter(rails, "distance").profile
    lifter, shell = (folded.filter((pl.col("face") == "shell") == is_shell) for is_shell in (False, True))
    # Up to the top, and down again; the next begins where the shell ends.
    heights = 0.2375 - lifter["mean"].to_numpy()
    assert heights.max() == pytest.approx(0.03, abs=0.001)
    assert np.all(np.diff(heights[: len(heights) // 2]) > -1e-3)
    assert np.all(np.diff(heights[len(heights) // 2 :]) < 1e-3)
    gap = math.tau * 0.2375 / 6.0 - 2.0 * (0.02 + 0.03 * math.tan(math.radians(20.0)))
    assert float(shell["end"][-1]) == pytest.approx(gap, abs=0.006)
    assert shell["start"].to_list() == pytest.approx([0.0, *shell["end"][:-1].to_list()])


def test_the_shell_is_told_by_its_way_from_the_lifter(rails):
    """A value that grows by 1 rad⁻¹ from one leading foot to the next does so in what is folded."""
    leading = measures.folded_lifter(rails, "angle").profile.filter(face="leading")
    foot = math.atan2(leading["y"][-1], leading["x"][-1])
    pitch = math.tau / 6.0
    worn = rails.with_columns(value=(pl.col("angle") - foot + 0.05 + math.tau) % pitch - 0.05)
    shell = measures.folded_lifter(worn, "value").profile.filter(face="shell")
    middles = 0.5 * (shell["start"] + shell["end"]).to_numpy() / 0.2375
    assert shell["mean"].to_numpy() == pytest.approx(middles, abs=0.02)


def test_bands_reach_from_the_least_lifter_to_the_greatest(rails):
    number = pl.col("part").cast(pl.String).str.extract(r"(\d+)$").cast(pl.Float64).fill_null(0.0)
    lifter = measures.folded_lifter(rails.with_columns(value=number), "value").profile.filter(
        pl.col("face") != "shell"
    )
    assert set(lifter.select("mean", "least", "greatest").rows()) == {(3.5, 1.0, 6.0)}


def test_a_smooth_drum_has_no_lifters():
    with pytest.raises(ConfigError, match="no lifters that are alike"):
        measures.folded_lifter(profile_of(), "distance")
