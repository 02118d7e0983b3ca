"""Configurations: every key survives TOML and JSON, copies are validated, the core gets what it needs."""

import json
import math
import tomllib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import BaseModel

import drumrs
from drumrs.config import Config, Outline, PairContact, Phase, Sizes, Species
from drumrs.config.messages import dotted_keys, table_type
from drumrs.config.tables import Zone
from drumrs.errors import ConfigError

positive = st.floats(1e-300, 1e300)
non_negative = st.floats(0.0, 1e300)
real = st.floats(allow_nan=False, allow_infinity=False)
point = st.tuples(real, real)
tension = st.sampled_from(["allowed", "clipped"])


def knots(times):
    return tuple((time, 10.0 * time - 3.0) for time in sorted(times))


contact_keys = {
    "normal_stiffness": positive,
    "stiffness_ratio": positive,
    "restitution": st.floats(0.001, 1.0),
    "friction": non_negative,
    "young_modulus": positive,
    "poisson_ratio": st.floats(0.0, 0.5),
    "tension": tension,
    "rolling_friction": non_negative,
    "tangential_damping_ratio": non_negative,
    "adhesion": non_negative,
}
pair_law = st.fixed_dictionaries({"between": st.just(("steel", "drum"))}, optional=contact_keys)
STEEL = ({"name": "steel"},)
sizes = st.just(Sizes(law="normal", by="mass", mean=0.02, sigma=1e-3)) | st.just(
    Sizes(law="table", by="number", diameters=(0.01, 0.02), passing=(0.0, 1.0))
)
species = st.fixed_dictionaries(
    {"name": st.just("ore")},
    optional={
        "density": positive,
        "sizes": sizes,
        "contact": st.fixed_dictionaries({}, optional=contact_keys),
    },
)

# What a key needs beside it.
BESIDE = {
    "load.mass": {"drum.depth": 0.3},
    "load.solid_fraction": {"load.bulk_fill": 0.3},
    "contact.pair": {"load.species": STEEL},
}

beside_the_axis = st.lists(st.tuples(st.floats(0.1, 9.0), real), min_size=3, max_size=6).map(tuple)

# Keys that a file is read by; then they are gone: test_drum.py.
READ = {"drum.liner.file", "drum.liner.units"}

zone = st.fixed_dictionaries(
    {
        "name": st.text("ab c", min_size=1, max_size=4),
        "corners": st.lists(st.tuples(real, real), min_size=3, max_size=5),
        "frame": st.sampled_from(["laboratory", "drum"]),
    }
)
phase = st.recursive(
    st.fixed_dictionaries(
        {"duration": positive}, optional={"name": st.text("ab c", min_size=1, max_size=4)}
    ).flatmap(lambda keys: real.map(lambda rpm: {**keys, "rpm": rpm})),
    lambda inner: st.fixed_dictionaries(
        {"phase": st.lists(inner, min_size=1, max_size=2).map(tuple)},
        optional={"repeat": st.integers(1, 9), "reversing": st.booleans()},
    ),
    max_leaves=4,
)

# A strategy for every other key. Keys whose limits depend on others have values that suit the baseline.
VALUES = {
    "drum.diameter": st.floats(0.2, 2.0),
    "drum.depth": positive,
    "drum.rim": st.booleans(),
    "drum.tilt": st.floats(-89.0, 89.0),
    "drum.walls": st.lists(st.lists(point, min_size=2, max_size=4).map(tuple), max_size=3).map(tuple),
    "drum.baffles.count": st.just(0),
    "drum.baffles.shape": st.sampled_from(["triangle", "trapezoid"]),
    "drum.baffles.height": positive,
    "drum.baffles.base": positive,
    "drum.baffles.tip": non_negative,
    "drum.baffles.points": st.lists(point, min_size=3, max_size=6).map(tuple),
    "drum.baffles.phase": real,
    "drum.baffles.corner_radius": non_negative,
    "drum.liner.repeat": st.integers(1, 1000),
    "drum.liner.scale": st.just(1.0),
    "drum.liner.mirror": st.just(value=False),
    "drum.liner.outlines": st.lists(st.builds(Outline, points=beside_the_axis), max_size=3).map(tuple),
    "drum.liner.rail.count": st.integers(0, 1000),
    "drum.liner.rail.height": st.floats(0.001, 0.2),
    "drum.liner.rail.width": st.floats(0.001, 0.19),
    "drum.liner.rail.face_angle": st.floats(0.0, 89.0),
    "drum.liner.rail.back_angle": st.floats(0.0, 89.0),
    "drum.liner.rail.phase": real,
    "rotation.rpm": real,
    "rotation.phase": st.lists(phase.map(lambda keys: Phase(**keys)), min_size=1, max_size=3).map(tuple),
    "rotation.program": st.sets(st.floats(0.0, 1e6), min_size=1, max_size=5).map(knots),
    "load.diameter": st.floats(0.005, 0.05),
    "load.density": positive,
    "load.fill": st.floats(0.1, 0.8),
    "load.count": st.integers(1, 1000),
    "load.bulk_fill": st.floats(0.1, 0.8),
    "load.solid_fraction": st.floats(0.5, 0.9),
    "load.mass": st.floats(1.0, 1000.0),
    "load.moisture": st.floats(0.0, 5.0),
    "load.share_by": st.sampled_from(["mass", "area", "number"]),
    "load.species": st.tuples(species.map(lambda own: Species(**own))),
    "load.start_speed": non_negative,
    "load.spin_locked": st.booleans(),
    "contact.base": st.sampled_from(["linear", "hertz"]),
    "contact.pair": st.tuples(pair_law.map(lambda law: PairContact(**law))),
    "gravity": point,
    "run.time_step": positive | st.just("auto"),
    "run.duration": st.floats(30.0, 1e6),
    "run.window": st.just((10.0, 20.0)),
    "run.sample_every": positive,
    "run.frame_every": positive,
    "run.checkpoint_every": positive,
    "run.seed": st.integers(0, 2**63 - 1),
    "run.skin": non_negative | st.just("auto"),
    "run.record": st.sampled_from([(), ("gross_work",), ("contacts", "discs")]),
    "run.contact_floor": non_negative,
    "run.arc_bin": positive,
    "run.cell": positive,
    "run.zone": st.lists(zone.map(lambda keys: Zone(**keys)), min_size=1, max_size=2).map(tuple),
    "run.overlap_limit": st.floats(0.01, 0.99),
} | {
    f"contact.{kind}.{key}": strategy
    for kind in ("bundle", "drum")
    for key, strategy in {**contact_keys, "normal_damping": non_negative}.items()
}


