"""Drums from keys and from drawings: the same bits either way, what is drawn, what is refused."""

import json
import math
import shutil

import ezdxf
import numpy as np
import pytest
import shapely

import drumrs
from drumrs.config import Config, Rail
from drumrs.errors import ConfigError

RAILS = {"count": 8, "height": 0.03, "width": 0.02, "face_angle": 25.0, "back_angle": 10.0}
SHORT = {
    "run.duration": 0.3,
    "run.window": [0.1, 0.3],
    "run.time_step": "auto",
    "load.count": 60,
    "load.start_speed": 0.5,
}


def config(changes, softer=100.0) -> Config:
    return drumrs.baseline().replace({**SHORT, **changes}).softer(softer)


def refusal(changes) -> str:
    with pytest.raises(ConfigError) as refused:
        drumrs.Simulation(config(changes))
    return str(refused.value)


def polygon(sides: int, radius: float = 0.2375) -> list[list[float]]:
    angles = math.tau * (np.arange(sides) + 0.5) / sides - math.pi / 2
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles)]).tolist()


def csv(path, points):
    path.write_text("\n".join(f"{x!r},{y!r}" for x, y in [*points, points[0]]))
    return str(path)


def test_a_rail_leans_back_by_its_angles():
    rail = Rail(**RAILS)
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = rail.outline(0.25)
    assert (x0, x1, x2, x3) == (0.22, 0.25, 0.25, 0.22)
    assert (y3 - y0, y2 - y1) == pytest.approx((0.02, rail.base), abs=1e-16)
    assert rail.base == pytest.approx(0.02 + 0.03 * (math.tan(math.radians(25)) + math.tan(math.radians(10))))
    # The face ahead, for a drum that turns counter-clockwise, leans more.
    assert math.degrees(math.atan2(y2 - y3, x2 - x3)) == pytest.approx(25.0)


def test_rails_from_keys_and_from_a_file_give_the_same_bits(tmp_path):
    keys = drumrs.Simulation(config({"drum.liner.rail": RAILS}))
    drawing = csv(tmp_path / "rail.csv", Rail(**RAILS).outline(0.2375))
    file = drumrs.Simulation(config({"drum.liner.file": drawing, "drum.liner.repeat": 8}))
    for simulation in (keys, file):
        simulation.run()
    assert keys.frames.baffles[3].tobytes() == file.frames.baffles[3].tobytes()
    assert keys.positions.tobytes() == file.positions.tobytes()
    assert keys.series["rail_3_work"].to_list() == file.series["lifter_3_work"].to_list()
    assert any(keys.series["rail_1_work"])


def test_a_mirrored_liner_in_a_drum_that_turns_the_other_way_takes_the_same_power(tmp_path):
    drawing = csv(tmp_path / "rail.csv", Rail(**RAILS).outline(0.2375))
    liner = {"drum.liner.file": drawing, "drum.liner.repeat": 8}
    one, other = (
        drumrs.Simulation(
            config({**liner, **changes}),
            state=drumrs.State([[side * 0.05, -0.19], [side * 0.1, -0.16]]),
        )
        for side, changes in (
            (1.0, {}),
            (-1.0, {"drum.liner.mirror": True, "rotation.rpm": -54.0}),
        )
    )
    one.run(duration=0.1)
    other.run(duration=0.1)
    # The first rail stands on +x, so the mirror image is turned by half a turn: four of eight pitches.
    assert np.allclose(one.positions * [-1.0, 1.0], other.positions, atol=1e-9)
    assert np.abs(one.velocities).max() > 0.1


def test_a_drawing_stands_in_the_configuration_once_it_is_read(tmp_path):
    folder = tmp_path / "machine"
    folder.mkdir()
    csv(folder / "rail.csv", Rail(**RAILS).outline(0.2375))
    case = folder / "case.toml"
    case.write_text('[drum.liner]\nfile = "rail.csv"\nrepeat = 6\n[load]\nfill = 0.2\n')
    read = Config.read(case)
    shutil.rmtree(folder)
    assert read.drum.liner.file is None
    assert [len(outline.points) for outline in read.drum.liner.outlines] == [4]
    for text, again in ((read.to_toml(), Config.from_toml), (read.to_json(), Config.from_json)):
        assert again(text) == read
        assert again(text).digest == read.digest
    assert read.replace({"run.seed": 2}).drum == read.drum
    assert read.title == "80 bundles (20 % fill), 6 lifters, 54 rpm, seed 1"
    moved = read.replace({"drum.liner.outlines": [{"points": [[0.22, -0.01], [0.25, 0.0], [0.22, 0.01]]}]})
    assert moved.digest != read.digest


