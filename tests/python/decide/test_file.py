"""Files of decisions: what is said where there is none, or where it has keys that such a file cannot have."""

import pytest

from drumrs.cli import main
from drumrs.decide.file import DecisionFile, listed, whole
from drumrs.errors import ConfigError

TABLES = {
    "screen": "[base], [ranges], [axes], [screen]",
    "optimize": "[base], [ranges], [axes], [optimize]",
    "calibrate": "[base], [ranges], [measured], [candidate], [calibrate]",
}


@pytest.mark.parametrize(
    ("command", "hint"),
    [
        *((name, f"drumrs {name} --help says what {tables} hold") for name, tables in TABLES.items()),
        ("sweep", "drumrs sweep --help says what it holds"),
        ("compare", "drumrs config > case.toml writes one with every key"),
    ],
)
def test_where_a_file_is_missing_it_says_what_such_a_file_holds(command, hint, tmp_path, capsys):
    files = [str(tmp_path / "missing.toml")] * (1 if command != "compare" else 2)
    files[-1] = str(tmp_path / "another.toml")
    with pytest.raises(SystemExit) as left:
        main([command, *files, "--out", str(tmp_path / "out")])
    told = capsys.readouterr().err
    assert left.value.code == 2
    assert "No such file or directory" in told
    assert told.rstrip().endswith(hint)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("command", TABLES)
def test_a_table_that_such_a_file_cannot_have_is_refused_before_its_base_is_read(command):
    with pytest.raises(ConfigError, match=r"axis is not a key of an? .*; the keys there are base, ranges, "):
        DecisionFile.read({"base": "nowhere.toml", "axis": {}}, command)
    with pytest.raises(ConfigError, match=rf"{command}\.speed is not a key of"):
        DecisionFile.read({command: {"speed": 1}}, command).options("runs")
    with pytest.raises(ConfigError, match=f"{command} is 3, but must be a table"):
        DecisionFile.read({command: 3}, command).options("runs")


def test_a_single_value_is_a_list_of_one_and_whole_numbers_are_whole():
    assert (listed({"a": "b"}, "a"), listed({}, "a", ("c",)), listed({"a": []}, "a", ("c",))) == (
        ["b"],
        ["c"],
        [],
    )
    assert whole(4, "optimize.runs", 4) == 4
    for wrong in (3, 1001, 4.0, True, "5"):
        with pytest.raises(ConfigError, match=r"optimize\.runs is .*, but must be a whole number from 4 to"):
            whole(wrong, "optimize.runs", 4)
