"""`Config.scaled`: the same motion in a drum of another size, and every key that has a dimension."""

import math

import numpy as np
import pytest
from pydantic import BaseModel

import drumrs
from drumrs.analysis import estimate
from drumrs.config import Config
from drumrs.errors import ConfigError

# A drum with a bit of everything.
DRUM = drumrs.baseline(fill=0.3, baffles=True).replace(
    {
        "load.start_speed": 1.0,
        "load.moisture": 0.5,
        "rotation.program": [[0.0, 54.0], [0.02, -54.0], [0.06, 27.0]],
        "contact.drum.normal_damping": 7.74e3,
        "contact.bundle.adhesion": 2.0,
        "contact.bundle.rolling_friction": 0.05,
        "contact.bundle.tangential_damping_ratio": 0.2,
        "run.duration": 0.15,
        "run.sample_every": 0.001,
        "run.frame_every": 0.01,
    }
)


def motion(config):
    found = drumrs.run(config, progress=False)
    return found.frames.positions, found.frames.velocities, found.series


@pytest.mark.parametrize(
    ("changes", "factors"),
    [
        ({}, (4.0, 0.25)),
        ({"run.time_step": "auto"}, (4.0,)),
        # Its damping has the fourth root of the overlap.
        (
            {
                "contact.base": "hertz",
                "contact.bundle.young_modulus": 2e8,
                "contact.drum.young_modulus": 2e8,
                "contact.bundle.rolling_friction": 0.0,
                "contact.bundle.tangential_damping_ratio": 0.0,
                "contact.drum.restitution": 0.1,
                "contact.bundle.adhesion": 0.0,
            },
            (1.0 / 16.0,),
        ),
        (
            {
                "load.share_by": "mass",
                "load.species": [
                    {
                        "name": "small",
                        "share": 0.5,
                        "sizes": {"law": "normal", "by": "mass", "mean": 0.02, "sigma": 0.002},
                    },
                    {"name": "large", "share": 0.5, "diameter": 0.03, "contact": {"normal_stiffness": 5e7}},
                ],
            },
            (4.0,),
        ),
    ],
    ids=["linear", "auto", "hertz", "species"],
)
def test_where_all_groups_are_kept_the_motion_is_the_same_to_the_bit(changes, factors):
    config = DRUM.replace(changes)
    positions, velocities, series = motion(config)
    for factor in factors:
        others, fast, large = motion(config.scaled(factor))
        assert np.array_equal(positions * np.float32(factor), others)
        assert np.array_equal(velocities * np.float32(math.sqrt(factor)), fast)
        for name in ("drum_work", "dissipated_normal", "dissipated_sliding", "elastic_normal"):
            assert np.array_equal(series[name].to_numpy() * factor**3, large[name].to_numpy()), name


def test_other_factors_are_the_same_within_the_statistical_error():
    config = drumrs.baseline(fill=0.1).replace({"run.duration": 1.0, "run.window": [0.4, 1.0]})

    def power(of):
        runs = [drumrs.run(of.replace({"run.seed": seed}), progress=False).summary for seed in range(5)]
        return estimate([run.drum_specific_power for run in runs])

    large, small = power(config.scaled(3.0)), power(config)
    ratio = (large / small).interval(0.999)
    assert ratio.low < math.sqrt(3.0) < ratio.high
    assert ratio.half_width < 0.5


def test_every_key_with_a_dimension_follows():
    stays = {"kg/m³", "m/s²", "degrees", "1"}
    config = DRUM.replace({"run.cell": 0.01, "run.arc_bin": 0.02})
    before, after = dict(leaves(config)), dict(leaves(config.scaled(4.0)))
    # The interval of checkpoints is in time of the wall clock.
    clock = {"run.checkpoint_every"}
    checked = 0
    for key, (unit, value) in before.items():
        if not value or unit == "":
            continue
        if unit in stays or key in clock:
            assert after[key][1] == value, key
        else:
            assert after[key][1] != value, key
            checked += 1
    assert checked >= 18


def leaves(table, at=""):
    for name, field in type(table).model_fields.items():
        value = getattr(table, name)
        if isinstance(value, BaseModel):
            yield from leaves(value, f"{at}{name}.")
        elif value is not None and not isinstance(value, str):
            yield f"{at}{name}", ((field.json_schema_extra or {}).get("unit", ""), value)


def test_the_bundle_stays_where_it_is_kept():
    large = DRUM.scaled(4.0, keep="bundle")
    assert large.load == DRUM.load.model_copy(update={"start_speed": 2.0})
    assert large.contact == DRUM.contact
    assert large.run.time_step == DRUM.run.time_step
    assert large.bundle_count == 16 * DRUM.bundle_count
    assert large.drum.baffles.height == 4.0 * DRUM.drum.baffles.height
    assert (large.rotation.program[1][0], large.run.duration) == (0.04, 0.3)
    assert large.derived.froude_number == pytest.approx(DRUM.derived.froude_number)


def test_amounts_of_load_follow():
    counted = drumrs.baseline().replace({"load.count": 101})
    assert counted.scaled(1.5, "bundle").load.count == round(101 * 2.25)
    assert counted.scaled(1.5).load.count == 101
    heavy = drumrs.baseline().replace({"load.mass": 5.0, "drum.depth": 0.3})
    assert heavy.scaled(2.0, "bundle").bundle_count == pytest.approx(4 * heavy.bundle_count, abs=2)
    assert heavy.scaled(2.0).bundle_count == heavy.bundle_count


def test_phases_of_a_program_take_their_time():
    program = [
        {
            "repeat": 2,
            "reversing": True,
            "phase": [{"duration": 1.0, "rpm": 50.0}, {"duration": 0.5, "ramp": [50.0, 0.0]}],
        }
    ]
    large = Config().replace({"rotation.phase": program, "run.duration": 3.0}).scaled(4.0)
    assert [(each.start, each.end, each.speeds) for each in large.rotation.intervals][2:] == [
        (3.0, 5.0, (-25.0, -25.0)),
        (5.0, 6.0, (-25.0, 0.0)),
    ]


def test_outlines_zones_and_walls_follow():
    config = DRUM.replace(
        {
            "drum.walls": [[[0.1, 0.0], [0.15, 0.0]]],
            "run.zone": [{"name": "spray", "corners": [[0.0, -0.1], [0.1, 0.0], [0.1, 0.1]]}],
        }
    )
    large = config.scaled(4.0)
    assert large.drum.walls == (((0.4, 0.0), (0.6, 0.0)),)
    assert large.run.zone[0].corners[0] == (0.0, -0.4)


@pytest.mark.parametrize("factor", [0.0, -1.0, math.inf, math.nan, "2", True])
def test_factors_are_positive_and_finite(factor):
    with pytest.raises(ConfigError, match=r"^factor is .*, but must be a positive finite number"):
        DRUM.scaled(factor)


def test_what_is_kept_is_named():
    with pytest.raises(ConfigError, match="keep is 'all', but must be 'groups' or 'bundle'"):
        DRUM.scaled(2.0, keep="all")
