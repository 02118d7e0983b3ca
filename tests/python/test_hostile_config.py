"""Any document as a configuration: a typed error or a simulation that runs, never a crash, a hang or a flood.

The profile "hostile" (HYPOTHESIS_PROFILE=hostile) goes on for ten minutes and more.
"""

import json
import os
import resource

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from drumrs.config import Config, nest
from drumrs.errors import ConfigError
from hostile_documents import documents, mutations, outcome, toml

LONG = os.environ.get("HYPOTHESIS_PROFILE") == "hostile"
HOSTILE = settings(
    max_examples=20_000 if LONG else 120,
    deadline=20_000,
    derandomize=not LONG,
    database=None,
    suppress_health_check=list(HealthCheck),
)


def test_any_json_document():
    @HOSTILE
    @given(documents)
    def check(document):
        outcome(json.dumps(document), Config.from_json)

    check()


@HOSTILE
@given(mutations())
def test_mutations_of_a_valid_configuration_in_json(layer):
    outcome(json.dumps(layer), Config.from_json)
