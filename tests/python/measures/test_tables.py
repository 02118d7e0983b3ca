"""Measures of tables: what is not recorded or not known is refused, and nothing at all is not an error."""

import polars as pl
import pytest

from drumrs import measures
from drumrs.errors import ConfigError

CONTACTS = pl.DataFrame(
    {
        "particle": [0, 1],
        "duration": [1e-3, 1.0],
        "dissipated_normal": [0.5, 0.25],
        "dissipated_tangential": [0.25, 0.0],
        "dissipated_rolling": [0.0, 0.0],
        "is_open": [False, False],
    }
)
SQUARE = pl.DataFrame(
    {
        "part": ["baffle 1"] * 4,
        "arc_start": [0.0, 1.0, 2.0, 3.0],
        "arc_end": [1.0, 2.0, 3.0, 4.0],
        "x": [0.5, 1.0, 0.5, 0.0],
        "y": [0.0, 0.5, 1.0, 0.5],
        "normal_x": [0.0, 1.0, 0.0, -1.0],
        "normal_y": [-1.0, 0.0, 1.0, 0.0],
        "normal_force_slip": [1.0, 1.0, 1.0, 1.0],
    }
)


@pytest.mark.parametrize(
    ("measure", "record"),
    [
        (lambda: measures.collision_spectrum(None, 1.0, 1.0), "contacts"),
        (lambda: measures.impacts(None, 1e-3), "contacts"),
        (lambda: measures.enduring(None, 1e-3), "contacts"),
        (lambda: measures.sum_rule(None, {}), "contacts"),
        (lambda: measures.wear(None), "wall_profile"),
    ],
)
def test_what_was_not_recorded_is_asked_for(measure, record):
    with pytest.raises(ConfigError, match=rf"run\.record lacks '{record}', .*; add '{record}' to it"):
        measure()


def test_sums_of_contacts_meet_the_ledger():
    dissipated = dict(zip(FLOWS, (0.75, 0.15, 0.1, 0.0), strict=True))
    assert measures.sum_rule(CONTACTS, dissipated) == pytest.approx(dict.fromkeys(SUMS, 0.0), abs=1e-15)
    missing = measures.sum_rule(CONTACTS[:1], dissipated)
    assert missing["dissipated_normal"] == pytest.approx(-1.0 / 3.0)


def test_what_is_below_the_floor_counts_in_shares_alone():
    floor = CONTACTS[:1].with_columns(particle=pl.lit(None, pl.Int64), duration=pl.lit(None, pl.Float64))
    whole = pl.concat([CONTACTS, floor.with_columns(dissipated_normal=pl.lit(0.25))])
    seen = measures.collision_spectrum(whole, 1.0, 1.0, "normal")
    assert seen["events"].sum() == 2
    assert seen["share_above"][0] == pytest.approx(0.75)
    assert len(measures.enduring(whole, 1e-3)) + len(measures.impacts(whole, 1e-3)) == 2


FLOWS = ("dissipated_normal", "dissipated_sliding", "dissipated_tangential", "dissipated_rolling")
SUMS = ("dissipated_normal", "dissipated_tangential", "dissipated_rolling")


def test_no_contact_makes_an_empty_spectrum():
    assert len(measures.collision_spectrum(CONTACTS[:0], 1.0, 1.0)) == 0
    assert len(measures.collision_spectrum(CONTACTS, 1.0, 1.0, "rolling")) == 0


def test_an_open_contact_endures():
    open_one = CONTACTS.with_columns(is_open=pl.lit(value=True))
    assert (len(measures.impacts(open_one, 1e-3)), len(measures.enduring(open_one, 1e-3))) == (0, 2)


def test_unknown_kinds_laws_and_parts_are_refused():
    with pytest.raises(
        ConfigError, match="kind is 'shear', but must be one of normal, tangential, rolling, total"
    ):
        measures.collision_spectrum(CONTACTS, 1.0, 1.0, "shear")
    with pytest.raises(ConfigError, match="law is 'oka', but must be one of archard, finnie"):
        measures.wear(SQUARE, "oka")
    with pytest.raises(ConfigError, match="part is 'rim', but must be one of baffle 1"):
        measures.worn_outline(measures.wear(SQUARE), "rim", 1.0)


def test_a_part_worn_through_is_refused():
    worn = measures.wear(SQUARE, coefficient=0.1)
    assert measures.worn_outline(worn, "baffle 1", 1.0)[0].tolist() == pytest.approx([0.5, 0.1])
    with pytest.raises(ConfigError, match="is not worn through"):
        measures.worn_outline(worn, "baffle 1", 6.0)
