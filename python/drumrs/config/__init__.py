"""Validated, frozen configurations: keys and defaults, layers, TOML and JSON in and out.

Imports nothing else of drumrs but its errors. `fields` holds the types of values and the words for their limits,
`models` the tables, `root` the whole; `layers` lays tables over each other, `report` words refusals, `document`
writes TOML, `boundary` translates for the compiled core.
"""

from drumrs.config.layers import merge, nest, parse_settings
from drumrs.config.models import (
    Baffles,
    Contact,
    Drum,
    LinearContact,
    Load,
    PairContact,
    Rotation,
    Run,
    WallContact,
)
from drumrs.config.report import dotted_keys
from drumrs.config.root import Config, baseline, read_toml_file

__all__ = [
    "Baffles",
    "Config",
    "Contact",
    "Drum",
    "LinearContact",
    "Load",
    "PairContact",
    "Rotation",
    "Run",
    "WallContact",
    "baseline",
    "dotted_keys",
    "merge",
    "nest",
    "parse_settings",
    "read_toml_file",
]