def test_another_drawing_takes_the_place_of_the_one_before(tmp_path):
    one = csv(tmp_path / "one.csv", Rail(**RAILS).outline(0.2375))
    other = csv(tmp_path / "other.csv", Rail(**{**RAILS, "height": 0.04}).outline(0.2375))
    first = drumrs.baseline().replace({"drum.liner.file": one, "drum.liner.repeat": 6})
    second = first.replace({"drum.liner.file": other})
    assert second.drum.liner.repeat == 6
    assert second.drum.liner.outlines[0].points[0][0] == pytest.approx(0.1975)


def test_sweeps_vary_a_rail_and_the_drawing(tmp_path):
    csv(tmp_path / "one.csv", Rail(**RAILS).outline(0.2375))
    csv(tmp_path / "two.csv", Rail(**{**RAILS, "height": 0.04}).outline(0.2375))
    base = drumrs.baseline().replace({"drum.liner.rail": RAILS})
    sweep = drumrs.Sweep(base, {"drum.liner.rail.face_angle": [0.0, 15.0, 30.0]})
    assert [case.config.drum.liner.rail.face_angle for case in sweep.cases] == [0.0, 15.0, 30.0]
    assert len({case.id for case in sweep.cases}) == 3
    file = tmp_path / "sweep.toml"
    file.write_text('base.drum.liner.repeat = 5\n[axes]\ndrum.liner.file = ["one.csv", "two.csv"]\n')
    from drumrs.sweep import read_sweep

    tops = [case.config.drum.liner.outlines[0].points[0][0] for case in read_sweep(file).cases]
    assert tops == pytest.approx([0.2075, 0.1975])


def test_layers_name_the_parts_of_high_and_low_lifters(tmp_path):
    document = ezdxf.new(units=4)
    for layer, height, angle in (("High", 40, 0.0), ("Low", 20, 45.0)):
        rail = Rail(count=1, height=height, width=20.0, face_angle=20.0).outline(237.5)
        line = document.modelspace().add_lwpolyline(rail, close=True, dxfattribs={"layer": layer})
        line.rotate_z(math.radians(angle))
    document.saveas(tmp_path / "liner.dxf")
    simulation = drumrs.Simulation(
        config({"drum.liner.file": str(tmp_path / "liner.dxf"), "drum.liner.repeat": 4})
    )
    simulation.run(duration=0.1)
    series = simulation.series
    assert [f"{name}_{k}_work" in series for name in ("high", "low") for k in range(6)] == [
        *[False, True, True, True, True, False],
        *[False, True, True, True, True, False],
    ]
    assert drumrs.quantity("high_3_torque").meaning == "torque of high 3 on the load about the axis"
    assert len(simulation.frames.baffles) == 8


def test_parts_of_a_liner_and_baffles_that_meet_are_named():
    both = {"drum.liner.rail": RAILS, "drum.baffles.count": 4}
    assert refusal(both) == (
        "drum.liner.rail is so placed that baffle 1 and rail 1 touch or overlap, "
        "but must be so placed that all parts are apart"
    )
    drumrs.Simulation(config({**both, "drum.liner.rail.phase": 22.5}))


def test_a_bundle_in_many_sides_rests_as_low_as_in_a_round_drum():
    still = {"rotation.rpm": 0.0, "run.duration": 0.5, "run.window": [0.1, 0.5]}
    start = drumrs.State([[0.0, -0.2]])
    heights = {}
    for sides in (32, 64):
        shell = {"drum.rim": False, "drum.liner.outlines": [{"points": polygon(sides)}]}
        simulation = drumrs.Simulation(config({**shell, **still}), state=start)
        simulation.run(duration=0.5)
        heights[sides] = simulation.positions[0, 1]
    bare = drumrs.Simulation(config(still), state=start)
    bare.run(duration=0.5)
    low, less = heights[32] - bare.positions[0, 1], heights[64] - bare.positions[0, 1]
    assert low == pytest.approx(0.2375 * (1 - math.cos(math.pi / 32)), rel=1e-6)
    assert low / less == pytest.approx(4.0, rel=0.01)


def test_a_drum_of_many_sides_takes_the_power_of_a_round_one():
    long = {"load.count": 100, "run.duration": 10.0, "run.window": [3.0, 10.0], "load.start_speed": 0.0}
    shell = {"drum.rim": False, "drum.liner.outlines": [{"points": polygon(64)}]}
    round_, many = (drumrs.run(config({**long, **drum}), progress=False).summary for drum in ({}, shell))
    error = math.hypot(round_.drum_specific_power_error, many.drum_specific_power_error)
    assert abs(round_.drum_specific_power - many.drum_specific_power) < 3.0 * error
    assert error < 0.05 * round_.drum_specific_power


