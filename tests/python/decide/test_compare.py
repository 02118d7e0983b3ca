"""`drumrs compare`: machines told apart by real runs; sentence, table, figure; what it refuses."""

import polars as pl
import pytest

import drumrs
from drumrs.analysis import Estimate, Interval
from drumrs.cli import main
from drumrs.decide import Comparison, Design, Target
from drumrs.decide.difference import Difference
from drumrs.errors import ConfigError

SLOW = drumrs.baseline(fill=0.05).replace({"run.duration": 0.1, "run.frame_every": 0.02})
FAST = SLOW.replace({"rotation.rpm": 80.0})


def test_the_slower_drum_takes_less_and_the_faster_one_more(tmp_path):
    least = drumrs.compare([FAST, SLOW], "drum_power", out=tmp_path, progress=False)
    assert (least.best.name, least.is_decided) == ("B", True)
    assert least.sentence.startswith("B is best (drum power ")
    assert "lower than every other by" in least.sentence
    most = drumrs.compare([FAST, SLOW], "drum_power", out=tmp_path, greatest=True, progress=False)
    assert most.best.name == "A"
    assert most.best.estimate.mean == pytest.approx(least.designs[0].estimate.mean)
    assert most.designs[1].behind.low > 0.0


def test_what_is_finished_is_not_simulated_again(tmp_path, monkeypatch):
    first = drumrs.compare({"slow": SLOW, "fast": FAST}, "drum_power", out=tmp_path, progress=False)
    monkeypatch.setattr("drumrs.sweep.worker._simulate", None)
    again = drumrs.compare({"slow": SLOW, "fast": FAST}, "drum_power", out=tmp_path, progress=False)
    assert again == first


@pytest.mark.parametrize(
    ("standings", "told"),
    [
        (
            ("best", "worse"),
            "A is best (drum power 10 ± 1.1 W/m): lower than every other by 2 W/m, 20 % at least, with 95 %.",
        ),
        (("best", "equal"), "No difference above 5 % (0.5 W/m) between A (drum power 10 ± 1.1 W/m) and B."),
        (
            ("best", "equal", "worse"),
            "No difference above 5 % (0.5 W/m) between A (drum power 10 ± 1.1 W/m) and B; C is worse for sure.",
        ),
        (
            ("best", "equal", "worse", "worse"),
            "No difference above 5 % (0.5 W/m) between A (drum power 10 ± 1.1 W/m) and B; C, D are worse for sure.",
        ),
        (
            ("best", "open"),
            "It is open whether B or A is best (drum power 10 ± 1.1 W/m): the runs allowed do not tell "
            "differences of 5 % (0.5 W/m).",
        ),
    ],
)
def test_the_sentence_says_what_came_out(standings, told):
    designs = tuple(
        Design("ABCD"[k], standing, Estimate(10.0 + k, 0.5, 10), Interval(3.0 * k, 1.0), False, 11)
        for k, standing in enumerate(standings)
    )
    found = Comparison(Target.parse("drum_power"), False, Difference(0.05, True), designs)
    assert found.sentence == told


def test_a_comparison_is_a_command_with_a_table_and_a_figure(tmp_path, capsys):
    for name, config in {"slow": SLOW, "fast": FAST}.items():
        (tmp_path / f"{name}.toml").write_text(config.to_toml(comments=False))
    cases = [str(tmp_path / name) for name in ("slow.toml", "fast.toml")]
    out = tmp_path / "out"
    with pytest.raises(SystemExit) as left:
        main(["compare", *cases, "--by", "drum_power", "--difference", "10 %", "--out", str(out)])
    assert left.value.code == 0
    said = capsys.readouterr().out
    assert "slow is best (drum power" in said
    table = pl.read_parquet(out / "table.parquet")
    assert table["design"].to_list() == ["slow", "fast"]
    assert table["seeds"].min() >= 4
    assert (out / "differences.png").stat().st_size > 10_000


@pytest.mark.parametrize("difference", ["5 W", "-5 %", "0", "much", "%", "1e999 %", "5 % W/m"])
def test_a_difference_is_a_percentage_or_in_the_targets_unit(difference):
    with pytest.raises(
        ConfigError, match=r"difference is '.+', but must be a positive number with a % or in W/m"
    ):
        Difference.parse(difference, "W/m")


def test_differences_are_read_as_people_write_them():
    for text in ("5%", " 5 % ", "5.0 %"):
        assert Difference.parse(text, "W/m") == Difference(0.05, True)
    for text in ("0.2", "0.2 W/m", 0.2):
        assert Difference.parse(text, "W/m") == Difference(0.2, False)


def test_what_cannot_be_compared_is_refused_before_anything_runs(tmp_path):
    out = tmp_path / "out"
    for designs, told in (
        ([SLOW], "at least 2 configurations"),
        ([SLOW, SLOW], "the design A is the same configuration as B"),
    ):
        with pytest.raises(ConfigError, match=told):
            drumrs.compare(designs, out=out)
    with pytest.raises(ConfigError, match="did you mean drum_specific_power"):
        drumrs.compare([SLOW, FAST], "specific_power", out=out)
    with pytest.raises(ConfigError, match="most is 5, but must be a whole number from 8 on"):
        drumrs.compare([SLOW, FAST], out=out, most=5)
    assert not out.exists()


def test_a_file_that_is_given_twice_is_named(tmp_path, capsys):
    case = tmp_path / "a.toml"
    case.write_text(SLOW.to_toml(), encoding="utf-8")
    with pytest.raises(SystemExit) as left:
        main(["compare", str(case), str(case), "--out", str(tmp_path / "out")])
    assert left.value.code == 2
    assert "a.toml', but must be another file than the others; it is given twice" in capsys.readouterr().err
