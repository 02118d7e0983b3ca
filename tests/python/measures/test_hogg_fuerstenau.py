"""Hogg and Fuerstenau's power: the formula of the trade by hand, the geometry it stands for, and its inverse."""

import math

import pytest
from scipy.optimize import brentq

from drumrs.errors import ConfigError
from drumrs.measures import hogg_fuerstenau

GRAVITY = 9.80665


def test_power_is_that_of_the_formula_in_feet_and_tons():
    # 34.26 ft by 17.16 ft at 9.90 rpm, J = 32 %, charge of 3.6993 t/m³, 45°. By hand: 76.6/√34.26 = 13.087 rpm are
    # critical, and 0.238 · 34.26^2.5 · 17.16 · 0.75648 · 3.6993 · (0.32 − 1.065 · 0.32²) · 0.70711 = 11 712 kW.
    radius, length, omega = 0.5 * 34.26 * 0.3048, 17.16 * 0.3048, 9.90 * math.tau / 60.0
    mass = 3699.3 * math.pi * radius**2 * length * 0.32
    power = hogg_fuerstenau.arm(0.32, math.radians(45.0)) * mass * GRAVITY * radius * omega
    # The formula's critical speed, 76.6/√D, is rounded.
    assert power == pytest.approx(11.712e6, rel=1e-3)


@pytest.mark.parametrize("filling", [0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5])
@pytest.mark.parametrize("degrees", [20.0, 35.0, 45.0])
def test_it_is_the_arm_of_a_flat_segment(filling, degrees):
    half = brentq(lambda angle: (angle - math.sin(angle) * math.cos(angle)) / math.pi - filling, 0.0, math.pi)
    flat = 2.0 / 3.0 * math.sin(half) ** 3 * math.sin(math.radians(degrees)) / (math.pi * filling)
    assert hogg_fuerstenau.arm(filling, math.radians(degrees)) == pytest.approx(flat, rel=0.02)


def test_the_lift_angle_is_the_one_that_gives_the_power():
    arm = hogg_fuerstenau.arm(0.27, 0.6)
    assert hogg_fuerstenau.lift_angle(0.27, arm) == pytest.approx(0.6, rel=1e-12)


def test_more_than_a_segment_can_take_is_refused():
    with pytest.raises(ConfigError, match="but must be at most 0"):
        hogg_fuerstenau.lift_angle(0.3, 0.7)
