"""Drawings: what readers find in files, how loose lines are joined, and what is refused, in which words."""

import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from drumrs.drawing import Frame, read
from drumrs.drawing.joined import joined
from drumrs.drawing.line import Line
from drumrs.errors import ConfigError

ACCURACY = 2e-4
RAIL = [(0.22, -0.01), (0.25, -0.02), (0.25, 0.02), (0.22, 0.01)]


def frame(**changes) -> Frame:
    known = {"radius": 0.25, "repeat": 1, "scale": 1.0, "mirror": False, "units": None, "accuracy": ACCURACY}
    return Frame(**{**known, **changes})


def csv(folder: Path, points, name="liner.csv") -> Path:
    path = folder / name
    path.write_text("\n".join(",".join(map(str, point)) for point in points))
    return path


def refusal(path: Path, **changes) -> str:
    with pytest.raises(ConfigError) as refused:
        read(path, frame(**changes))
    assert refused.value.key == "drum.liner.file"
    return str(refused.value).removeprefix("drum.liner.file ")


def test_a_closed_polyline_of_a_table_keeps_its_points(tmp_path):
    outlines, repeat = read(csv(tmp_path, [("x", "y"), *RAIL, RAIL[0]]), frame(repeat=8))
    assert repeat == 8
    assert [outline.name for outline in outlines] == ["lifter"]
    assert outlines[0].points.tolist() == [list(point) for point in RAIL]


def test_a_table_has_parts_and_blank_lines(tmp_path):
    path = tmp_path / "liner.csv"
    path.write_text(
        "# two lifters; the second in two pieces\n"
        "0.22 -0.01 Low\n0.26 -0.01 Low\n0.26 0.01 Low\n0.22 0.01 Low\n0.22 -0.01 Low\n"
        "0.01\t0.2\tHigh part\n0.01\t0.26\tHigh part\n\n0.01;0.26;High part\n"
        "-0.01; 0.26; High part\n-0.01,0.2,High part\n0.01,0.2,High part\n"
    )
    outlines, _ = read(path, frame())
    assert [(outline.name, len(outline.points)) for outline in outlines] == [("low", 4), ("high_part", 4)]


def test_scale_units_and_mirror(tmp_path):
    millimeters = [(220, -10), (250, -20), (250, 10), (220, -10)]
    path = csv(tmp_path, millimeters)
    plain = read(path, frame(units="mm"))[0][0].points
    assert np.allclose(plain, np.array(millimeters[:-1]) / 1000.0, rtol=1e-15)
    mirrored = read(path, frame(units="mm", scale=1.1, mirror=True))[0][0].points
    assert np.allclose(mirrored, plain * [1.1, -1.1], rtol=1e-15)


def test_dxf_layers_loose_segments_arcs_and_the_unit_of_the_header(tmp_path):
    document = ezdxf.new(units=4)
    space = document.modelspace()
    space.add_lwpolyline(
        [(200, -10), (255, -20), (255, 20), (200, 10)], close=True, dxfattribs={"layer": "High lifter"}
    )
    # Loose pieces of a round nose, in no order, one of them drawn backwards, with gaps of a micrometer.
    low = {"layer": "low"}
    space.add_arc((-230, 0), 10, 270, 90, dxfattribs=low)
    space.add_line((-251, 15), (-230, 10.001), dxfattribs=low)
    space.add_line((-230.001, -10), (-251, -15), dxfattribs=low)
    path = tmp_path / "liner.dxf"
    document.saveas(path)
    outlines, _ = read(path, frame())
    assert [outline.name for outline in outlines] == ["high_lifter", "low"]
    assert np.allclose(outlines[0].points, [[0.2, -0.01], [0.255, -0.02], [0.255, 0.02], [0.2, 0.01]])
    nose = outlines[1].points[np.hypot(*outlines[1].points.T) < 0.229]
    assert len(nose) > 5
    assert np.abs(np.hypot(*(nose - [-0.23, 0.0]).T) - 0.01).max() < ACCURACY / 10.0
    # The open end runs to the rim and is closed behind it.
    assert np.hypot(*outlines[1].points[-2:].T).min() > 0.25


