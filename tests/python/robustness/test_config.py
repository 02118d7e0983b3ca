"""Any document as a configuration: an error of ours or a simulation that runs, never a crash, a hang or a flood.

HYPOTHESIS_PROFILE=long goes on for a hundred times as long.
"""

import json
import os
import resource

import pytest
from hypothesis import HealthCheck, given, settings

import drumrs
from documents import documents, mutations, outcome, toml
from drumrs.config import Config, parse_settings
from drumrs.errors import ConfigError

LONG = os.environ.get("HYPOTHESIS_PROFILE") == "long"
ROBUSTNESS = settings(
    max_examples=30_000 if LONG else 200,
    # What takes so long hangs, as far as one who waits for it can tell.
    deadline=30_000,
    derandomize=not LONG,
    database=None,
    suppress_health_check=list(HealthCheck),
)
# What all of this may take in memory, tests included [MB].
MOST_MEMORY = 3000.0


@pytest.fixture(autouse=True, scope="module")
def bounded_memory():
    yield
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3 < MOST_MEMORY


@ROBUSTNESS
@given(documents)
def test_any_document(document):
    outcome(json.dumps(document), Config.from_json)
    if isinstance(document, dict):
        outcome("\n".join(toml(document)), Config.from_toml)


@ROBUSTNESS
@given(mutations())
def test_mutations_of_a_valid_configuration(layer):
    outcome(json.dumps(layer), Config.from_json)


@ROBUSTNESS
@given(mutations())
def test_mutations_of_a_valid_configuration_in_toml(layer):
    outcome("\n".join(toml(layer)), Config.from_toml)


DEEP = 100_000
TEXTS = [
    "[" * DEEP,
    '{"a":' * DEEP,
    '{"load":' * DEEP,
    '{"load": {"count": ' + "1" * 5000 + "}}",
    '{"load": {"density": 1' + "0" * 5000 + ".0}}",
    '{"\\ud800": 1}',
    '{"a\\nb": 1}',
    '{"": 1}',
    '{".": 1}',
    '{"' + "x" * 10**5 + '": 1}',
    "\ufeff{}",
    "\x00",
    "nan",
    "a = " + "[" * DEEP,
    "a = {" * DEEP,
    "a" + ".a" * 2000 + " = 1",
    "load.count = " + "1" * 5000,
    "load.fill = 1979-05-27T07:32:00Z",
    "run.window = [07:32:00, 1979-05-27]",
    "[[load]]\nfill = 1",
]


@pytest.mark.parametrize("read", [Config.from_json, Config.from_toml])
@pytest.mark.parametrize("text", TEXTS, ids=range(len(TEXTS)))
def test_documents_that_break_parsers(text, read):
    with pytest.raises(ConfigError) as caught:
        read(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("value", ["[" * DEEP, "1" * 5000, "{a={" * 5000])
def test_settings_that_break_parsers(value):
    with pytest.raises(ConfigError, match=r"load\.fill is"):
        drumrs.baseline().replace(parse_settings([f"load.fill={value}"]))


TINY = {"run.time_step": "auto", "run.duration": 1e-9, "run.sample_every": 1e-11, "load.count": 10}


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"run.sample_every": 1.7e308}, "run.sample_every is 1.7e.308, but must be at most 5"),
        ({"run.frame_every": 1e-300}, "run.frame_every is 1e-300, but must be at least .* GiB of memory"),
        ({"run.duration": 3e9, "run.time_step": 3e-6}, "run.sample_every is 0.002, but must be at least"),
        ({**TINY, "load.diameter": 1e-300}, "the mass of bundle 0 is 0e0 kg/m"),
        (
            {
                **TINY,
                "contact.bundle.normal_stiffness": 1e-320,
                "contact.drum.normal_stiffness": 1e-320,
                "load.density": 1e300,
            },
            "the shortest collision time is inf s, but must be a positive finite number",
        ),
        ({"run.time_step": 5e-324}, "run.time_step is 5e-324, but must be at least 2.2"),
        ({"load.count": 10**12}, "load.count is 1000000000000, but must be a whole number from 1"),
        ({"load.count": 10**7}, "load.count is 10000000, but must be at most 330"),
        (
            {"drum.walls": [[[0.1, 1e-9 * k] for k in range(1001)]]},
            "drum.walls is of 1001 corners in one wall, but must be of at most 1000",
        ),
        (
            {"drum.walls": [[[0.1, 1e-9 * k] for k in range(900)]] * 23},
            "drum is of 20700 corners in baffles and walls together, but must be of at most 20000",
        ),
    ],
)
def test_what_no_memory_or_arithmetic_holds_is_refused(changes, sentence):
    with pytest.raises(ConfigError, match=sentence):
        drumrs.Simulation(drumrs.baseline().replace(changes))


@pytest.mark.filterwarnings("ignore:load.diameter is 1e-09 m")
def test_bundles_far_smaller_than_a_baffle_are_packed_at_once():
    """A baffle covers more sites of their lattice than could ever be counted."""
    simulation = drumrs.Simulation(
        drumrs.baseline(baffles=True).replace({**TINY, "load.diameter": 1e-9, "drum.baffles.count": 9})
    )
    simulation.run(steps=5)
    assert simulation.count == 10
