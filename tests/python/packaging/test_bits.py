"""The bits on record are those of this build; on other systems the same script compares them."""

import importlib.util
import json
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_short_runs_have_the_bits_on_record():
    spec = importlib.util.spec_from_file_location("bits", ROOT / "packaging" / "bits.py")
    bits = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(bits)
    assert bits.digests() == json.loads(bits.RECORD.read_text(encoding="utf-8"))