def test_blocks_of_a_dxf_are_resolved(tmp_path):
    document = ezdxf.new(units=6)
    block = document.blocks.new("rail")
    block.add_lwpolyline(RAIL, close=True)
    for angle in (0.0, 90.0):
        document.modelspace().add_blockref("rail", (0.0, 0.0), dxfattribs={"rotation": angle})
    document.saveas(tmp_path / "liner.dxf")
    outlines, _ = read(tmp_path / "liner.dxf", frame())
    assert np.allclose(outlines[1].points @ [[0.0, -1.0], [1.0, 0.0]], outlines[0].points)


def test_chords_are_as_close_to_their_curve_as_asked(tmp_path):
    document = ezdxf.new(units=6)
    document.modelspace().add_circle((0.0, 0.0), 0.25)
    document.saveas(tmp_path / "drum.dxf")
    (tmp_path / "drum.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><circle r="0.25"/></svg>')
    for name in ("drum.dxf", "drum.svg"):
        sizes = []
        for accuracy in (1e-3, 1e-5):
            [shell], _ = read(tmp_path / name, frame(radius=None, accuracy=accuracy))
            middles = (shell.points + np.roll(shell.points, 1, axis=0)) / 2.0
            assert 0.0 < 0.25 - np.hypot(*middles.T).min() < 1.05 * accuracy
            assert np.allclose(np.hypot(*shell.points.T), 0.25, atol=1e-4 * accuracy + 1e-7)
            sizes.append(len(shell.points))
        assert sizes[0] < 80 < sizes[1]


def test_a_polyline_of_arcs_is_one_outline(tmp_path):
    document = ezdxf.new(units=6)
    # A slot: two straight sides of 0.04 m and two half circles, as bulges of 1.
    corners = [(0.18, -0.01, 0), (0.22, -0.01, 1), (0.22, 0.01, 0), (0.18, 0.01, 1)]
    document.modelspace().add_lwpolyline(corners, format="xyb", close=True)
    document.saveas(tmp_path / "liner.dxf")
    [slot], _ = read(tmp_path / "liner.dxf", frame(accuracy=1e-5))
    assert len(slot.points) > 20
    x, y = slot.points.T
    round_ends = np.hypot(np.maximum(np.abs(x - 0.2) - 0.02, 0.0), y)
    assert np.allclose(round_ends, 0.01, atol=1e-12)


def test_svg_groups_transforms_and_its_unit(tmp_path):
    (tmp_path / "liner.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        'width="600mm" viewBox="-300 -300 600 600"><g inkscape:label="Lifter A" transform="rotate(-90)">'
        '<path d="M 200 -10 L 255 -20 L 255 20 L 200 10 Z"/></g></svg>'
    )
    [lifter], _ = read(tmp_path / "liner.svg", frame())
    assert lifter.name == "lifter_a"
    # A turn by -90 degrees with y downwards is one to the top.
    assert np.allclose(lifter.points, [[-0.01, 0.2], [-0.02, 0.255], [0.02, 0.255], [0.01, 0.2]], atol=1e-12)


def test_pitches_that_meet_are_one_outline(tmp_path):
    angles = np.linspace(0.0, math.tau / 8, 20)
    radii = 0.23 + 0.01 * np.cos(8 * angles)
    wave = np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]).tolist()
    [shell], repeat = read(csv(tmp_path, wave), frame(radius=None, repeat=8))
    assert (repeat, len(shell.points)) == (1, 8 * 19)
    # Those that do not meet stay pitches.
    [lifter], repeat = read(csv(tmp_path, [*RAIL[1:], (0.19, 0.0), RAIL[1]]), frame(repeat=8))
    assert (repeat, len(lifter.points)) == (8, 4)


