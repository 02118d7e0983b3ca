"""The core in WebAssembly, where it has been built."""

import os
import shutil

import pytest

import live_drum


@pytest.fixture(scope="session", autouse=True)
def _built():
    """Skip where `make wasm` has not been run, or where there is no node, unless DRUMRS_WASM asks for these tests."""
    missing = [
        *(["the core in WebAssembly (make wasm)"] if not live_drum.is_built() else []),
        *(["node"] if shutil.which("node") is None else []),
    ]
    if missing:
        sentence = f"not here: {' and '.join(missing)}"
        (pytest.fail if os.environ.get("DRUMRS_WASM") else pytest.skip)(sentence)
