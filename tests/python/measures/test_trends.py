"""What designers know of their machines holds in runs of the templates, with softer springs."""

from importlib.resources import files

import polars as pl
import pytest

import drumrs
from drumrs import measures


def template(name: str) -> drumrs.Config:
    return drumrs.Config.read(str(files("drumrs") / "templates" / name / "case.toml"))


def test_a_dryer_s_curtain_is_widest_at_50_rpm():
    """Lee, Yun and Park (2022), doi 10.1007/s12221-022-4802-z: dried fastest at 50 rpm, slower at 35, slowest at 65.

    What goes along with it is the curtain: at 65 rpm the load rides along the wall, open inwards, but out of the way of
    the air.
    """
    window = (1.5, 4.5)
    changes = {"run.duration": window[1], "run.window": list(window), "run.frame_every": 0.04}
    config = template("dryer").softer(300.0).replace(changes)
    curtain, riding = [], []
    for rpm in (35.0, 50.0, 65.0):
        frames = drumrs.run(config.replace({"rotation.rpm": rpm}), progress=False).frames
        curtain.append(measures.washing(frames, window)["curtain"].value)
        riding.append(measures.along_the_rim(frames, window).value)
    slow, best, fast = curtain
    assert best > slow + 0.05
    assert slow > fast + 0.05
    assert riding == sorted(riding)


@pytest.mark.parametrize("law", ["archard", "finnie"])
def test_a_mill_s_liner_wears_most_on_the_leading_face(law):
    changes = {"run.duration": 4.0, "run.window": [2.0, 4.0], "run.record": ["wall_profile"]}
    result = drumrs.run(template("ball-mill").softer(100.0).replace(changes), progress=False)
    # How far the normal points the way that the drum turns, counter-clockwise.
    ahead = (pl.col("x") * pl.col("normal_y") - pl.col("y") * pl.col("normal_x")) / (
        pl.col("x") ** 2 + pl.col("y") ** 2
    ).sqrt()
    worn = measures.wear(result.wall_profile, law, turns=1.0).with_columns(
        face=pl.when(pl.col("part") == "rim")
        .then(pl.lit("plate"))
        .when(ahead.abs() < 0.5)
        .then(pl.lit("top"))
        .otherwise(pl.when(ahead > 0.0).then(pl.lit("leading")).otherwise(pl.lit("trailing"))),
        length=pl.col("arc_end") - pl.col("arc_start"),
    )
    depth = dict(worn.group_by("face").agg(pl.col("wear_volume").sum() / pl.col("length").sum()).iter_rows())
    assert sorted(depth, key=lambda face: -depth[face])[:2] == ["leading", "top"]
    assert depth["leading"] > 1.5 * depth["top"]