def value_at(config: BaseModel, key: str):
    for name in key.split("."):
        config = getattr(config, name)
    return config


def test_every_key_has_a_strategy():
    tables = {key for key in dotted_keys(Config) if _is_table(key)}
    assert set(dotted_keys(Config)) - tables == set(VALUES) | READ


def _is_table(key: str) -> bool:
    model = Config
    for name in key.split("."):
        model = table_type(model, name)
        if model is None:
            return False
    return True


@pytest.mark.parametrize("key", sorted(VALUES))
# Sixty keys take the same way: some values of each say as much as a hundred.
@settings(max_examples=20)
@given(data=st.data())
def test_key_survives_toml_and_json(key, data):
    value = data.draw(VALUES[key])
    config = drumrs.baseline().replace({**BESIDE.get(key, {}), key: value})
    assert value_at(config, key) == value
    for comments in (True, False):
        again = Config.from_toml(config.to_toml(comments=comments))
        assert again == config
        assert again.digest == config.digest
    assert Config.from_json(config.to_json()) == config


@pytest.mark.parametrize("baffles", [False, True])
def test_baseline_is_table_1(baffles):
    config = drumrs.baseline(0.4, baffles=baffles)
    assert config.bundle_count == 160
    assert config.drum.baffles.count == (3 if baffles else 0)
    assert config.run.averaging_window == (20.0, 30.0)
    assert config.contact.bundle.normal_stiffness == 9.25e7
    assert config.contact.drum.normal_stiffness == 9.70e7


def test_core_json_holds_si_units():
    config = drumrs.baseline(baffles=True).replace({"drum.baffles.phase": 90.0, "run.time_step": "auto"})
    core = json.loads(config.to_core_json())
    assert core["drum"]["radius"] == 0.2375
    assert core["drum"]["baffles"][0]["phase"] == math.pi / 2
    assert core["rotation"]["knots"] == [[0.0, pytest.approx(5.6548667764616276, rel=1e-15)]]
    assert core["load"]["count"] == 100
    assert core["run"]["time_step"] is None
    assert core["contact"]["bundle"]["normal_damping"] is None


def test_replace_leaves_the_original_alone():
    config = drumrs.baseline()
    changed = config.replace({"contact.bundle.friction": 0.3})
    assert (config.contact.bundle.friction, changed.contact.bundle.friction) == (0.5, 0.3)
    with pytest.raises(ConfigError, match="a configuration does not change"):
        config.load.fill = 0.3


def test_numpy_values_are_taken():
    config = drumrs.baseline().replace({"load.count": np.int64(7), "gravity": np.array([0.0, -1.0])})
    assert config.load.count == 7
    assert config.gravity == (0.0, -1.0)


def test_window_follows_the_duration():
    assert drumrs.baseline().replace({"run.duration": 3.0}).run.averaging_window == (2.0, 3.0)


def test_equal_values_have_equal_digests():
    one = drumrs.baseline().replace({"run.duration": 15})
    assert one.digest == drumrs.baseline().replace({"run.duration": 15.0}).digest
    assert one.digest != drumrs.baseline().digest


def test_documented_toml_names_every_key():
    text = drumrs.baseline().to_toml()
    assert Config.from_toml(text) == drumrs.baseline()
    # With the comment signs of unset keys taken away, each key stands there.
    for key in VALUES:
        assert f"{key.rpartition('.')[2]} = " in text
    assert tomllib.loads(text)["run"]["time_step"] == 3.7e-6


def test_constructor_by_hand_raises_one_sentence():
    with pytest.raises(
        ConfigError,
        match=r"^load\.fill is missing, but must be given, or load\.count or load\.bulk_fill or load\.mass instead",
    ):
        Config(load={"diameter": 0.02})
    with pytest.raises(
        ConfigError, match=r"restitution is missing, but must be given, or contact\.bundle\.normal_damping"
    ):
        Config(contact={"bundle": {"normal_stiffness": 1e6}})
    with pytest.raises(
        ConfigError, match=r"^rotation\.rpm is missing, but must be given, or rotation\.program"
    ):
        Config.model_validate({"rotation": {}})
