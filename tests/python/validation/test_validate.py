"""`drumrs validate`: from the first run to the page, and the same command again after a break."""

import math
import re

import polars as pl
import pytest

from drumrs import ConfigError, quantity
from drumrs.analysis import Estimate
from drumrs.registry import PUBLISHED_DRUMS
from drumrs.sweep.columns import parameters
from drumrs.validation import DRUMS, Scale, Validation, layer, mill, tracer
from drumrs.validation.cases import stiffness
from drumrs.validation.check import AGREES, DIFFERS, SHOWN, UNDECIDED, Check

SMALL = Scale(seeds=(1,), fineness=0.25, duration=0.08)


@pytest.fixture
def _small(monkeypatch):
    """Make the study one of seconds."""
    monkeypatch.setattr("drumrs.validation.study.Scale", lambda: SMALL)


@pytest.mark.usefixtures("_small")
def test_one_command_does_it_all_and_goes_on(drum, tmp_path):
    out = tmp_path / "out"
    status, printed, told = drum("validate", "--out", out, "--jobs", "1")
    assert status == 0
    count = int(re.match(r"drumrs: (\d+) cases, \S+ particle-steps to do\n", told)[1])
    assert {path.name for path in out.iterdir()} == {
        "drumrs-validation.json",
        "README.md",
        "table.parquet",
        "figures",
        "runs",
    }
    assert {path.stem for path in (out / "figures").iterdir()} == set(DRUMS)
    page = (out / "README.md").read_text(encoding="utf-8")
    for name in DRUMS:
        assert f"\n## {name}\n" in page
        assert f"](figures/{name}.png)" in page
        assert re.search(rf"^ *{name} ", printed, re.MULTILINE)
    assert "{comparison}" not in page
    # Our own checks, of stiffness and bits, are not counted among what is published.
    counts = re.search(r"\[layer\]\(#layer\) \| (\d+) \| (\d+) \| (\d+) \|", page)
    assert sum(map(int, counts.groups())) == 4
    # Lengths times 4 and 16: not a bit of the series changes, however short the run.
    assert (
        len(re.findall(r"\| numbers of the series that change, .* \| – \| 0 \| .* \| agrees \|", page)) == 2
    )

    table = pl.read_parquet(out / "table.parquet")
    assert table.height == count
    assert set(table["drum"]) == set(DRUMS)
    others = {"case", "drum", "seed", *parameters(mill.point(SMALL))}
    assert all(quantity(name).meaning for name in set(table.columns) - others)
    assert set(PUBLISHED_DRUMS) < set(table.columns)
    assert table["mean_overlap_ratio"].max() < 0.02

    cases = Validation(out, ["layer"]).sweep.cases
    (out / "runs" / f"{cases[0].id}.parquet").unlink()
    status, _, told = drum("validate", "layer", "--out", out, "--jobs", "1")
    assert status == 0
    assert told.startswith(f"drumrs: {len(cases)} cases, {len(cases) - 1} of them settled already, ")
    again = pl.read_parquet(out / "table.parquet")
    assert again.equals(table.filter(pl.col("drum") == "layer").select(again.columns))


def test_a_drum_that_nobody_published_is_refused(drum, tmp_path):
    status, _, told = drum("validate", "washer", "--out", tmp_path)
    assert (status, told) == (2, "drumrs: NAME is 'washer', but must be one of tracer, layer, mill\n")
    with pytest.raises(ConfigError, match="one of tracer, layer, mill"):
        Validation(tmp_path, ["washer"])


def test_a_failing_case_leaves_its_drum_uncompared(monkeypatch, tmp_path):
    broken = mill.point(SMALL).replace({"run.time_step": 1.0, "run.seed": 1})
    drum = type(mill.DRUM)("mill", lambda _: [broken], mill.measures, lambda _: [], mill.DRUM.draw)
    monkeypatch.setattr("drumrs.validation.study.DRUMS", {"mill": drum})
    found = Validation(tmp_path / "out", scale=SMALL).run(progress=False)
    assert len(found.failures) == 1
    assert found.checks == {}
    assert "Not compared: a run failed." in found.page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("mean", "error", "verdict"),
    [
        (1.0, 0.01, AGREES),
        (1.5, 0.01, DIFFERS),
        (0.5, 0.01, DIFFERS),
        (1.1, 0.05, UNDECIDED),
        (math.nan, 0.1, UNDECIDED),
    ],
)
def test_a_check_is_judged_by_its_interval(mean, error, verdict):
    assert Check("x", "1", Estimate(mean, error, 8), 0.9, 1.1).verdict == verdict
    assert Check("x", "1", Estimate(mean, error, 8)).verdict == SHOWN


def test_numbers_are_rounded_by_their_interval():
    assert Check("x", "1", Estimate(1.23456, 0.01, 10**6), unit="mm").measured_text == "1.235 ± 0.020 mm"
    assert Check("x", "1", Estimate(1.23456, math.inf, 1)).measured_text == "1.23"
    assert Check("x", "1", Estimate(1.0, 0.1, 8), low=0.0).tolerated_text == "above 0"


def test_stiffness_keeps_overlaps_as_it_says():
    density, depth, fall, radius = 2000.0, 0.5, 3.0, 0.01
    at_rest = stiffness(density, depth)
    pressure = 0.84 * density * 9.81 * depth
    assert 2.0 * pressure / at_rest == pytest.approx(0.01)
    in_fall = stiffness(density, depth, fall)
    effective = density * math.pi * radius**2 / 2.0
    overlap = math.sqrt(2.0 * 9.81 * fall * effective / in_fall)
    assert overlap / radius == pytest.approx(0.05)


def test_drums_are_those_that_were_published():
    drum = tracer.point(Scale())
    assert (drum.drum.diameter, drum.load.diameter, drum.rotation.rpm) == (0.24, 0.003, 11.6)
    assert layer.point(Scale(), 64.0, 3e-3).derived.froude_number == pytest.approx(3e-3)
    assert mill.point(Scale(), 0.9).derived.froude_number == pytest.approx(0.81)
    # Half full, and a segment whose chord lies a quarter of the radius below the axis.
    assert layer.point(Scale()).fill == pytest.approx(0.42, rel=2e-3)
    assert drum.fill / 0.84 == pytest.approx(0.3425, rel=2e-3)
