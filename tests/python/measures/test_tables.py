"""Measures of tables: what is not recorded or not known is refused, and nothing at all is not an error."""

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import measures
from drumrs.analysis.blocks import ratio_of_sums
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
        (lambda: measures.impact_rates(None, (0.0, 1.0), 1.0, 1e-3), "contacts"),
        (lambda: measures.wear_of_parts(None, 1.0), "wall_profile"),
        (lambda: measures.received_spread(None), "discs"),
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


PARTS = pl.Enum(["rim", "baffle 1", "baffle 2"])


def made_up_contacts(times, parts, energies, duration=1e-3):
    made = pl.DataFrame({"opened": times, "part": parts, "dissipated_normal": energies})
    return made.cast({"opened": pl.Float64, "part": PARTS, "dissipated_normal": pl.Float64}).with_columns(
        duration=pl.lit(duration),
        particle=pl.lit(0),
        dissipated_tangential=pl.lit(0.0),
        dissipated_rolling=pl.lit(0.0),
        is_open=pl.lit(value=False),
    )


def test_rates_of_impacts_are_counts_and_energies_over_mass_and_time():
    # Ten a second for 16 s: six between discs, three at the rim, one at a baffle. Before the window, and lasting ones,
    # there are others.
    parts = ([None] * 6 + ["rim"] * 3 + ["baffle 2"]) * 16
    energies = ([0.5] * 6 + [1.0] * 3 + [3.0]) * 16
    hits = made_up_contacts([2.0 + 0.1 * k for k in range(160)], parts, energies)
    early = made_up_contacts([0.5] * 5, ["rim"] * 5, [70.0] * 5)
    lasting = made_up_contacts([3.0] * 5, ["rim"] * 5, [7.0] * 5, duration=0.5)
    found = measures.impact_rates(
        pl.concat([early, hits, lasting]), (1.95, 17.95), mass=2.0, collision_time=1e-3
    )
    values = {name: mean.value for name, mean in found.items()}
    assert values == pytest.approx(
        {
            "impact_rate": 5.0,
            "impact_specific_power": 4.5,
            "drum_impact_rate": 2.0,
            "drum_impact_specific_power": 3.0,
            "rim_impact_rate": 1.5,
            "rim_impact_specific_power": 1.5,
            "baffle_1_impact_rate": 0.0,
            "baffle_1_impact_specific_power": 0.0,
            "baffle_2_impact_rate": 0.5,
            "baffle_2_impact_specific_power": 1.5,
            # Of 9 J each second 3 are of the baffle, 3 of the rim: half of all is reached at the rim.
            "median_impact_energy": 1.0,
        }
    )
    # The energy is the same in every piece.
    assert found["median_impact_energy"].error == pytest.approx(0.0, abs=1e-12)


def test_the_error_of_a_rate_is_that_of_a_count_where_impacts_are_independent():
    rng = np.random.default_rng(3)
    times = np.sort(rng.uniform(0.0, 100.0, 4000))
    hits = made_up_contacts(times, ["rim"] * 4000, rng.exponential(2.0, 4000))
    found = measures.impact_rates(hits, (0.0, 100.0), mass=1.0, collision_time=1e-3)
    assert found["impact_rate"].error == pytest.approx(4000**0.5 / 100.0, rel=0.35)
    # Of a sum of n exponential terms of mean 2 the variance is n 2 · 2².
    assert found["rim_impact_specific_power"].error == pytest.approx(
        (2.0 * 4000) ** 0.5 * 2.0 / 100.0, rel=0.35
    )
    # Half of the sum of exponential terms of mean 1 lies above x with (1 + x) exp(-x) = 1/2, 1.678.
    assert found["median_impact_energy"].value == pytest.approx(2.0 * 1.678, rel=0.05)


def test_no_impact_at_all_takes_nothing():
    found = measures.impact_rates(made_up_contacts([], [], []), (0.0, 1.0), 1.0, 1e-3)
    assert (found["impact_rate"].value, found["rim_impact_specific_power"].value) == (0.0, 0.0)
    assert np.isnan(found["median_impact_energy"].value)
    assert found["median_impact_energy"].error is None


def test_parts_of_a_run_add_up_to_its_drum():
    config = drumrs.baseline(fill=0.2, baffles=True).softer(100.0)
    record = ["contacts", "wall_profile", "discs"]
    result = drumrs.run(config.replace({"run.duration": 0.6, "run.record": record}), progress=False)
    collision = config.derived.bundle.collision_time
    found = measures.impact_rates(result.contacts, (0.1, 0.6), config.derived.load_mass, collision)
    parts = ("rim", "baffle_1", "baffle_2", "baffle_3")
    for name in ("impact_rate", "impact_specific_power"):
        assert sum(found[f"{part}_{name}"].value for part in parts) == pytest.approx(
            found[f"drum_{name}"].value
        )
        assert 0.0 < found[f"drum_{name}"].value < found[name].value
    hits = measures.impacts(result.contacts, collision).filter(pl.col("opened").is_between(0.1, 0.6))
    spectrum = measures.collision_spectrum(hits, config.derived.load_mass, 0.5)
    assert found["impact_specific_power"].value == pytest.approx(spectrum["power"].sum())
    worn = measures.wear_of_parts(result.wall_profile, 2.0)
    for law, column in (("archard", "normal_force_slip"), ("finnie", "finnie")):
        assert worn[f"{law}_wear"] == pytest.approx(result.wall_profile[column].sum() / 2.0)
        assert sum(worn[f"{part}_{law}_wear"] for part in parts) == pytest.approx(worn[f"{law}_wear"])
    assert worn["wear_peak"] == measures.wear(result.wall_profile)["relative_wear"].max()
    assert np.isnan(measures.wear_of_parts(result.wall_profile, 0.0)["rim_archard_wear"])


def test_discs_that_received_alike_have_no_spread():
    discs = pl.DataFrame(
        {"mass": [1.0, 2.0, 4.0], "received_normal": [1.0, 1.0, 3.0], "received_rolling": [0.0, 1.0, 1.0]}
    )
    assert measures.received_spread(discs) == 0.0
    # Per mass 1, 1, 4: mean 2, standard deviation √2.
    uneven = discs.with_columns(received_normal=pl.Series([1.0, 1.0, 15.0]))
    assert measures.received_spread(uneven) == pytest.approx(2.0**0.5 / 2.0)
    nothing = discs.with_columns(received_normal=0.0, received_rolling=0.0)
    assert np.isnan(measures.received_spread(nothing))


def test_overlap_is_that_of_the_springs_energy():
    # Two contacts, each with ½ k δ²: δ = 0.01 at k = 1e4 takes 0.5.
    series = pl.DataFrame(
        {"time": np.arange(11.0), "elastic_normal": [9.0] + [1.0] * 10, "contact_count": [7] + [2] * 10}
    )
    assert measures.mean_overlap_ratio(series, (0.0, 10.0), 1e4, 0.1).value == pytest.approx(0.1)
    noisy = series.with_columns(elastic_normal=pl.Series([0.0, *([0.9, 1.1] * 5)]))
    found = measures.mean_overlap_ratio(noisy, (0.0, 10.0), 1e4, 0.1)
    ratio = ratio_of_sums(
        noisy["elastic_normal"].to_numpy()[1:], noisy["contact_count"].to_numpy()[1:].astype(float)
    )
    assert found.error / found.value == pytest.approx(0.5 * ratio.error / ratio.value)
    assert measures.mean_overlap_ratio(series.with_columns(contact_count=0), (0.0, 10.0), 1e4, 0.1) is None
