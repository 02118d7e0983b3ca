"""The regimes of loads that were simulated: a half-empty drum without baffles, from slow to fast."""

import math

import pytest

import drumrs
from drumrs import measures

_RADIUS, _GRAVITY = 0.2, 9.81


def regime_at(
    froude: float, friction: float = 0.7, start: float = 1.5, turned: float = 0.0
) -> measures.Regime:
    """Simulate a second at least, or until the drum has turned so far [rad] after the start."""
    speed = math.sqrt(froude * _GRAVITY / _RADIUS)
    end = start + max(1.0, turned / speed)
    law = {"normal_stiffness": 1e5, "restitution": 0.3, "friction": 0.6, "rolling_friction": 0.1}
    settings = {f"contact.{side}.{key}": value for side in ("bundle", "drum") for key, value in law.items()}
    config = drumrs.baseline(baffles=False).replace(
        {
            **settings,
            "contact.drum.friction": friction,
            "drum.diameter": 2.0 * _RADIUS,
            "load.diameter": 0.016,
            "load.fill": 0.35,
            "rotation.rpm": speed * 30.0 / math.pi,
            "run.time_step": "auto",
            "run.duration": end,
            "run.window": [start, end],
            "run.frame_every": 0.02 if froude < 0.1 else 0.01,
        }
    )
    return measures.regime(drumrs.run(config, progress=False).frames, (start, end))


@pytest.mark.filterwarnings("ignore::drumrs.DrumrsWarning")
@pytest.mark.parametrize(
    ("name", "froude", "how"),
    [
        ("slipping", 0.004, {"friction": 0.05}),
        ("slumping", 1e-4, {"turned": 0.6}),
        ("rolling", 0.02, {"turned": 3.0}),
        ("cascading", 0.32, {"turned": 12.0}),
        ("cataracting", 0.7, {"turned": 12.0}),
        ("centrifuging", 3.0, {"turned": 20.0, "friction": 1.5}),
    ],
)
def test_loads_move_as_they_do_at_their_speed(name, froude, how):
    assert regime_at(froude, **how).name == name
