"""Progress below a notebook's cell: bars that move, end where the run ended, and need nothing but IPython."""

import re
import sys
from types import ModuleType

import pytest

import drumrs
from drumrs import progress

SHARE = re.compile(r'<progress max="1" value="([\d.]+)"></progress> ([^<]*)')


class Shown:
    """Stands for IPython's display of one output, and keeps what it showed."""

    def __init__(self) -> None:
        self.pages: list[str] = []

    def update(self, thing: object) -> None:
        self.pages.append(thing._repr_html_())


@pytest.fixture
def shown(monkeypatch):
    """Pretend to be in a notebook; return what it shows."""
    display = Shown()
    module = ModuleType("IPython.display")
    module.display = lambda _, **__: display
    monkeypatch.setitem(sys.modules, "IPython.display", module)
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    monkeypatch.setattr(progress, "_REFRESH", 0.0)
    return display


def test_a_run_shows_a_bar_that_ends_full(shown, short):
    drumrs.run(short)
    shares = [float(SHARE.search(page)[1]) for page in shown.pages if SHARE.search(page)]
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    line = r"40 bundles, 16.2 k steps: 100%, 0.06 of 0.06 s, [\d.]+ M particle-steps/s, \d+ s taken"
    assert re.search(line, shown.pages[-1])


def test_a_sweep_shows_cases_and_failures(shown, short, tmp_path):
    sweep = drumrs.Sweep(short, axes={"load.fill": [0.05, 5.0]})
    sweep.run(tmp_path)
    assert "2 of 2 cases" in shown.pages[-1]
    assert float(SHARE.search(shown.pages[-1])[1]) == 1.0


def test_a_configuration_shows_what_differs_from_the_baseline():
    config = drumrs.baseline(fill=0.1).replace({"contact.drum.friction": 0.3})
    shown = config._repr_html_()
    assert f"<caption>{config.title}</caption>" in shown
    rows = dict(re.findall(r"<tr><th>(.*?)</th><td>(.*?)</td></tr>", shown))
    assert rows == {"load.fill": "0.1", "contact.drum.friction": "0.3"}
    assert "<pre># Gravity" in shown
    assert "<tr>" not in drumrs.baseline()._repr_html_()


def test_a_sweep_shows_its_axes():
    base = drumrs.baseline().replace({"run.duration": 0.1})
    sweep = drumrs.Sweep(base, {"load.fill": [0.1, 0.2]}, seeds=12)
    rows = dict(re.findall(r"<tr><th>(.*?)</th><td>(.*?)</td></tr>", sweep._repr_html_()))
    assert rows["load.fill"] == "0.1, 0.2"
    assert rows["seed"] == "0, 1, 2, 3, 4, 5, 6, 7, … (12 values)"
    assert float(rows["particle-steps"]) == pytest.approx(sum(case.cost for case in sweep.cases), rel=0.05)


def test_names_cannot_break_the_page(shown):
    with drumrs.Task("<i>", 1) as task:
        task.note("<b>a & b")
    assert "&lt;i&gt;" in shown.pages[-1]
    assert shown.pages[-1].endswith("<div>&lt;b&gt;a &amp; b</div>")
