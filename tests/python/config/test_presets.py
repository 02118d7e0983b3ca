"""Presets of species: what stands for them, what wins over them, where their numbers are from."""

import re

import pytest

import drumrs
from drumrs.config import Config
from drumrs.config.presets import presets, presets_toml
from drumrs.errors import ConfigError

ORE = {
    "name": "ore",
    "share": 0.8,
    "density": 2700.0,
    "sizes": {"law": "gaudin-schuhmann", "by": "mass", "top_size": 0.03, "modulus": 0.7, "smallest": 0.012},
}


def load(*species):
    changes = {"load.species": species, "load.share_by": "mass", "run.time_step": "auto"}
    return drumrs.baseline().replace(changes)


def test_a_preset_is_replaced_by_plain_numbers():
    mill = load({"name": "balls", "preset": "steel-ball", "share": 0.2}, ORE)
    balls = mill.load.species[0]
    assert (balls.density, balls.contact.friction, balls.contact.restitution) == (7850.0, 0.5, 0.3)
    written = {"name": "balls", "share": 0.2, "density": 7850.0, "contact": balls.contact.given()}
    assert mill == load(written, ORE)
    assert "preset" not in mill.to_toml()
    assert mill.digest == Config.from_toml(mill.to_toml()).digest


def test_what_stands_beside_a_preset_wins():
    given = {"name": "balls", "preset": "steel-ball", "share": 0.2, "density": 8000.0}
    balls = load({**given, "contact": {"friction": 0.2}}, ORE).load.species[0]
    assert (balls.density, balls.contact.friction, balls.contact.restitution) == (8000.0, 0.2, 0.3)
    one = {"load.species": [{"name": "balls", "preset": "steel-ball", "contact": {"normal_damping": 9.0}}]}
    contact = drumrs.baseline().replace(one).load.species[0].contact
    assert (contact.normal_damping, contact.restitution) == (9.0, None)


@pytest.mark.parametrize("preset", ["steelball", "unobtainium", 7, ["ore"]])
def test_a_preset_that_is_not_there_is_refused(preset):
    with pytest.raises(
        ConfigError, match=r"load.species\[0\].preset is .* must be one of steel-ball, .*; (did|drumrs)"
    ):
        drumrs.baseline().replace({"load.species": [{"name": "balls", "preset": preset}]})


def test_every_number_of_a_preset_has_its_source():
    lines = [line for line in presets_toml().splitlines() if " = " in line and not line.startswith("#")]
    assert len(lines) > 20
    for line in lines:
        source = line.partition("#")[2]
        assert re.search(r"\bassumed\b|\d{4}|Table \d", source), f"no source: {line}"
    for name in presets():
        species = {"name": "it", "preset": name, "diameter": 0.02}
        own = drumrs.baseline().replace({"load.species": [species], "run.time_step": "auto"}).load.species[0]
        assert own.contact is not None
        assert {"restitution", "friction", "rolling_friction"} <= own.contact.given().keys()