@pytest.mark.parametrize(
    "plate",
    [
        {"drum.walls": [[[0.05, -0.24], [0.05, 0.24]]]},
        # A hundredth of a millimeter thick.
        {
            "drum.liner.outlines": [
                {"points": [[0.05, -0.24], [0.05001, -0.24], [0.05001, 0.24], [0.05, 0.24]]}
            ]
        },
    ],
)
def test_nothing_passes_a_plate_thinner_than_a_step_of_motion(plate):
    changes = {"load.count": 120, "run.duration": 2.0, "run.window": [0.0, 2.0], **plate}
    divided = config(changes)
    frames = drumrs.run(divided, progress=False).frames
    assert frames.speeds.max() * divided.derived.time_step > 5e-5
    x, y = np.moveaxis(frames.positions, -1, 0)
    turn = frames.drum_angles[:, np.newaxis]
    beyond = x * np.cos(turn) + y * np.sin(turn) > 0.05
    assert 30 < beyond[0].sum() < 60
    assert (beyond == beyond[0]).all()


def test_a_drum_that_is_not_round_packs_shows_and_saves_itself(tmp_path):
    from drumrs.output import player, save
    from drumrs.viewer.recording import pack

    hexagon = {"drum.rim": False, "drum.liner.outlines": [{"name": "shell", "points": polygon(6)}]}
    drum = config(hexagon).replace({"load.fill": 0.3})
    area = 0.2375**2 * 3 * math.sin(math.pi / 3)
    assert drum.bundle_count == round(0.3 * area / (math.pi * drum.load.diameter**2 / 4))
    assert drum.title.startswith(f"{drum.bundle_count} bundles (29.9 % fill), 6 sides")
    result = drumrs.run(drum, progress=False)
    assert result.summary.fill == pytest.approx(drum.fill)
    assert player(result).title.startswith(drum.title.partition(", seed")[0])
    save(result, tmp_path, pictures=False)
    frames = drumrs.load(tmp_path).frames
    assert np.array_equal(frames.shell, result.frames.shell)
    assert frames.drum_radius is None
    assert frames.reach == pytest.approx(0.2375)
    assert pack(frames, None, "a hexagon", None)["shell"] == frames.shell.tolist()
    # Every bundle stays inside, as seen from the drum.
    cos, sin = np.cos(frames.drum_angles), np.sin(frames.drum_angles)
    turns = np.array([[cos, -sin], [sin, cos]]).transpose(2, 0, 1)
    room = shapely.Polygon(frames.shell).buffer(-0.9 * frames.radii[0])
    assert shapely.contains_xy(room, (frames.positions @ turns).reshape(-1, 2)).all()
    assert any(result.series["rim_work"])


