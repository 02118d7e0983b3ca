"""Layers: the upper one wins, and one of an either–or pair takes the place of the other."""

import pytest

import drumrs
from drumrs.config import Config, nest, parse_settings
from drumrs.errors import ConfigError

PAIRS = {
    "load": ("fill", 0.3, "count", 50),
    "rotation": ("rpm", 40.0, "program", ((0.0, 10.0), (5.0, -10.0))),
    "contact.bundle": ("restitution", 0.5, "normal_damping", 100.0),
    "contact.drum": ("restitution", 0.5, "normal_damping", 100.0),
}


def table(config: Config, path: str):
    for name in path.split("."):
        config = getattr(config, name)
    return config


@pytest.mark.parametrize("path", PAIRS)
def test_one_of_a_pair_takes_the_place_of_the_other(path):
    first, one, second, other = PAIRS[path]
    config = drumrs.baseline().replace({f"{path}.{second}": other})
    assert (getattr(table(config, path), first), getattr(table(config, path), second)) == (None, other)
    config = config.replace({f"{path}.{first}": one})
    assert (getattr(table(config, path), first), getattr(table(config, path), second)) == (one, None)


@pytest.mark.parametrize("path", PAIRS)
def test_both_of_a_pair_in_one_layer_are_refused(path):
    first, one, second, other = PAIRS[path]
    with pytest.raises(ConfigError, match=rf"^{path}\.{first} and {path}\.{second} are both given"):
        drumrs.baseline().replace({f"{path}.{first}": one, f"{path}.{second}": other})


@pytest.mark.parametrize("path", PAIRS)
def test_neither_of_a_pair_is_refused(path):
    first, _, second, _ = PAIRS[path]
    with pytest.raises(
        ConfigError, match=rf"^{path}\.{first} is missing, but must be given, or {path}\.{second}"
    ):
        drumrs.baseline().replace({f"{path}.{first}": None})


def test_settings_are_toml_literals_or_bare_words():
    words = ["a.b=1", "a.c=[1, 2]", "d=bare", 'e="quoted"', "f=true", "g=1e-3", "h=x = 3", "i=nan", "a.b=2"]
    layer = parse_settings(words)
    assert layer.pop("i") != layer
    assert layer == {
        "a.b": 2,
        "a.c": [1, 2],
        "d": "bare",
        "e": "quoted",
        "f": True,
        "g": 1e-3,
        "h": "x = 3",
    }


def test_settings_are_also_what_people_type():
    words = ["a=.25", "b=5.", "c=25%", "d=-.5e-3", "e=2.5 %", "f=True", "g=False", "h=1e3"]
    assert parse_settings(words) == {
        "a": 0.25,
        "b": 5.0,
        "c": 0.25,
        "d": -0.5e-3,
        "e": 0.025,
        "f": True,
        "g": False,
        "h": 1000.0,
    }


def test_numbers_in_quotes_and_whole_floats_are_taken():
    config = drumrs.baseline().replace({"load.count": 1e3, "run.seed": "7", "contact.drum.friction": "0.3"})
    assert (config.bundle_count, config.run.seed, config.contact.drum.friction) == (1000, 7, 0.3)
    assert isinstance(config.load.count, int)


def test_a_key_cannot_be_assigned():
    with pytest.raises(
        ConfigError, match=r'fill cannot be set to 0.3: .* config.replace\(\{"…fill": 0.3\}\)'
    ):
        drumrs.baseline().load.fill = 0.3


def test_a_setting_cannot_smuggle_a_second_one():
    assert parse_settings(["a=1\nb = 2"]) == {"a": "1\nb = 2"}


def test_nested_and_dotted_keys_mix():
    assert nest({"load": {"fill": 0.3}, "load.density": 5}) == {"load": {"fill": 0.3, "density": 5}}
    with pytest.raises(ConfigError, match="load is 5, but must be a table"):
        nest({"load": 5, "load.fill": 0.3})
