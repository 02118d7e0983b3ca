"""Validated, frozen configurations: keys and defaults, layers, TOML and JSON in and out.

Imports nothing else of drumrs but its errors and the reader of drawings. `types` holds the types of values and their
limits in words; `tables`, `drum_tables`, `load` and `contact` the tables of keys; `presets` materials by name; `liner`
where a liner is read; `program` the phases of a program; `laws` what acts between two species; `config` the whole
configuration. `layers` merges tables, `layer_file` reads them, `messages` words what is refused, `hints` tells of
what may not be meant, `toml_writer` writes TOML with comments, `schema` a JSON schema for editors, `to_core`
translates for the compiled core, `derived` asks it what follows.
"""

from drumrs.config.config import Config, baseline, require_config
from drumrs.config.contact import Contact, LinearContact, PairContact, PartialContact
from drumrs.config.derived import Derived, DerivedContact, DerivedSpecies
from drumrs.config.drum_tables import Baffles, Drum, Liner, Outline, Rail
from drumrs.config.laws import Law, laws
from drumrs.config.layer_file import read_layer
from drumrs.config.layers import merge, nest, parse_settings
from drumrs.config.liner import anchored
from drumrs.config.load import Load, Sizes, Species
from drumrs.config.messages import dotted_keys
from drumrs.config.presets import presets
from drumrs.config.tables import Phase, Rotation, Run

__all__ = [
    "Baffles",
    "Config",
    "Contact",
    "Derived",
    "DerivedContact",
    "DerivedSpecies",
    "Drum",
    "Law",
    "LinearContact",
    "Liner",
    "Load",
    "Outline",
    "PairContact",
    "PartialContact",
    "Phase",
    "Rail",
    "Rotation",
    "Run",
    "Sizes",
    "Species",
    "anchored",
    "baseline",
    "dotted_keys",
    "laws",
    "merge",
    "nest",
    "parse_settings",
    "presets",
    "read_layer",
    "require_config",
]
