"""Configurations that nobody should write, and what has to become of them: an error of ours, or a simulation."""

import json
import math
import warnings
from collections.abc import Iterator
from typing import Any

from hypothesis import strategies as st

import drumrs
from drumrs.config import Config
from drumrs.config.messages import dotted_keys
from drumrs.config.toml_writer import toml_item
from drumrs.errors import ConfigError, DrumrsWarning, UnstableError

KEYS = sorted(dotted_keys(Config))
# More bundles are a large simulation, not a strange one.
MOST_BUNDLES = 2000

VALID: dict[str, Any] = {
    "drum.diameter": 0.475,
    "drum.rim": True,
    "drum.walls": [[[-0.1, 0.0], [0.0, 0.05], [0.1, 0.0]]],
    "drum.baffles.count": 3,
    "drum.baffles.shape": "triangle",
    "drum.baffles.height": 0.05,
    "drum.baffles.base": 0.06,
    "drum.baffles.tip": 0.02,
    "drum.baffles.points": [[0.0, -0.03], [0.05, 0.0], [0.0, 0.03]],
    "drum.baffles.phase": 10.0,
    "drum.baffles.corner_radius": 0.001,
    "drum.liner.repeat": 3,
    "drum.liner.outlines": [{"name": "low", "points": [[0.0, 0.22], [0.005, 0.25], [-0.005, 0.25]]}],
    "drum.liner.rail.face_angle": 20.0,
    "rotation.rpm": 54.0,
    "load.diameter": 0.02375,
    "load.density": 1000.0,
    "load.fill": 0.1,
    "load.start_speed": 0.5,
    "load.spin_locked": False,
    "load.species": [
        {"name": "steel", "share": 0.5, "density": 7800.0, "diameter": 0.02, "contact": {"friction": 0.1}},
        {"name": "ore", "share": 0.5, "sizes": {"law": "normal", "by": "mass", "mean": 0.02, "sigma": 1e-3}},
    ],
    "load.share_by": "mass",
    "load.moisture": 0.1,
    "contact.pair": [
        {"between": ["steel", "ore"], "friction": 0.3},
        {"between": ["ore", "drum"], "normal_damping": 4e3},
    ],
    "contact.bundle.normal_stiffness": 9.25e7,
    "contact.bundle.stiffness_ratio": 1.0,
    "contact.bundle.restitution": 0.1,
    "contact.bundle.friction": 0.5,
    "contact.bundle.tension": "allowed",
    "contact.drum.normal_damping": 5e3,
    "contact.drum.friction": 0.5,
    "gravity": [0.0, -9.81],
    "run.time_step": 3.7e-6,
    "run.duration": 0.05,
    "run.sample_every": 0.001,
    "run.frame_every": 0.01,
    "run.checkpoint_every": 60.0,
    "run.seed": 1,
    "run.skin": "auto",
    "run.overlap_limit": 0.5,
}
OTHERS = {
    "rotation.program": [[0.0, 0.0], [0.01, 54.0], [0.02, -54.0]],
    "load.count": 20,
    "load.bulk_fill": 0.1,
    "contact.bundle.normal_damping": 5e3,
    "contact.drum.restitution": 0.4,
}

