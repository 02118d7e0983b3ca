"""Every example in a docstring runs, and so does the README's code."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import drumrs

README = Path(__file__).parents[2] / "README.md"
MODULES = ["drumrs"] + [
    module.name
    for module in pkgutil.walk_packages(drumrs.__path__, "drumrs.")
    if not module.name.endswith(("._core", ".__main__"))
]


@pytest.mark.parametrize("name", MODULES)
def test_docstring_examples_run(name):
    outcome = doctest.testmod(importlib.import_module(name), optionflags=doctest.ELLIPSIS)
    assert outcome.failed == 0


@pytest.mark.parametrize(
    "code", re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
)
def test_readme_code_runs(code, tmp_path, monkeypatch):
    shorten = drumrs.baseline
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(drumrs, "baseline", lambda *a, **k: shorten(*a, **k).replace({"run.duration": 0.1}))
    exec(compile(code.replace("duration=0.5", "duration=0.05"), "README.md", "exec"), {})
    assert (tmp_path / "out" / "friction" / "summary.json").is_file()
