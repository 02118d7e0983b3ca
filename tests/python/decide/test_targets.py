"""Targets: which quantities a run is asked for, expressions of them, units and errors."""

import math
import re

import pytest

import drumrs
from drumrs import measures
from drumrs.analysis import Mean, student
from drumrs.decide import Evaluator, Target, readings
from drumrs.decide.units import format_unit, parse_unit
from drumrs.errors import ConfigError


class MadeUp(readings.Readings):
    """Means by name that nobody simulated."""

    def __init__(self, **means):
        self._means = means

    def mean(self, name, phase=None, _=()):
        return self._means[name if phase is None else f"{name}_{phase}"]


@pytest.fixture(scope="module")
def result():
    program = [
        {"name": "tumble", "duration": 0.2, "rpm": 54.0},
        {"name": "stop", "duration": 0.1, "rpm": 0.0},
    ]
    changes = {
        "rotation.phase": [{"name": "main", "repeat": 2, "phase": program}],
        "run.duration": 0.6,
        "run.frame_every": 0.01,
    }
    return drumrs.run(drumrs.baseline(fill=0.1, baffles=True).replace(changes), progress=False)


def test_a_quantity_of_the_summary_is_that_of_the_summary(result):
    for name in ("drum_specific_power", "dissipation_ratio", "kinetic_energy", "dissipated_sliding_power"):
        assert Target.parse(name)(result).mean == pytest.approx(getattr(result.summary, name), rel=1e-12)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """The targets of a load that tumbles, in a run that a decision made; and, where those have none, of a deep bed."""
    targets = [name for name in readings.names() if name not in WITHOUT]
    changes = {"run.duration": 2.0, "run.window": [0.4, 2.0], "run.frame_every": 0.01}
    runs = [
        drumrs.baseline(fill, baffles=True).softer(100.0).replace({**changes, "rotation.rpm": rpm})
        for fill, rpm in ((0.3, 40.0), (0.5, 20.0))
    ]
    found, bed = Evaluator(targets, tmp_path_factory.mktemp("recorded"), progress=False).means(runs)
    return dict(zip(targets, found, strict=True)) | {
        name: mean for name, mean in zip(targets, bed, strict=True) if name == "layer_to_solid_rotation"
    }


# What a run without phases and walls does not have.
WITHOUT = {
    "lacey_index": "the target lacey_index lacks by; write lacey_index(by='side')",
    **{
        name: f"the target {name} lacks zone; write {name}(zone='spray')"
        for name in ("zone_residence", "zone_cycle", "zone_share", "zone_spread")
    },
    "phase_work": "is that of a phase; write phase_work[PHASE]",
    "phase_specific_work": "is that of a phase; write phase_specific_work[PHASE]",
    **dict.fromkeys(
        (name for name in readings.names() if name.startswith("wall_1_")),
        "is of a part that the drum of this run does not have (3 baffles)",
    ),
}
# What has no error of its own in one run: greatest values, sums from t = 0 on, and what depends on them.
WITHOUT_ERROR = {
    *("max_overlap_ratio", "torque_peak_factor", "correlation_time"),
    *("archard_wear", "finnie_wear", "wear_peak", "received_spread"),
    *("load_knocking", "load_rubbing", "drum_knocking", "drum_rubbing"),
}


@pytest.mark.parametrize("name", readings.names())
def test_every_target_has_a_value_with_its_error_or_says_why_not(recorded, result, name):
    if name in WITHOUT:
        with pytest.raises(ConfigError, match=re.escape(WITHOUT[name])):
            Target.parse(name)(result)
        return
    assert math.isfinite(recorded[name].value), recorded[name]
    assert (recorded[name].error is None) == (name in WITHOUT_ERROR), recorded[name]


@pytest.mark.parametrize("name", sorted({*drumrs.quantities()["name"]} - {*readings.names()}))
def test_every_other_quantity_says_why_it_is_no_target(name):
    with pytest.raises(ConfigError, match=f"^the target {name} ") as refused:
        Target.parse(name)
    assert "\n" not in str(refused.value)
    assert any(reason in str(refused.value) for reason in REASONS), refused.value


REASONS = (
    "is a column of frames, not a number of a run",
    "is the error of",
    "tells how a run was made or how steady it was, not what it does",
)


def test_phases_add_up_to_the_work_of_the_run(result):
    table = drumrs.phases(result)
    parts = [Target.parse(f"phase_work[{name}]")(result).mean for name in ("tumble", "stop")]
    assert math.fsum(parts) == pytest.approx(table["phase_work"].sum(), rel=1e-12)
    # By number: the third is the second `tumble`.
    third = Target.parse("phase_work[3]")(result).mean
    assert third == pytest.approx(table["phase_work"][2], rel=1e-12)


def test_a_mean_over_a_phase_that_comes_twice_is_over_both(result):
    table = drumrs.phases(result).filter(phase="tumble")
    found = Target.parse('drum_power["tumble"]')(result).mean
    assert found == pytest.approx(table["drum_power"].mean(), rel=1e-9)


