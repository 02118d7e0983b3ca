"""Measures with arguments as targets: mixing of a coloring, visits to a zone; what a run cannot have is refused."""

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import measures
from drumrs.decide import Evaluator, Target, chosen
from drumrs.errors import ConfigError

SPECIES = [
    {"name": "small", "share": 0.5, "diameter": 0.02},
    {"name": "large", "share": 0.5, "diameter": 0.03},
]
# A turn takes 1.5 s.
DRUM = {"run.duration": 2.4, "run.window": [0.4, 2.4], "run.frame_every": 0.02, "rotation.rpm": 40.0}
RIGHT = {"name": "right", "corners": [[0.0, -0.3], [0.3, -0.3], [0.3, 0.3], [0.0, 0.3]]}


@pytest.fixture(scope="module")
def mixed():
    changes = {**DRUM, "load.species": SPECIES, "load.share_by": "mass", "run.zone": [RIGHT]}
    return drumrs.baseline(fill=0.2).softer(100.0).replace(changes)


@pytest.fixture(scope="module")
def result(mixed):
    return drumrs.run(mixed, progress=False)


def test_the_index_of_a_coloring_is_that_of_the_curve_after_so_many_turns(result):
    frames = result.frames
    # From 0.4 to 1.9 s there is one turn, and one start.
    _, curve = measures.mixing_curve(frames, (0.4, 1.91), "side")
    found = chosen.lacey_index(frames, (0.4, 1.91), "side", 1.0)
    assert found.value == pytest.approx(curve[1, -1], rel=1e-9)
    assert curve[1, 0] < 0.3 < found.value
    half = chosen.lacey_index(frames, (0.4, 1.16), "layer", 0.5)
    assert half.value == pytest.approx(
        measures.mixing_curve(frames, (0.4, 1.16), "layer")[1][1, -1], rel=1e-9
    )
    assert chosen.lacey_index(frames, (0.4, 1.8), "side", 1.0) is None


def test_the_index_of_a_species_is_the_mean_of_the_curve(result):
    window = result.config.run.averaging_window
    _, curve = measures.mixing_curve(result.frames, window, "small")
    found = Target.parse("lacey_index(by=small)").mean(result)
    assert found.value == pytest.approx(curve[1].mean(), rel=1e-9)
    assert 0.0 < found.error < 0.2


def test_visits_have_the_means_of_their_sums_and_errors_of_the_scatter_over_discs():
    table = pl.DataFrame(
        {
            "zone": ["right"] * 3 + ["left"] * 3,
            "time_inside": [2.0, 4.0, 3.0, 9.0, 9.0, 9.0],
            "cycles": [2, 4, 3, 9, 9, 9],
            "stay": [2.0, 6.0, 1.0, 9.0, 9.0, 9.0],
            "cycle": [8.0, 16.0, 12.0, 9.0, 9.0, 9.0],
            "stay_squared": [2.0, 9.5, 0.5, 9.0, 9.0, 9.0],
            "cycle_squared": [33.0, 65.0, 49.0, 9.0, 9.0, 9.0],
            "stay_cycle": [8.0, 24.5, 4.0, 9.0, 9.0, 9.0],
        }
    )
    found = chosen.zone(table, "right", 60.0, 10.0)
    # 9 s in 9 visits; discs are off by 0, 2 and −2 s.
    assert (found["zone_residence"].value, found["zone_residence"].error) == pytest.approx(
        (1.0, np.sqrt(1.5 * 8.0) / 9.0)
    )
    assert (found["zone_cycle"].value, found["zone_cycle"].error) == pytest.approx((4.0, 0.0))
    assert (found["zone_share"].value, found["zone_share"].error) == pytest.approx((0.3, 0.1 / np.sqrt(3.0)))
    assert found["zone_spread"].value == pytest.approx(measures.recorded_visits(table, "right").spread(60.0))


def test_a_zone_and_a_coloring_are_asked_for_like_all_else(tmp_path, mixed, result):
    texts = [
        "zone_share(zone=right)",
        "zone_spread(right, time=600)",
        "lacey_index('side') / drum_specific_power",
    ]
    ask = Evaluator(texts, tmp_path, progress=False)
    ((share, spread, mixing),) = ask.means([mixed])
    # Nearly half of the drum, and more than half of the load lie on the side to which it turns.
    assert 0.4 < share.value < 1.0
    assert 0.0 < share.error < 0.1
    visits = measures.recorded_visits(result.zone_visits, "right")
    assert spread.value == pytest.approx(visits.spread(600.0))
    assert mixing.error > 0.0
    assert Target.parse(texts[2]).unit == "kg/W"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "lacey_index(by=ore)",
            r"lacey_index\.by is 'ore', but must be one of side, layer, depth, or a species, small, large",
        ),
        ("zone_share(zone=left)", "run.zone has right, but the target asks for the zone 'left'; add a table"),
        (
            "zone_share(zone=right)[spin]",
            r"zone_share\[spin\] is that of a whole run from the start of run.window on",
        ),
    ],
)
def test_what_a_run_will_not_have_is_refused_before_it_is_run(tmp_path, mixed, text, told):
    with pytest.raises(ConfigError, match=told):
        Evaluator([text], tmp_path / "out", progress=False).means([mixed])
    assert not (tmp_path / "out").exists()


def test_a_load_of_one_kind_has_no_species_and_a_run_without_zones_says_how_to_have_one(tmp_path):
    plain = drumrs.baseline(fill=0.1).replace(DRUM)
    with pytest.raises(ConfigError, match="one of side, layer, depth; the load has one species"):
        Evaluator(["lacey_index(by=bundle)"], tmp_path / "out", progress=False).means([plain])
    with pytest.raises(ConfigError, match=r"run\.zone has no zone, but the target asks for the zone 'spray'"):
        Evaluator(["zone_cycle(spray)"], tmp_path / "out", progress=False).means([plain])
