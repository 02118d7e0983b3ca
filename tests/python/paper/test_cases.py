"""The cases of the study: complete, each once, within the budget, and able to start."""

import math
import sys

import pytest

import drumrs
from drumrs import paper
from drumrs.errors import ConfigError
from drumrs.paper.cases import TIME_STEP, WATCHED_FILLS
from drumrs.paper.drums import TRIANGLES, Drum


def points(scale: str) -> list[drumrs.Config]:
    """Return the cases of the first seed."""
    return [config for config in paper.cases(scale) if config.run.seed == 1]


@pytest.mark.parametrize("scale", paper.SCALES)
def test_every_case_comes_once_and_with_every_seed(scale):
    found = paper.cases(scale)
    assert len({config.digest for config in found}) == len(found)
    scale = paper.SCALES[scale]
    seeds: dict[str, set[int]] = {}
    for config in found:
        seeds.setdefault(config.replace({"run.seed": 1}).digest, set()).add(config.run.seed)
    assert {tuple(sorted(of)) for of in seeds.values()} == {scale.seeds, tuple(range(1, 11))}


def test_few_bundles_and_the_ends_of_the_frictions_have_more_seeds():
    default = paper.SCALES["default"]
    more = [c for c in paper.cases("default") if (c.run.seed, c.run.duration) == (10, default.end_duration)]
    kinds = [(c.bundle_count, c.contact.drum.friction, c.drum.baffles.count) for c in more]
    assert sorted(kinds) == [
        (40, 0.5, 0),
        (40, 0.5, 0),
        (40, 0.5, 3),
        (40, 0.5, 3),
        (100, 0.3, 0),
        (100, 1.0, 0),
    ]


@pytest.mark.parametrize("scale", paper.SCALES)
def test_the_baseline_is_among_them(scale):
    for baffles in (False, True):
        like = drumrs.baseline(0.25, baffles=baffles)
        same = [config for config in points(scale) if config.replace({"run": like.run.model_dump()}) == like]
        assert len(same) == 1


def test_the_default_is_the_papers_protocol():
    found = paper.cases("default")
    assert {(config.run.duration, config.run.window) for config in found} == {
        (30.0, (20.0, 30.0)),
        (120.0, (20.0, 120.0)),
    }
    assert {config.load.fill for config in found if config.run.duration == 120.0} == {0.45, 0.50, 0.55}
    for baffles, highest in ((0, 0.80), (3, 0.75)):
        fills = {c.load.fill for c in found if c.drum.baffles.count == baffles and c.load.diameter == 0.02375}
        assert (min(fills), max(fills)) == (0.10, highest)
        assert len({fill for fill in fills if 0.40 <= fill <= 0.50}) >= 5


def test_the_time_step_follows_the_contact_time():
    steps = {
        round(0.475 / config.load.diameter, 6): config.run.time_step for config in paper.cases("default")
    }
    assert (min(steps), max(steps)) == (10.0, 37.0)
    assert steps[20.0] == TIME_STEP
    for ratio, step in steps.items():
        assert step == pytest.approx(TIME_STEP * 20.0 / ratio)
    # The core knows the contact times.
    for ratio in (10.0, 37.0):
        config = next(c for c in paper.cases("default") if math.isclose(c.load.diameter, 0.475 / ratio))
        simulation = drumrs.Simulation(config)
        assert simulation.collision_time["bundle"] / simulation.time_step == pytest.approx(51.5, abs=0.1)


@pytest.mark.parametrize("scale", ["quick", "default"])
def test_budget(scale):
    most = {"quick": 1.7e10, "default": 8.5e11}[scale]
    assert 0.8 * most < paper.cost(paper.cases(scale)) < most


def test_the_densest_cases_start():
    densest = [config for config in points("default") if config.load.fill >= 0.75]
    assert {config.bundle_count for config in densest} == {300, 320}
    for config in {c.load.fill + c.drum.baffles.count: c for c in densest}.values():
        assert drumrs.Simulation(config).count == config.bundle_count


def test_motion_is_kept_where_it_is_looked_at():
    for scale in paper.SCALES:
        dense = [config for config in paper.cases(scale) if config.run.frame_every < 1.0]
        assert {(c.load.fill, c.drum.baffles.count) for c in dense} == {
            (f, n) for f in WATCHED_FILLS for n in (0, 3)
        }
        seeds, half_full = (
            len(of) for of in (paper.SCALES[scale].seeds, paper.SCALES[scale].half_full_seeds)
        )
        # The bare drum at 50 % is one that is run for longer.
        longer = half_full - seeds if half_full else 0
        drums = 3 if paper.SCALES[scale].fills_with_triangles else 2
        assert len(dense) == drums * len(WATCHED_FILLS) * seeds + longer


def test_cost_is_bundles_times_steps():
    config = drumrs.baseline(0.25).replace({"run.duration": 37.0e-6})
    assert paper.cost([config, config]) == 2 * 100 * 10


def test_cheaper_runs_are_those_of_the_scale():
    quick = paper.SCALES["quick"]
    for config in paper.cases("quick"):
        soft = config.contact.bundle.normal_stiffness < 1e7
        scale = quick.beside if soft else quick
        assert config.run.duration in (scale.duration, scale.end_duration)
        assert config.contact.drum.normal_stiffness == pytest.approx(9.7e7 / scale.softer)
        own = TIME_STEP * 20.0 * config.load.diameter / 0.475
        assert config.run.time_step == pytest.approx(own * scale.coarser * math.sqrt(scale.softer))
    durations = {quick.duration, quick.beside.duration, quick.beside.end_duration}
    assert {config.run.duration for config in paper.cases("quick")} == durations
    assert all(config.contact.bundle.normal_stiffness > 1e7 for config in paper.cases("default"))


def test_triangles_are_cases_of_their_own_where_the_baffles_are_others(monkeypatch):
    washer = Drum("with baffles", {**TRIANGLES.changes, "drum.baffles.height": 0.035})
    # The function of that name hides the module.
    module = sys.modules["drumrs.paper.cases"]
    monkeypatch.setattr(module, "BAFFLED", TRIANGLES)
    alone = len(paper.cases("default"))
    monkeypatch.setattr(module, "BAFFLED", washer)
    default = paper.SCALES["default"]
    more = len(default.fills_with_triangles) + len(default.sizes_with_triangles) - 1
    assert len(paper.cases("default")) == alone + more * len(default.seeds)


def test_gross_work_is_recorded():
    assert {config.run.record for config in paper.cases("quick")} == {("gross_work",)}


def test_unknown_scale():
    with pytest.raises(ConfigError, match="scale is 'large', but must be 'quick', 'default' or 'full'"):
        paper.cases("large")
