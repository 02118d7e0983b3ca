"""`drumrs reproduce`: one command from the first run to the report, and the same command again after a break."""

import re
from dataclasses import replace

import polars as pl
import pytest

from drumrs import ConfigError, paper
from drumrs.paper import reproduction
from drumrs.paper.reproduction import Reproduction
from small_study import SMALL

TINY = replace(
    SMALL, duration=0.2, window=(0.1, 0.2), fills=(0.05,), fills_with_baffles=(0.05,), frictions=(0.0, 0.5)
)
FILES = {"drumrs-reproduction.json", "report.html", "summary.md", "table.parquet", "figures", "runs"}


@pytest.fixture
def _tiny(monkeypatch):
    """Make the scale "quick" one of a second."""
    monkeypatch.setattr("drumrs.paper.scales.SCALES", {"quick": TINY, "default": SMALL, "full": SMALL})


@pytest.mark.usefixtures("_tiny")
def test_one_command_does_it_all_and_goes_on(drum, tmp_path):
    out = tmp_path / "out"
    count = len(paper.cases("quick"))
    status, printed, told = drum("reproduce", "--quick", "--out", out, "--jobs", "1")
    assert status == 0
    assert re.search(rf"quick study: {count} cases, \S+ particle-steps to do, about \d+ s on 1 core\n", told)
    assert {path.name for path in out.iterdir()} == FILES
    assert re.findall(
        r"^ ?(C\d+) +(?:holds|holds in part|does not hold|undecided) ", printed, re.MULTILINE
    ) == [f"C{k}" for k in range(1, 15)]
    assert "F3 is not drawn. Missing: runs at 50 % fill with baffles" in printed
    assert printed.endswith(f"wrote {out / 'report.html'}\n")
    table, report = (out / "table.parquet").read_bytes(), (out / "report.html").read_text(encoding="utf-8")
    assert pl.read_parquet(out / "table.parquet").height == count
    assert "<h1>Loads tumbling in a rotating drum</h1>" in report

    summary = (out / "summary.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (C\d+)$", summary, re.MULTILINE) == [f"C{k}" for k in range(1, 15)]
    verdicts = paper.judge(pl.read_parquet(out / "table.parquet"))
    assert all(f"{one.statement} **{one.verdict.capitalize()}" in summary for one in verdicts)
    assert all(part.sentence in summary for one in verdicts for part in one.parts)
    assert "F3, Snapshots with baffles: not drawn. Missing: runs at 50 % fill" in summary
    shown = re.findall(r"\((figures/\S+)\)", summary)
    assert shown
    assert all((out / path).is_file() for path in shown)

    taken_up = {path: path.stat().st_mtime_ns for path in (out / "runs").glob("*.parquet")}
    next(path for path in taken_up if not re.search(r"series|frames|plan", path.name)).unlink()
    status, _, told = drum("reproduce", "--quick", "--out", out, "--jobs", "1")
    assert status == 0
    assert f"quick study: {count} cases, {count - 1} of them settled already, " in told
    assert (out / "table.parquet").read_bytes() == table
    again = [path for path, time in taken_up.items() if path.stat().st_mtime_ns != time]
    # Record of completion and series of the one that was lost; it keeps no frames.
    assert 2 <= len(again) <= 3


def test_a_failing_case_is_reported_and_the_rest_goes_on(monkeypatch, drum, tmp_path):
    scales = {"quick": replace(TINY, fills=(0.05, 1.5))}
    monkeypatch.setattr("drumrs.paper.scales.SCALES", scales)
    status, _, told = drum("reproduce", "--quick", "--out", tmp_path)
    assert status == 1
    assert re.search(r"drumrs: case \w+ \(600 bundles .*\) failed: load.fill is 1.5 .* must be at most", told)
    assert "cases failed; --retry runs them again" in told
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<b>1 case failed.</b>" in report
    assert "load.fill is 1.5 (600 bundles), but must be at most" in report
    status, _, told = drum("reproduce", "--quick", "--out", tmp_path)
    assert status == 1
    assert "about" in told


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--quick", "--full"), "--quick and --full are both given, but only one of them may be"),
        (("--quick", "--jobs", "0"), "jobs is 0, but must be a whole number from 1 to 1024"),
        (("--quick", "--out", "FILE"), "--out is '{file}', but must be a folder"),
    ],
)
def test_bad_input_is_refused_before_anything_is_written(words, says, drum, tmp_path):
    file = tmp_path / "file"
    file.touch()
    given = [str(file) if word == "FILE" else word for word in words]
    out = () if "--out" in given else ("--out", tmp_path / "out")
    status, printed, told = drum("reproduce", *given, *out)
    assert (status, printed) == (2, "")
    assert told.startswith(f"drumrs: {says.format(file=file)}")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_an_unknown_scale_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="scale is 'fast', but must be 'quick', 'default' or 'full'"):
        Reproduction("fast", tmp_path)


def test_a_folder_of_a_newer_version_is_refused(tmp_path):
    (tmp_path / "runs").mkdir()
    (tmp_path / "drumrs-reproduction.json").write_text("{}", encoding="utf-8")
    (tmp_path / "runs" / "drumrs-sweep.json").write_text('{"format": 999}', encoding="utf-8")
    with pytest.raises(ConfigError, match="of format 999, but must be of format"):
        Reproduction("quick", tmp_path)


def test_the_expected_time_follows_speed_and_work(monkeypatch, tmp_path):
    monkeypatch.setattr(reproduction, "measure_speed", lambda jobs: 1e6 * jobs)
    plan = Reproduction("quick", tmp_path, jobs=2)
    writing = Reproduction("quick", tmp_path, jobs=2)
    writing.waiting = ()
    runs = plan.expected_time() - writing.expected_time()
    assert runs == pytest.approx(plan.cost / 2e6)
    # A single long case keeps one core busy, however many there are.
    alone = Reproduction("quick", tmp_path, jobs=8)
    alone.waiting = alone.waiting[:1]
    assert alone.expected_time() - writing.expected_time() == pytest.approx(alone.cost / 1e6)
    several = Reproduction("quick", tmp_path, jobs=1000)
    longest = max(case.cost for case in several.waiting)
    assert several.expected_time() - writing.expected_time() == pytest.approx(longest / 1e6)
