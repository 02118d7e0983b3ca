"""Every example in a docstring runs, and so does the code of README and guide."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import drumrs

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
GUIDE = ROOT / "docs" / "guide.md"
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


def test_the_guide_runs_from_its_first_line_to_the_last(drum, tmp_path, monkeypatch, capsys):
    """Files are written, commands called and Python run in the order of the page, for a moment instead of 30 s."""
    monkeypatch.chdir(tmp_path)
    names, printed = {}, ""
    blocks = re.findall(r"```(toml|sh|python)\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
    for language, text in blocks:
        short = text.replace("duration=5", "duration=0.1").replace("30.0", "0.1")
        if language == "toml":
            Path(re.match(r"# (\S+)\n", text)[1]).write_text(short, encoding="utf-8")
        elif language == "sh":
            for words in re.findall(r"^drumrs (?!view)(.*)$", short, re.MULTILINE):
                assert drum(*words.split())[0] == 0
        else:
            exec(compile(short, "guide.md", "exec"), names)
            printed += capsys.readouterr().out
    assert (tmp_path / "out" / "first" / "player.html").is_file()
    assert re.findall(r"^(\d) baffles: [\d.]+ ± [\d.]+ W", printed, re.MULTILINE) == ["0", "3", "4"]
    assert re.search(r"four less three: [+-][\d.]+ ± [\d.]+ W", printed)
    assert len(re.findall(r"^\w+ = [\d.]+: [\d.]+ ± [\d.]+ W$", printed, re.MULTILINE)) == 8


@pytest.mark.parametrize(
    "page", [README, GUIDE, ROOT / "docs" / "study" / "README.md"], ids=lambda page: page.name
)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), target
