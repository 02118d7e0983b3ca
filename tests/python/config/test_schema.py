"""The JSON schema of a case file: what drumrs reads is valid, what it refuses is not, every key has its meaning."""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import drumrs
from drumrs.config import Config, dotted_keys
from drumrs.config.schema import editor_schema

ROOT = Path(__file__).parents[3]
SCHEMA = editor_schema(Config)
VALIDATOR = Draft202012Validator(SCHEMA)
# Sweep files have keys of their own, and row, a workflow engine, has its own files.
CASES = [
    (page.name, block)
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    for block in re.findall(
        r"^```toml\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )
    if not re.search(r"^(seeds|base = \"|\[axes|\[base|\[\[action)", block, re.MULTILINE)
]


def key_of(dotted: str) -> dict:
    part = SCHEMA
    for name in dotted.split("."):
        part = part["properties"][name]
        part = SCHEMA["$defs"][part["$ref"].rpartition("/")[2]] if "$ref" in part else part
    return part


def test_it_is_a_schema():
    Draft202012Validator.check_schema(SCHEMA)


def test_every_key_has_its_meaning_and_unit():
    for key in dotted_keys(Config):
        assert key_of(key)["description"]
    assert key_of("load.density")["unit"] == "kg/m³"
    assert key_of("rotation.program")["unit"] == "s, rpm"
    assert key_of("drum.tilt") | {"exclusiveMinimum": -90, "exclusiveMaximum": 90, "default": 0.0} == key_of(
        "drum.tilt"
    )
    assert key_of("load.count")["maximum"] == 10_000_000


def test_the_baseline_is_valid():
    for baffles in (False, True):
        VALIDATOR.validate(tomllib.loads(drumrs.baseline(baffles=baffles).to_toml()))


@pytest.mark.parametrize(
    ("page", "text"), CASES, ids=[f"{page}-{number}" for number, (page, _) in enumerate(CASES)]
)
def test_the_examples_of_the_documentation_are_valid(page, text):
    assert page.endswith(".md")
    case = tomllib.loads(text)
    VALIDATOR.validate(case)
    # Drawings are not there.
    if "file" not in case.get("drum", {}).get("liner", {}):
        drumrs.baseline().replace(case)


def test_there_are_examples():
    assert {"your-machine.md", "programs.md"} <= {page for page, _ in CASES}


@pytest.mark.parametrize(
    "case",
    [
        {"load": {"fil": 0.3}},
        {"load": {"fill": 0.3, "count": 3}},
        {"load": {"diameter": 0.0}},
        {"rotation": {"rpm": 1, "phase": [{"duration": 1, "rpm": 1}]}},
        {"rotation": {"phase": []}},
        {"rotation": {"phase": [{"duration": 1, "rpm": 1, "ramp": [0, 1]}]}},
        {"rotation": {"phase": [{"phase": [{"duration": -1, "rpm": 1}], "repeat": 3}]}},
        {"drum": {"tilt": 90}},
        {"drum": {"walls": [[[0, 0]]]}},
        {"gravity": [0, 0, -9.81]},
        {"run": {"time_step": "aut"}},
        {"contact": {"pair": [{"friction": 0.1}]}},
        {"contact": {"drum": {"restitution": 0.1, "normal_damping": 3}}},
    ],
)
def test_what_is_refused_is_not_valid(case):
    assert not VALIDATOR.is_valid(case)
    with pytest.raises(drumrs.ConfigError):
        drumrs.baseline().replace(case)


@pytest.mark.parametrize(
    "case",
    [
        {},
        {"load": {"count": 100}, "run": {"time_step": "auto", "skin": 0.001}},
        {
            "load": {
                "share_by": "mass",
                "species": [{"name": "steel", "share": 0.4}, {"name": "ore", "share": 0.6}],
            },
            "contact": {
                "bundle": {"friction": 0.3},
                "pair": [{"between": ["steel", "ore"], "friction": 0}],
            },
        },
        {"rotation": {"program": [[0, 0], [2, 54]]}},
    ],
)
def test_what_is_taken_is_valid(case):
    VALIDATOR.validate(case)
    drumrs.baseline().replace(case)


def test_it_is_printed_in_utf_8_whatever_the_terminal_has():
    words = [sys.executable, "-m", "drumrs", "config"]
    encoding = {**os.environ, "PYTHONIOENCODING": "cp1252"}
    printed = subprocess.run([*words, "--schema"], capture_output=True, check=True, env=encoding).stdout
    assert json.loads(printed.decode()) == SCHEMA
    assert "kg/m³" in printed.decode()
    case = subprocess.run(words, capture_output=True, check=True, env=encoding).stdout
    assert Config.from_toml(case.decode()) == drumrs.baseline()