def test_an_expression_has_the_value_of_its_parts():
    made = MadeUp(drum_power=Mean(6.0, 0.3), load_mass=Mean(2.0, 0.0), arm=Mean(0.5, 0.1))
    target = Target.parse(
        "-(drum_power / load_mass - 1 * drum_power/load_mass) + 2 * drum_power * arm**2 / load_mass"
    )
    assert target.mean(made).value == pytest.approx(1.5)
    assert target.unit == "W/kg"


def test_errors_within_a_run_are_added():
    made = MadeUp(drum_power=Mean(6.0, 0.3), normal_power=Mean(3.0, 0.3))
    # d(a/b) = da/b + a db/b²: 0.1 + 0.2 to first order.
    found = Target.parse("drum_power / normal_power").mean(made)
    assert found.error == pytest.approx(0.3, rel=0.02)


def test_a_quantity_over_itself_is_sure():
    found = Target.parse("drum_power / drum_power").mean(MadeUp(drum_power=Mean(6.0, 0.3)))
    assert (found.value, found.error) == (1.0, 0.0)


def test_seeds_tell_an_expression_by_their_scatter_alone():
    means = [Mean(1.0, 5.0), Mean(1.2, 5.0), Mean(0.9, 5.0)]
    ratio = Target.parse("drum_power / load_mass").of_seeds(means)
    expected = student([1.0, 1.2, 0.9])
    assert ratio.interval().half_width == pytest.approx(expected.half_width)
    assert Target.parse("drum_power").of_seeds(means).error > 2.0


def test_runs_without_a_value_are_left_out():
    target = Target.parse("mean_drop")
    nothing = target.of_seeds([Mean(math.nan, None)])
    assert math.isnan(nothing.mean)
    assert nothing.error == math.inf
    assert target.of_seeds([Mean(math.nan, None), Mean(0.1, 0.01)]).mean == 0.1
    divided = Target.parse("drum_power / mean_drop").mean(
        MadeUp(drum_power=Mean(1.0, 0.1), mean_drop=Mean(0.0, None))
    )
    assert math.isnan(divided.value)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("drum_power", "W/m"),
        ("drum_power * mean_drop", "W"),
        ("drum_specific_power * load_mass", "W/m"),
        ("sqrt(mean_drop**2)", "m"),
        ("specific_angular_momentum / eccentricity", "m/s"),
        ("drum_power / drum_power + log(arm)", "1"),
        ("1 / disc_turning", "s/rad"),
    ],
)
def test_units_follow_from_those_of_the_quantities(text, unit):
    assert Target.parse(text).unit == unit


def test_every_unit_of_the_registry_is_read_and_written_back():
    for name in readings.names():
        unit = drumrs.quantity(name).unit
        assert format_unit(parse_unit(unit)) in {unit, "kg m/s", "N"}, name


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("specific_power", "did you mean drum_specific_power"),
        ("fals_per_turn", "did you mean falls_per_turn?"),
        ("x", "is a column of frames, not a number of a run"),
        ("drum_power + mean_drop", "adds W/m and m"),
        ("log(drum_power)", "in W/m"),
        ("mean_drop ** arm", "an expression of names"),
        ("__import__('os').system('true')", "an expression of names"),
        ("drum_power.real", "an expression of names"),
        ("[drum_power]", "an expression of names"),
        ("drum_power if arm else 1", "an expression of names"),
        ("sin(arm)", "the target sin is not the name of a quantity"),
        ("drum_power(by='side')", "drum_power has the argument by, but takes no arguments"),
        ("lacey_index(color='side')", "has the argument color, but may have by and turns only, each once"),
        ("lacey_index('side', by='layer')", "has the argument by, but may have by and turns only, each once"),
        ("lacey_index(side, 1, 2)", "has 3 arguments, but may have by and turns only"),
        ("lacey_index(by=side, turns=-1)", "an expression of names"),
        (
            "lacey_index(by=side, turns=0)",
            "turns of the target lacey_index is 0, but must be a positive number",
        ),
        ("lacey_index(by=side, turns=many)", "is 'many', but must be a positive number"),
        ("lacey_index(**arm)", "an expression of names"),
        ("sqrt(arm, x=1)", "an expression of names"),
        ("drum_power /", "an expression of names"),
        ("2 * 3", "at least one quantity"),
        ("", "an expression of names"),
        ("-" * 400 + "drum_power", "an expression of names"),
    ],
)
def test_what_is_no_target_is_refused_in_a_sentence(text, told):
    with pytest.raises(ConfigError, match="target") as refused:
        Target.parse(text)
    assert told in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_phase_that_is_not_there_is_named(result):
    with pytest.raises(ConfigError, match="must be in a phase that the run has gone through: tumble, stop"):
        Target.parse("drum_power[spin]")(result)
    with pytest.raises(ConfigError, match=r"write phase_work\[PHASE\]"):
        Target.parse("phase_work")(result)


def test_a_record_that_is_missing_is_named(result):
    for name in ("gross_work_ratio", "gross_work_normal"):
        with pytest.raises(ConfigError, match=f"run.record lacks 'gross_work', which {name} is made of"):
            Target.parse(name)(result)