numbers = st.one_of(
    st.sampled_from(
        [0, -1, 1, 2, 10**12, 2**63, 10**400, -(10**400), 0.0, -0.0, 5e-324, 1e-300, 1e-160, 1e-12]
    ),
    st.sampled_from([1e-9, 1e-3, 1e3, 1e9, 1e12, 1e154, 1e300, 1.7e308, math.inf, -math.inf, math.nan]),
    st.floats(),
    st.floats(min_value=1e-12, max_value=1e12),
    st.integers(min_value=-(10**13), max_value=10**13),
)
magnitudes = st.floats(-320.0, 308.0).map(lambda power: 10.0**power)
words = st.one_of(
    st.sampled_from(["auto", "triangle", "polygon", "clipped", "", "nan", "1e5"]), st.text(max_size=8)
)
leaves = st.one_of(numbers, words, st.booleans(), st.none())
pairs = st.lists(st.one_of(numbers, st.floats(min_value=-0.3, max_value=0.3)), min_size=2, max_size=2)
lists = st.one_of(
    st.lists(pairs, max_size=8),
    st.lists(leaves, max_size=4),
    st.lists(st.lists(pairs, max_size=5), max_size=3),
)
names = st.one_of(st.sampled_from([part for key in KEYS for part in key.split(".")]), st.text(max_size=6))
documents = st.recursive(
    st.one_of(leaves, lists), lambda inner: st.dictionaries(names, inner, max_size=5), max_leaves=12
)


@st.composite
def mutations(draw: st.DrawFn) -> dict[str, Any]:
    """Return a valid layer of dotted keys, of which some are missing and some hold something else."""
    layer = {key: value for key, value in VALID.items() if draw(st.integers(0, 9)) > 1}
    for key in draw(st.lists(st.sampled_from(sorted(OTHERS)), max_size=1)):
        other = {
            "program": "rpm",
            "count": "fill",
            "bulk_fill": "fill",
            "normal_damping": "restitution",
            "restitution": "normal_damping",
        }
        table, _, name = key.rpartition(".")
        layer.pop(f"{table}.{other[name]}", None)
        layer[key] = OTHERS[key]
    for _ in range(draw(st.sampled_from([1, 1, 2, 3]))):
        key = draw(st.one_of(st.sampled_from(sorted(VALID)), st.sampled_from(KEYS)))
        own = scaled(layer.get(key))
        layer[key] = draw(st.one_of(own, own, magnitudes, numbers, lists, documents))
    return layer


def scaled(value: Any) -> st.SearchStrategy[Any]:
    """Return a number times some power of ten; anything else as it is."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return st.just(value)
    return st.integers(-30, 30).map(lambda power: _times(value, power))


def toml(value: Any, at: str = "") -> Iterator[str]:
    """Write nested tables as lines of TOML with dotted keys; what TOML has no word for is left out."""
    for key, inner in value.items():
        name = f"{at}{json.dumps(key)}"
        if isinstance(inner, dict):
            yield from toml(inner, f"{name}.")
        else:
            try:
                yield f"{name} = {toml_value(inner)}"
            except TypeError:
                continue


def toml_value(value: Any) -> str:
    if value is None or isinstance(value, dict):
        raise TypeError
    if isinstance(value, list):
        return f"[{', '.join(toml_value(inner) for inner in value)}]"
    return repr(value) if isinstance(value, float) else toml_item(value).as_string()


def outcome(text: str, read: Any, steps: int = 20) -> str:
    """Read a document, simulate it where it is a simulation; return what became of it in a word."""
    try:
        config = read(text)
    except ConfigError as error:
        one_sentence(error)
        return "refused"
    # What a user may ask of any configuration.
    assert config.digest
    assert config.title
    assert read is not Config.from_toml or Config.from_toml(config.to_toml()) == config
    assert Config.from_json(config.to_json()) == config
    if config.bundle_count > MOST_BUNDLES:
        return "large"
    try:
        # Most of such values seem to be in another unit.
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DrumrsWarning)
            simulation = drumrs.Simulation(config)
    except (ConfigError, UnstableError) as error:
        one_sentence(error)
        return "refused by the core"
    try:
        simulation.run(steps=steps)
    except UnstableError as error:
        one_sentence(error)
        return "unstable"
    assert simulation.step == steps
    return "valid"


def one_sentence(error: Exception) -> None:
    told = str(error)
    assert told
    assert "\n" not in told
    assert len(told) < 1000


def _times(value: float, power: int) -> float:
    try:
        return value * 10.0**power
    except OverflowError:
        return math.inf
