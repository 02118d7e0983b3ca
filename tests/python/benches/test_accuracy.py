"""The settings of which accuracy and cost are compared, and their table."""

import pytest

import accuracy
import drumrs
from drumrs.analysis import Estimate


@pytest.mark.parametrize("setting", list(accuracy.settings()))
def test_a_collision_takes_the_steps_that_are_said(setting):
    simulation = drumrs.Simulation(setting.config(seed=1))
    assert simulation.collision_time["bundle"] / simulation.time_step == pytest.approx(setting.steps)
    assert simulation.config.contact.drum.normal_stiffness == pytest.approx(9.7e7 / setting.softer)


def test_the_page_takes_the_table():
    entry = {"baffles": False, "steps_per_collision": 50.0, "softer": 10.0, "seconds": 0.25}
    entry |= {
        "power": Estimate(4.1, 0.05, 3),
        "ratio": Estimate(1.2, 0.01, 3),
        "gross_ratio": Estimate(1.4, 0.02, 3),
    }
    lines = accuracy.lines_of([entry | {"numerical_share": 0.001, "max_overlap_ratio": 0.02}])
    told = "4.100 ± 0.050 | 1.200 ± 0.010 | 1.400 ± 0.020 | +0.10 % | 2.0 % of r | 0.25"
    assert lines[-1] == f"| bare | 50 | 10 | {told} |"
    page = "before\n<!-- table -->\nold\n<!-- end of table -->\nafter\n"
    put = accuracy.TABLE.sub("\\g<1>new\n\\g<2>", page)
    assert put == "before\n<!-- table -->\nnew\n<!-- end of table -->\nafter\n"
