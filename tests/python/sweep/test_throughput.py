"""The speed of this machine, measured beforehand."""

from drumrs.sweep.throughput import measure_speed


def test_speed_is_measured_in_a_moment():
    assert 1e5 < measure_speed(1) < 1e10
