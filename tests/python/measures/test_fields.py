"""Fields of what has no bed, or turns the other way, from frames and from sums; discs that go round a center."""

import math
from dataclasses import replace

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import Simulation, State, measures
from drumrs.contact_records import FIELDS
from drumrs.errors import ConfigError
from drumrs.verification import made_up

WINDOW = (0.0, 1.0)


def test_clockwise_is_the_mirror_image():
    draws = np.random.default_rng(1)
    frames = made_up.segment(1.2, 0.4, 0.05, 4)
    frames = replace(frames, velocities=draws.normal(0.0, 1.0, frames.positions.shape))
    flip = np.array([-1.0, 1.0])
    other = replace(
        frames,
        positions=frames.positions * flip,
        velocities=frames.velocities * flip,
        drum_angles=-frames.drum_angles,
    )
    one, two = (measures.fields(each, WINDOW, np.ones(frames.count)) for each in (frames, other))
    assert np.array_equal(one.density, two.density)
    assert np.array_equal(one.velocity, two.velocity, equal_nan=True)


def test_where_there_is_no_bed_nothing_circulates():
    fields = measures.fields(made_up.frames(np.full((4, 1, 2), 0.3), 0.05), WINDOW, [1.0])
    fields = replace(fields, solid_fraction=np.zeros_like(fields.solid_fraction))
    with pytest.raises(ConfigError, match="without a bed"):
        measures.center_of_circulation(fields)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_discs_that_go_round_a_center_are_counted(sense):
    center, angles = np.array([0.3 * sense, -0.4]), sense * np.linspace(0.0, math.tau, 81)
    around = np.array([[0.1, 0.0], [0.0, -0.2], [0.3, 0.1]])
    places = [center + around @ made_up.turned(2.5 * angle) for angle in angles]
    frames = made_up.frames(places, 0.05, drum_angles=angles)
    assert measures.circulation(frames, WINDOW, np.array([0.3, -0.4])).value == pytest.approx(2.5)


def test_the_way_of_the_drum_is_that_of_the_window():
    # Two turns back, then one ahead: the window is the last turn.
    angles = np.concatenate(
        [np.linspace(0.0, -2.0 * math.tau, 81)[:-1], -2.0 * math.tau + np.linspace(0.0, math.tau, 81)]
    )
    places = [np.array([[0.3, -0.2], [0.5, 0.1]]) @ made_up.turned(angle) for angle in angles]
    frames = made_up.frames(places, 0.05, drum_angles=angles)
    found = measures.circulation(frames, (0.8, 1.6), np.array([0.1, 0.05]))
    assert found.value == pytest.approx(1.0)
    off_center = made_up.frames(np.add(places, [0.4, 0.0]), 0.05, drum_angles=angles)
    assert measures.circulation(off_center, (0.8, 1.6), np.array([0.4, 0.0])).value == pytest.approx(1.0)


def test_a_load_at_rest_has_no_turn_to_count_by():
    still = made_up.frames(np.full((4, 1, 2), 0.3), 0.05, drum_angles=np.zeros(4))
    assert measures.circulation(still, WINDOW) is None


def cells(**columns) -> pl.DataFrame:
    """Return sums in four by four cells of side 1: nothing but what is given, as arrays by x and y."""
    middles = np.arange(-1.5, 2.0)
    made = {column.name: np.zeros(16) for column in FIELDS}
    made |= {"x": np.repeat(middles, 4), "y": np.tile(middles, 4)}
    return pl.DataFrame(made | {name: np.ravel(values) for name, values in columns.items()})


def test_recorded_fields_of_a_clockwise_drum_are_the_mirror_image():
    draws = np.random.default_rng(2)
    names = [column.name for column in FIELDS[2:]]
    table = cells(**{name: draws.uniform(1.0, 2.0, (4, 4)) for name in names})
    mirrored = table.with_columns(
        -pl.col(
            "x",
            "momentum_x",
            "momentum_flux_xy",
            "contact_stress_xy",
            "contact_stress_yx",
        )
    ).sort("x", "y")
    one = measures.recorded_fields(mirrored, 1.0)
    two = measures.recorded_fields(table, 1.0, clockwise=True)
    for field in ("density", "velocity", "kinetic_stress", "contact_stress"):
        assert np.array_equal(getattr(one, field), getattr(two, field), equal_nan=True)
    plain = measures.recorded_fields(table, 1.0)
    flow, flipped = plain.velocity[3:-3, 3:-3], two.velocity[3:-3, 3:-3][::-1]
    assert np.allclose(flow * [-1.0, 1.0], flipped)