def test_a_target_says_what_it_needs():
    assert Target.parse("gross_work_ratio + arm").records == ("gross_work",)
    assert Target.parse("gross_work_ratio + arm").needs_frames
    assert not Target.parse("drum_power").needs_frames


def test_a_function_of_ones_own_is_a_target_with_the_record_that_it_needs(tmp_path):
    def hits(run):
        return measures.collision_spectrum(run.contacts, 1.0, 1.0)["events"].sum()

    target = Target.of("hits", hits, "1/(kg s)", record=["contacts"], needs_frames=True)
    assert (str(target), target.label, target.records) == ("hits", "hits [1/(kg s)]", ("contacts",))
    config = drumrs.baseline(fill=0.1).softer(100.0).replace({"run.duration": 0.3, "run.frame_every": 0.1})
    ((found,),) = Evaluator([target], tmp_path, progress=False).means([config])
    result = drumrs.run(config.replace({"run.record": ["contacts"]}), progress=False)
    assert (found.value, found.error) == (hits(result), None)
    with pytest.raises(ConfigError, match=r"run\.frame_every .* hits is measured on frames"):
        Evaluator([target], tmp_path, progress=False).case(config.replace({"run.frame_every": 1.0}))
    for name in ("two words", "arm"):
        with pytest.raises(ConfigError, match="name of a target"):
            Target.of(name, hits)
    assert math.isnan(Target.of("none", lambda _: None).mean(result).value)
    assert Target.of("mean", lambda _: Mean(1.0, 0.5)).mean(result) == Mean(1.0, 0.5)


def test_a_record_that_covers_the_whole_run_is_not_that_of_a_phase(result):
    config = result.config.replace({"run.record": ["wall_profile"]})
    worn = drumrs.run(config, progress=False)
    assert Target.parse("rim_archard_wear + 0 * baffle_2_archard_wear")(worn).mean > 0.0
    with pytest.raises(ConfigError, match=r"archard_wear\[tumble\] is that of a whole run from t = 0 on"):
        Target.parse("archard_wear[tumble]")(worn)
    with pytest.raises(ConfigError, match="is of a part that the drum of this run does not have"):
        Target.parse("rail_9_archard_wear")(worn)


def test_overlap_and_size_are_those_of_one_size_and_linear_springs():
    config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.2})
    species = [
        {"name": "small", "share": 0.5, "diameter": 0.02},
        {"name": "large", "share": 0.5, "diameter": 0.03},
    ]
    mixed = drumrs.run(config.replace({"load.species": species, "load.share_by": "mass"}), progress=False)
    modulus = {f"contact.{one}.young_modulus": 1e6 for one in ("bundle", "drum")}
    hertz = drumrs.run(config.replace({"contact.base": "hertz", **modulus}), progress=False)
    for name in ("size_ratio", "mean_overlap_ratio"):
        with pytest.raises(ConfigError, match=f"the target {name} is that of a load of one size"):
            Target.parse(name)(mixed)
    with pytest.raises(ConfigError, match="follows from the energy in linear springs"):
        Target.parse("mean_overlap_ratio")(hertz)
    assert Target.parse("size_ratio")(hertz).mean == pytest.approx(20.0)


@pytest.mark.parametrize(
    ("target", "changes", "told"),
    [
        (
            "falls_per_turn",
            {"run.frame_every": 0.12},
            "run.frame_every is 0.12, but must be small enough for two",
        ),
        (
            "falls_per_turn",
            {"run.frame_every": 1.0},
            "run.frame_every is 1.0, but must be smaller than run.duration",
        ),
        ("baffle_4_torque", {}, "is of a part that the drum of this run does not have (3 baffles)"),
        ("baffle_1_impact_rate", {"drum.baffles.count": 0}, "does not have (no baffles)"),
        ("rail_1_work", {}, "is of a part that the drum of this run does not have"),
        ("drum_power[spin]", {}, "is that of a phase, but the run has no rotation.phase"),
        ("wear_peak[spin]", {}, "is that of a whole run from t = 0 on, not of a phase"),
        ("phase_work", {}, "is that of a phase; write phase_work[PHASE]"),
    ],
)
def test_what_a_run_will_not_have_is_refused_before_it_is_run(tmp_path, target, changes, told):
    config = drumrs.baseline(fill=0.1, baffles=True).replace({"run.duration": 0.4, **changes})
    with pytest.raises(ConfigError, match=re.escape(told)):
        Evaluator([target], tmp_path / "runs", progress=False).means([config])
    assert not (tmp_path / "runs").exists()


def test_two_frames_are_enough_and_names_that_are_no_parts_of_a_kind_are_left_to_the_run(tmp_path):
    ask = Evaluator(["falls_per_turn", "lid_1_work"], tmp_path, progress=False)
    config = drumrs.baseline(fill=0.1).replace({"run.duration": 0.3, "run.frame_every": 0.1})
    assert ask.case(config).wants_frames
