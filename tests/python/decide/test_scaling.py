"""`drumrs scale`: the groups before and after, laws, speeds by rule, the file."""

import pytest

import drumrs
from drumrs.cli import main
from drumrs.config import Config
from drumrs.decide import LAWS, groups, speed_rules

CONFIG = drumrs.baseline(baffles=True).replace(
    {
        "contact.bundle.adhesion": 2.0,
        "drum.liner.rail": {"count": 2, "phase": 90.0},
        "contact.drum.normal_damping": 7e3,
    }
)


@pytest.mark.parametrize("factor", [4.0, 3.0, 0.1])
def test_every_group_is_kept_where_groups_are_kept(factor):
    found = groups(CONFIG, CONFIG.scaled(factor))
    assert len(found) == 17
    assert [group.name for group in found if not group.is_kept] == []


def test_a_key_that_does_not_follow_is_seen():
    for key in (
        "contact.bundle.normal_stiffness",
        "drum.baffles.height",
        "run.time_step",
        "contact.bundle.adhesion",
    ):
        value = CONFIG.model_dump()
        for part in key.split("."):
            value = value[part]
        assert any(not group.is_kept for group in groups(CONFIG, CONFIG.scaled(4.0).replace({key: value}))), (
            key
        )


def test_known_laws_agree_with_the_dimensions_of_two_runs():
    small = drumrs.baseline(fill=0.1).replace({"run.duration": 0.2})
    one, other = (drumrs.run(config, progress=False).summary for config in (small, small.scaled(4.0)))
    powers = {law.name: law.power for law in LAWS}
    assert other.drum_power / one.drum_power == 4.0 ** powers["power"]
    assert other.drum_specific_power / one.drum_specific_power == 4.0 ** powers["specific power"]


def test_speeds_by_rule_do_what_they_say():
    large = CONFIG.scaled(4.0, "bundle")
    speeds = {rule.name: rule.rpm for rule in speed_rules(CONFIG, large)}
    froude = large.replace({"rotation.rpm": speeds["same Froude number"]}).derived.froude_number
    assert froude == pytest.approx(CONFIG.derived.froude_number)
    critical = large.replace(
        {"rotation.rpm": speeds["same share of the critical speed"]}
    ).derived.critical_share
    assert critical == pytest.approx(CONFIG.derived.critical_share)
    assert speeds["same speed of the rim"] * large.drum.diameter == pytest.approx(54.0 * CONFIG.drum.diameter)
    # Fr √(D/d): D/d is four times as large, so Fr is half of what it was.
    henein = large.replace({"rotation.rpm": speeds["same Fr √(D/d)"]}).derived.froude_number
    assert henein == pytest.approx(CONFIG.derived.froude_number / 2.0)


def test_scaling_is_a_command_that_writes_a_case(tmp_path, capsys):
    case, large = tmp_path / "case.toml", tmp_path / "large.toml"
    case.write_text(CONFIG.to_toml())
    with pytest.raises(SystemExit) as left:
        main(["scale", str(case), "--factor", "4", "--keep", "bundle", "--out", str(large)])
    assert left.value.code == 0
    assert Config.read(large) == CONFIG.scaled(4.0, "bundle")
    said = capsys.readouterr().out
    assert "size ratio" in said
    assert "Bond's rule" in said
