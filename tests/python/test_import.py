"""`import drumrs` stays light, and modules import only what the architecture lets them."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import drumrs

PACKAGE = Path(drumrs.__file__).parent


@pytest.mark.parametrize("statement", ["import drumrs", "import drumrs.cli"])
def test_import_is_light(statement):
    code = f"{statement}; import sys; print({{'matplotlib', 'polars', 'rich.progress'}} & set(sys.modules))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "set()"


def imports(path: Path) -> set[str]:
    """Names of drumrs that a module imports anywhere, as dotted names."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("drumrs"):
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names if alias.name.startswith("drumrs")}
    return names


def test_import_rules():
    for path in PACKAGE.rglob("*.py"):
        module = path.relative_to(PACKAGE).with_suffix("").as_posix()
        for name in imports(path):
            if module.startswith("config/"):
                assert name.startswith(("drumrs.config", "drumrs.errors")), (module, name)
            assert not name.startswith("drumrs._core") or module == "simulation", (module, name)
            if name.startswith("drumrs.cli"):
                assert module.startswith(("__main__", "cli/")), (module, name)
            if module.split("/")[0] in {"figures", "analysis"}:
                assert not name.startswith(("drumrs.simulation", "drumrs.protocol", "drumrs.sweep")), (
                    module,
                    name,
                )
            if module.startswith("sweep/"):
                assert not name.startswith(("drumrs.figures", "drumrs.study", "drumrs.report")), (
                    module,
                    name,
                )


def test_version_is_the_crates():
    assert drumrs.__version__ == drumrs.info()["version"]
    assert set(drumrs.__all__) <= set(dir(drumrs))
