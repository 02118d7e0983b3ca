"""Validated, frozen configurations: keys and defaults, layers, TOML and JSON in and out.

Imports nothing else of drumrs but its errors and the reader of drawings. `types` holds the types of values and their
limits in words, `tables` and `drum_tables` the tables of keys, `program` the phases of a program, `config` the whole
configuration, `liner` where a liner is read; `layers` merges tables, `messages` words what is refused, `hints` tells of
what may not be meant, `toml_writer` writes TOML with comments, `schema` a JSON schema for editors, `to_core` translates
for the compiled core, `derived` asks it what follows.
"""

from drumrs.config.config import Config, baseline, read_layer, require_config
from drumrs.config.derived import Derived, DerivedContact
from drumrs.config.drum_tables import Baffles, Drum, Liner, Outline, Rail
from drumrs.config.layers import merge, nest, parse_settings
from drumrs.config.liner import anchored
from drumrs.config.messages import dotted_keys
from drumrs.config.tables import (
    Contact,
    LinearContact,
    Load,
    PairContact,
    Phase,
    Rotation,
    Run,
    WallContact,
)

__all__ = [
    "Baffles",
    "Config",
    "Contact",
    "Derived",
    "DerivedContact",
    "Drum",
    "LinearContact",
    "Liner",
    "Load",
    "Outline",
    "PairContact",
    "Phase",
    "Rail",
    "Rotation",
    "Run",
    "WallContact",
    "anchored",
    "baseline",
    "dotted_keys",
    "merge",
    "nest",
    "parse_settings",
    "read_layer",
    "require_config",
]