def test_ends_farther_apart_than_the_gap_stay_loose():
    lines = [Line("", np.array(points)) for points in ([[0.0, 0.0], [1.0, 0.0]], [[1.0, 1e-3], [1.0, 1.0]])]
    assert [len(line.points) for line in joined(lines, 2e-3)] == [3]
    assert [len(line.points) for line in joined(lines, 5e-4)] == [2, 2]


BAD = {
    "open": (
        [(0.22, -0.01), (0.24, -0.02), (0.24, 0.02)],
        {},
        "'liner.csv' has an open outline: it ends near [0.22, -0.01] m, 0.02977 m inside of the rim; "
        "close it, or let both ends reach the rim; a thin plate goes into drum.walls",
    ),
    "open, without a rim": (
        [(0.22, -0.01), (0.24, -0.02), (0.24, 0.02)],
        {"radius": None},
        "'liner.csv' has an open outline: its ends, near [0.22, -0.01] m and [0.24, 0.02] m, are 0.03606 m apart; "
        "close it; gaps up to 0.0002 m are closed for you",
    ),
    "crossing itself": (
        [(0.2, -0.01), (0.24, 0.02), (0.24, -0.02), (0.2, 0.01), (0.2, -0.01)],
        {},
        "'liner.csv' has an outline that crosses or touches itself near [0.2133, 0] m; draw two, or one around both",
    ),
    "there and back": (
        [(0.2, -0.01), (0.24, 0.02), (0.2, -0.01)],
        {},
        "'liner.csv' has a line there and back again near [0.2, -0.01] m",
    ),
    "outside": (
        [(0.3, 0.0), (0.4, 0.0), (0.4, 0.1), (0.3, 0.0)],
        {},
        "'liner.csv' has an outline near [0.3, 0] m, outside of the rim of radius 0.25 m; "
        "an outline reaches into the drum",
    ),
    "millimeters": (
        [(220, -10), (250, -20), (250, 20), (220, -10)],
        {},
        "'liner.csv' reaches 250.8 m from the axis, in a drum of radius 0.25 m: too far; "
        'are its lengths in millimeters? write drum.liner.units = "mm"',
    ),
    "millimeters, without a rim": (
        [(-220, -220), (220, -220), (0, 220), (-220, -220)],
        {"radius": None},
        "'liner.csv' reaches 311.1 m from the axis, thousands of bundles; "
        'are its lengths in millimeters? write drum.liner.units = "mm"',
    ),
    "meters as millimeters": (
        [*RAIL, RAIL[0]],
        {"units": "mm"},
        "'liner.csv' reaches 0.0002508 m from the axis, in a drum of radius 0.25 m: it cannot touch the rim; "
        "its lengths were read as mm; write drum.liner.units",
    ),
}


@pytest.mark.parametrize("kind", BAD)
def test_what_is_no_outline_is_refused(kind, tmp_path):
    points, changes, sentence = BAD[kind]
    assert refusal(csv(tmp_path, points), **changes) == sentence


def test_files_that_cannot_be_read_are_refused(tmp_path, monkeypatch):
    there = tmp_path / "liner.step"
    assert refusal(there).endswith("must be the path of a drawing: .dxf, .svg or .csv")
    assert refusal(tmp_path / "liner.csv") == f"'{tmp_path}/liner.csv' is not there"
    bad = csv(tmp_path, [(0.2, -0.01), (0.2, "x")])
    assert "has '0.2,x' in line 2, but must have x, y or x, y, part there" in refusal(bad)
    bad.write_bytes(b"\xff\xfe\xff")
    assert refusal(bad).endswith("is not text in UTF-8")
    bad.write_text("# nothing\n")
    assert "holds no lines" in refusal(bad)
    for name in ("liner.dxf", "liner.svg"):
        (tmp_path / name).write_text("hello")
        assert f"{name}' " in refusal(tmp_path / name)
    monkeypatch.setitem(__import__("sys").modules, "svgpathtools", None)
    assert refusal(tmp_path / "liner.svg").endswith(
        "needs the package svgpathtools to be read; install it with: pip install 'drumrs[cad]'"
    )