def test_what_trembles_in_one_cell_is_fluctuation_and_what_flows_is_not():
    density, flux = np.zeros((4, 4)), np.zeros((4, 4))
    density[1, 2], flux[1, 2] = 3.0, 12.0
    alone = measures.recorded_fields(cells(density=density, momentum_flux_xx=flux), 0.0)
    assert alone.kinetic_stress[1, 2, 0, 0] == 12.0
    assert alone.fluctuation[1, 2] == 2.0
    moving = cells(density=density, momentum_x=2.0 * density, momentum_flux_xx=flux)
    assert measures.recorded_fields(moving, 0.0).kinetic_stress[1, 2, 0, 0] == 0.0


@pytest.mark.parametrize("width", [0.0, 1.5])
def test_what_turns_with_the_drum_has_no_velocity_relative_to_it(width):
    middles, speed = np.arange(-1.5, 2.0), 3.0
    x, y = np.meshgrid(middles, middles, indexing="ij")
    density = np.random.default_rng(3).uniform(1.0, 2.0, (4, 4))
    turning = cells(density=density, momentum_x=-speed * density * y, momentum_y=speed * density * x)
    seen = measures.recorded_fields(turning, width, relative_to=speed)
    assert np.nanmax(np.abs(seen.velocity)) < 1e-12
    # At rest, it is left behind.
    resting = measures.recorded_fields(cells(density=density), 0.0, relative_to=speed)
    assert np.allclose(resting.velocity, speed * np.stack([y, -x], axis=-1))


def test_a_ring_that_a_drum_carries_along_rests_in_its_frame():
    """What is left of the velocity of a load that clings to the drum comes of the width of cells."""
    rows = {"run.duration": 2.0, "run.window": [1.5, 2.0], "run.record": ["fields"], "rotation.rpm": 100.0}
    rows |= {f"contact.{body}.rolling_friction": 0.3 for body in ("bundle", "drum")}
    config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0).replace(rows)
    result = drumrs.run(config, progress=False)
    speed = config.derived.angular_velocity
    still, seen = (measures.recorded_fields(result.fields, relative_to=turning) for turning in (0.0, speed))
    clings = seen.solid_fraction > 0.2
    fast, slow = (np.hypot(*each.velocity[clings].T).mean() for each in (still, seen))
    assert fast == pytest.approx(speed * (0.2375 - 0.011875), rel=0.1)
    assert slow < 0.03 * fast


def test_a_stack_at_rest_bears_the_weight_above():
    radius, count = 0.011875, 5
    rows = {"rotation.rpm": 0.0, "run.record": ["fields"], "run.duration": 0.6, "run.window": [0.4, 0.6]}
    config = drumrs.baseline(fill=0.1).softer(100.0).replace({**rows, "run.cell": 0.25 * radius})
    heights = radius * (1.0 + 2.0 * np.arange(count)) - 0.2375
    simulation = Simulation(config, state=State(np.column_stack([np.zeros(count), heights])))
    simulation.run(0.6)
    found = measures.recorded_fields(simulation.records.contact_tables()["fields"], 0.0)
    side = found.x[1] - found.x[0]
    borne = side * found.contact_stress[..., 1, 1].sum(axis=0)
    weight = 1000.0 * math.pi * radius**2 * 9.81
    for level in range(count):
        # Below the center of a disc, where its own weight is borne, too.
        row = int(np.abs(found.y - (heights[level] - 0.5 * radius)).argmin())
        assert borne[row] == pytest.approx((count - level) * weight, rel=0.01)
    assert side * found.pressure.sum(axis=0)[row] == pytest.approx(0.5 * borne[row], rel=1e-3)


def test_frames_know_no_pressure():
    with pytest.raises(ConfigError, match="lacks 'fields'"):
        _ = measures.fields(made_up.frames(np.full((4, 1, 2), 0.3), 0.05), WINDOW, [1.0]).pressure


@pytest.mark.parametrize("width", [-1.0, math.nan])
def test_a_width_below_zero_is_refused(width):
    with pytest.raises(ConfigError, match="width"):
        measures.recorded_fields(cells(density=np.ones(16)), width)
