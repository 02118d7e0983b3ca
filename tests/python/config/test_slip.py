"""A smooth rim lets a bed of discs that roll freely slip as a whole; teeth or rolling friction carry it along."""

import math

import numpy as np

import drumrs

DIAMETER, DISC, RPM = 0.24, 0.008, 11.6
TURN = 60.0 / RPM


def layer_speed(changes) -> float:
    """Return the angular velocity about the axis of the discs next to the rim, over the drum's."""
    contact = {"normal_stiffness": 1e5, "friction": 0.3, "restitution": 0.5}
    config = drumrs.baseline().replace(
        {
            "drum.diameter": DIAMETER,
            "load": {"diameter": DISC, "density": 2500.0, "fill": 0.31},
            "contact": {"bundle": contact, "drum": contact},
            "rotation.rpm": RPM,
            "run": {"time_step": "auto", "duration": TURN, "window": [0.5 * TURN, TURN], "frame_every": 0.02},
            **changes,
        }
    )
    frames = drumrs.run(config, progress=False).frames
    late = frames.times > 0.5 * TURN
    x, y = np.moveaxis(frames.positions[late], -1, 0)
    swept = np.diff(np.unwrap(np.arctan2(y, x), axis=0), axis=0)
    outer = np.hypot(x, y)[:-1] > DIAMETER / 2.0 - (2.5 if config.drum.baffles.count else 1.5) * DISC
    speed = swept[outer].mean() / np.diff(frames.times[late]).mean()
    return float(speed / (RPM * math.tau / 60.0))


def test_a_bed_slips_on_a_smooth_rim_and_turns_with_a_rough_one():
    assert layer_speed({}) < 0.65
    teeth = {"drum.baffles": {"count": 22, "height": DISC, "base": 4.0 / 3.0 * DISC}}
    assert layer_speed(teeth) > 0.85
