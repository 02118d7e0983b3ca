"""`import drumrs` stays light."""

import subprocess
import sys

import pytest

import drumrs


@pytest.mark.parametrize("statement", ["import drumrs", "import drumrs.cli", "import drumrs.paper"])
def test_import_is_light(statement):
    heavy = {"matplotlib", "polars", "rich.progress", "scipy", "shapely", "drumrs.verification"}
    code = f"{statement}; import sys; print({heavy} & set(sys.modules))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "set()"


def test_version_is_the_crates():
    assert drumrs.__version__ == drumrs.info()["version"]
    assert all(hasattr(drumrs, name) for name in drumrs.__all__)