REFUSED = {
    "a scale without a drawing": (
        {"drum.liner.scale": 2.0},
        "drum.liner.scale is 2.0, but must be left out where no drum.liner.file is given; "
        "a drawing that has been read is in drum.liner.outlines: give its file again to read it otherwise",
    ),
    "shell and rim": (
        {"drum.liner.outlines": [{"points": polygon(8)}]},
        "drum.liner.outlines[0] runs round the axis, so it is the drum itself, but there is a rim, too; "
        "write drum.rim = false",
    ),
    "two shells": (
        {"drum.rim": False, "drum.liner.outlines": [{"points": polygon(8)}, {"points": polygon(9, 0.2)}]},
        "drum.liner.outlines[1] runs round the axis, but so does another outline; a drum has one shell",
    ),
    "a repeated shell": (
        {"drum.rim": False, "drum.liner.outlines": [{"points": polygon(8)}], "drum.liner.repeat": 2},
        "drum.liner.repeat is 2, but must be 1 where an outline runs round the axis",
    ),
    "rails and outlines": (
        {"drum.liner.rail": RAILS, "drum.liner.outlines": [{"points": Rail(**RAILS).outline(0.2375)}]},
        "drum.liner.rail and drum.liner.outlines are both given, but only one of them may be",
    ),
    "rails without a rim": (
        {"drum.liner.rail": RAILS, "drum.rim": False},
        "drum.liner.rail.count is 8, but must be 0 where drum.rim is false",
    ),
    "a rail beyond the axis": (
        {"drum.liner.rail": {**RAILS, "height": 0.3}},
        "drum.liner.rail.height is 0.3, but must be smaller than half of drum.diameter = 0.475, "
        "so that it ends before the axis",
    ),
    "faces that cross": (
        {"drum.liner.rail": {**RAILS, "face_angle": -50.0}},
        "drum.liner.rail.face_angle and drum.liner.rail.back_angle = 10.0 let the two faces cross above the foot",
    ),
    "rails too many": (
        {"drum.liner.rail": {**RAILS, "count": 40}},
        "drum.liner.rail.count is 40, but must be so small that no rail touches or overlaps the next",
    ),
    "a corner too round": (
        {"drum.baffles.count": 3, "drum.baffles.corner_radius": 0.05},
        "drum.baffles.corner_radius is 0.05, but must be smaller than 0.0",
    ),
    "an outline that crosses itself": (
        {"drum.liner.outlines": [{"points": [[0.2, 0.01], [0.22, -0.01], [0.22, 0.01], [0.2, -0.01]]}]},
        "drum.liner.outlines is a polygon whose sides 1 and 3 cross or touch, but must be a polygon that never meets "
        "itself",
    ),
    "a name that is none": (
        {"drum.liner.outlines": [{"name": "7 up", "points": polygon(3)}]},
        "drum.liner.outlines[0].name is '7 up', but must be a name that begins with a small letter",
    ),
    "walls in millimeters": (
        {"drum.walls": [[[0.0, -50.0], [100.0, -50.0]]]},
        "drum.walls[0] is as far as 111.8034 m from the axis, but must be in or near the drum, whose radius is 0.2375 "
        "m; lengths are in meters: are these centimeters or millimeters?",
    ),
    "baffles in millimeters": (
        {"drum.baffles.count": 3, "drum.baffles.height": 40.0},
        "drum.baffles.height is 40, but must be smaller than the drum's radius 0.2375, so that it ends before the "
        "axis; lengths are in meters: are these centimeters or millimeters?",
    ),
    "a rail in millimeters": (
        {"drum.liner.rail": {**RAILS, "width": 20.0}},
        "drum.liner.rail.width is 20.0, but must be smaller than drum.diameter = 0.475",
    ),
    "a shell in millimeters": (
        {
            "drum.rim": False,
            "drum.liner.outlines": [{"points": polygon(12, 237.5)}],
            "load.count": None,
            "load.fill": 0.3,
        },
        "one bundle of diameter 0.02375 fills 2.618e-09 of a drum of diameter 464.172; lengths are in meters: are some "
        "of these millimeters?",
    ),
    "a drum in millimeters": (
        {"drum.diameter": 475.0, "load.count": None, "load.fill": 0.3},
        "fills 2.5e-09 of a drum of diameter 475; lengths are in meters: are some of these millimeters?",
    ),
    "a depth in millimeters": (
        {"drum.depth": 350.0, "load.count": None, "load.mass": 5.0},
        "one bundle of diameter 0.02375 weighs 155.1 kg in a drum 350 m deep; lengths are in meters: are some of these "
        "millimeters?",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_what_is_no_drum_is_refused(kind):
    changes, sentence = REFUSED[kind]
    assert sentence in refusal(changes)


def test_a_drawing_of_the_whole_drum_beside_a_rim_is_refused(tmp_path):
    file = csv(tmp_path / "drum.csv", polygon(12))
    assert refusal({"drum.liner.file": file}).endswith("write drum.rim = false")
    assert refusal({"drum.liner.file": 3}) == (
        "drum.liner.file is 3, but must be the path of a drawing: .dxf, .svg or .csv"
    )
    drum = config({"drum.liner.file": file, "drum.rim": False})
    assert len(drum.drum.shell.points) == 12


def test_a_polygon_may_repeat_its_first_point():
    corners = [[0.0, -0.01], [0.04, 0.0], [0.0, 0.01]]
    drums = [
        config({"drum.baffles": {"count": 3, "shape": "polygon", "points": points}})
        for points in (corners, [*corners, corners[0]])
    ]
    one, other = map(drumrs.Simulation, drums)
    assert all(map(np.array_equal, one.frames.baffles, other.frames.baffles))


def test_a_trapezoid_without_a_tip_gives_the_bits_of_a_triangle():
    shapes = [{"shape": "triangle"}, {"shape": "trapezoid", "tip": 0.0}]
    ends = []
    for shape in shapes:
        simulation = drumrs.Simulation(config({"drum.baffles": {"count": 3, **shape}}))
        simulation.run(duration=0.1)
        ends.append(simulation.positions.tobytes())
    assert ends[0] == ends[1]


def test_the_printed_configuration_has_the_tables_with_comments():
    text = drumrs.baseline().to_toml()
    assert "[drum.liner]" in text
    assert '# file = "liner.dxf"' in text
    assert "[drum.liner.rail] # Rail bars: equal lifters with straight faces" in text
    assert Config.from_toml(text) == drumrs.baseline()
    assert json.loads(drumrs.baseline().to_core_json())["drum"]["baffles"][0]["name"] == "baffle"
