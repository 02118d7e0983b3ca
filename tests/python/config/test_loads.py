"""Loads of several species: how many bundles of which, which laws act between them, what is refused in which words."""

import contextlib
import json
import math
from collections import Counter

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.config import Config, LinearContact, laws
from drumrs.config.laws import mixed
from drumrs.errors import ConfigError
from drumrs.frames import Frames

STEEL = {"name": "steel-ball", "share": 0.2, "density": 7800.0, "diameter": 0.02}
ORE = {
    "name": "ore",
    "share": 0.8,
    "density": 2700.0,
    "sizes": {"law": "gaudin-schuhmann", "by": "mass", "top_size": 0.03, "modulus": 0.7, "smallest": 0.012},
}
TWO = {"load.species": [STEEL, ORE], "load.share_by": "mass", "run.time_step": "auto"}
SIEVES = {"law": "table", "by": "mass", "diameters": [0.01, 0.02], "passing": [0.0, 1.0]}


def load(**changes):
    return drumrs.baseline().replace({**TWO, **changes})


def with_contacts(steel, ore, *pairs):
    species = [{**STEEL, "contact": steel}, {**ORE, "contact": ore}]
    return load(**{"load.species": species, "contact.pair": list(pairs)})


def law_of(config, one, other):
    return next(law for law in laws(config.load, config.contact) if {*law.between} == {one, other})


def test_a_load_holds_its_shares_and_its_fill():
    config = load(**{"load.fill": 0.3})
    simulation = drumrs.Simulation(config)
    area = np.pi * simulation.radii**2
    assert area.sum() / (math.pi * 0.2375**2) == pytest.approx(0.3, abs=area.max() / (math.pi * 0.2375**2))
    steel = simulation.masses[np.asarray(simulation.state.species) == 0]
    assert steel.sum() / simulation.masses.sum() == pytest.approx(0.2, abs=0.01)
    assert steel == pytest.approx(7800.0 * math.pi * 0.01**2)
    assert (len(steel), simulation.count) == (config.species_counts["steel-ball"], config.bundle_count)
    assert config.fill == pytest.approx(0.3, abs=1e-3)


def test_derived_numbers_are_those_of_the_simulation():
    config = load()
    derived, simulation = config.derived, drumrs.Simulation(config)
    assert derived.load_mass == pytest.approx(simulation.masses.sum(), rel=1e-12)
    assert derived.time_step == simulation.time_step
    assert {
        "bundle": derived.bundle.collision_time,
        "drum": derived.drum.collision_time,
    } == simulation.collision_time
    ore = derived.species["ore"]
    diameters = 2.0 * simulation.radii[np.asarray(simulation.state.species) == 1]
    assert (ore.count, ore.smallest, ore.largest) == (len(diameters), diameters.min(), diameters.max())
    assert ore.mass + derived.species["steel-ball"].mass == pytest.approx(derived.load_mass)


def test_one_species_is_the_load_without_any():
    plain = drumrs.baseline(0.2).replace(
        {"load.density": 900.0, "load.diameter": 0.02, "run.time_step": "auto"}
    )
    named = {"load.species": [{"name": "cotton", "density": 900.0, "diameter": 0.02}], "load.fill": 0.2}
    one = drumrs.baseline().replace({**named, "run.time_step": "auto"})
    assert one.bundle_count == plain.bundle_count
    runs = [drumrs.Simulation(config) for config in (plain, one)]
    for run in runs:
        run.run(steps=200)
    assert np.array_equal(runs[0].positions, runs[1].positions)
    assert np.array_equal(runs[0].velocities, runs[1].velocities)


def test_a_species_that_says_nothing_is_a_bundle_of_the_load():
    config = drumrs.baseline().replace({"load.species": [{"name": "red"}]})
    assert config.bundle_count == 100
    assert config.derived.bundle_mass == pytest.approx(drumrs.baseline().derived.bundle_mass, rel=1e-15)


@pytest.mark.parametrize(
    ("changes", "count"),
    [
        ({"load.count": 123}, 123),
        ({"load.bulk_fill": 0.3}, round(0.3 * 0.82 * 400)),
        ({"load.bulk_fill": 0.3, "load.solid_fraction": 0.8}, 96),
        # A bundle has 1000 · π/4 · 0.02375² = 0.443 kg per meter.
        ({"load.mass": 7.0, "drum.depth": 0.35}, round(20.0 / 0.44301)),
        # Water makes bundles heavier, not more.
        ({"load.mass": 7.0, "drum.depth": 0.35, "load.moisture": 0.6}, round(20.0 / 0.44301)),
    ],
)
def test_how_much(changes, count):
    config = drumrs.baseline().replace(changes)
    assert config.bundle_count == count
    species = config.replace({"load.species": [{"name": "cotton"}]})
    assert species.bundle_count == count
    assert species.title.startswith(f"{count} cotton (")


def test_a_mass_of_several_species_is_that_of_all():
    config = load(**{"load.mass": 60.0, "drum.depth": 0.5, "load.moisture": 0.1})
    derived = config.derived
    heaviest = 7800.0 * math.pi * 0.01**2
    assert derived.load_mass / 1.1 == pytest.approx(120.0, abs=heaviest)


def test_water_scales_densities():
    dry, wet = (drumrs.baseline().replace({"load.moisture": water}) for water in (0.0, 1.0))
    assert wet.derived.load_mass == 2.0 * dry.derived.load_mass


def test_another_seed_has_other_sizes():
    radii = [np.sort(drumrs.Simulation(load(**{"run.seed": seed})).radii) for seed in (1, 1, 2)]
    assert np.array_equal(radii[0], radii[1])
    assert not np.array_equal(radii[0], radii[2])
    assert radii[0] == pytest.approx(radii[2], rel=0.05)


def test_titles_and_digests_tell_loads_apart():
    config = load(**{"load.count": 100})
    counts = config.species_counts
    assert sum(counts.values()) == 100
    assert config.title.startswith(f"{counts['steel-ball']} steel-ball + {counts['ore']} ore (")
    assert config.digest != config.replace({"load.share_by": "number"}).digest
    assert drumrs.baseline().digest == drumrs.baseline().replace({"load.species": None}).digest


def test_files_hold_species_as_lists_of_tables():
    config = with_contacts({"friction": 0.1}, {}, {"between": ["ore", "drum"], "friction": 0.9})
    text = config.to_toml()
    assert '[[load.species]]\nname = "steel-ball"\nshare = 0.2\n' in text
    assert '[[contact.pair]]\nfriction = 0.9\nbetween = ["ore", "drum"]' in text
    assert Config.from_toml(text) == config


def test_the_table_of_laws_is_printed(drum, tmp_path):
    config = with_contacts({"friction": 0.1}, {}, {"between": ["ore", "drum"], "friction": 0.9})
    path = tmp_path / "mill.toml"
    path.write_text(config.to_toml(comments=False))
    status, printed, _ = drum("config", path)
    assert status == 0
    assert Config.from_toml(printed) == config
    rows = [line.split() for line in printed.splitlines() if line.startswith("# ")]
    (names,) = (row for row in rows if row[1] == "between")
    place = names.index("friction") + 2  # "a - b" is three words
    mean = f"{math.sqrt(0.1 * 0.5):.4g}"
    found = {(row[1], row[3]): (row[place], row[-1]) for row in rows if row[2:3] == ["-"]}
    assert found["steel-ball", "ore"][0] == mean
    assert found["ore", "drum"] == ("0.9", "contact.pair[0]")
    counts = config.species_counts
    assert ["#", "ore", str(counts["ore"])] in [row[:3] for row in rows]


def test_frames_know_the_species(tmp_path):
    config = load(**{"load.count": 20})
    simulation = drumrs.Simulation(config)
    frames = simulation.frames
    assert Counter(frames.species) == config.species_counts
    frames.save(tmp_path / "frames.parquet")
    assert Frames.load(tmp_path / "frames.parquet").species == frames.species == simulation.species
    table = frames.table()
    assert set(table.filter(pl.col("species") == "steel-ball")["radius"]) == {0.01}
    assert "species" not in drumrs.Simulation(drumrs.baseline(0.05)).frames.table().columns


def test_densities_in_other_units_are_told():
    with_typo = [{"name": "steel-ball", "density": 2.7}]
    (hint,) = drumrs.baseline().replace({"load.species": with_typo, "run.time_step": "auto"}).hints
    assert hint.startswith("load.species[0].density is 2.7 kg/m³, below 5: write 2700 where g/cm³ were meant")


def test_unlike_laws_are_mixed():
    steel = LinearContact(
        normal_stiffness=9e7,
        stiffness_ratio=0.5,
        restitution=0.9,
        friction=0.2,
        adhesion=4.0,
        rolling_friction=0.0,
        young_modulus=2e11,
    )
    ore = LinearContact(
        normal_stiffness=1e7,
        restitution=0.4,
        friction=0.8,
        adhesion=9.0,
        rolling_friction=0.3,
        tension="clipped",
        young_modulus=5e10,
        poisson_ratio=0.2,
    )
    law = LinearContact(**mixed(steel, ore))
    stiffness = 2.0 * 9e7 * 1e7 / (9e7 + 1e7)
    shear = 2.0 * 4.5e7 * 1e7 / (4.5e7 + 1e7)
    assert law.normal_stiffness == pytest.approx(stiffness)
    assert law.stiffness_ratio == pytest.approx(shear / stiffness)
    assert law.young_modulus == pytest.approx(2.0 * 2e11 * 5e10 / 2.5e11)
    means = (law.restitution, law.friction, law.adhesion, law.rolling_friction, law.poisson_ratio)
    assert means == pytest.approx((0.6, 0.4, 6.0, 0.0, math.sqrt(0.06)))
    assert law.tension == "clipped"


def test_equal_laws_mix_to_themselves():
    law = LinearContact(normal_stiffness=0.1 + 0.2, restitution=1.0 / 3.0, friction=1e-3 / 3.0)
    assert mixed(law, law.model_copy()) == law.model_dump()


def test_every_pair_has_its_law():
    config = with_contacts(
        {"normal_stiffness": 4e7, "friction": 0.1},
        {"normal_damping": 4e3},
        {"between": ["ore", "steel-ball"], "restitution": 0.3},
        {"between": ["ore", "drum"], "friction": 0.9},
    )
    found = {law.between: law for law in laws(config.load, config.contact)}
    assert list(found) == [
        ("steel-ball", "steel-ball"),
        ("steel-ball", "ore"),
        ("ore", "ore"),
        ("steel-ball", "drum"),
        ("ore", "drum"),
    ]
    both = found["steel-ball", "ore"]
    assert (both.key, both.table.restitution, both.table.normal_damping) == ("contact.pair[0]", 0.3, None)
    assert both.table.normal_stiffness == pytest.approx(2.0 * 4e7 * 9.25e7 / (4e7 + 9.25e7))
    assert both.table.friction == pytest.approx(math.sqrt(0.1 * 0.5))
    assert found["steel-ball", "drum"].table.normal_stiffness == 4e7
    assert found["steel-ball", "drum"].key == "load.species[0].contact"
    assert (found["ore", "drum"].table.friction, found["ore", "drum"].table.normal_damping) == (0.9, 4e3)
    core = json.loads(config.to_core_json())["contact"]
    assert [law["between"] for law in core["pairs"]] == [[0, 0], [0, 1], [1, 1]]
    assert [law["parameters"]["friction"] for law in core["walls"]] == [0.1, 0.9]


def test_softer_springs_are_softer_for_every_pair():
    config = with_contacts(
        {"normal_stiffness": 4e7},
        {"normal_damping": 100.0},
        {"between": ["ore", "steel-ball"], "restitution": 0.3},
    )
    soft = config.softer(4.0)
    for before, after in zip(laws(config.load, config.contact), laws(soft.load, soft.contact), strict=True):
        assert after.table.normal_stiffness == pytest.approx(before.table.normal_stiffness / 4.0)
        assert after.table.restitution == before.table.restitution
    assert law_of(soft, "ore", "drum").table.normal_damping == 50.0


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"load.share_by": None},
            "load.share_by is missing, but must be 'mass', 'area' or 'number' where there are",
        ),
        ({"load.share_by": "weight"}, "load.share_by is 'weight', but must be 'mass', 'area' or 'number'"),
        (
            {"load.species": [STEEL, {**ORE, "share": 0.7}]},
            "the share of load.species is 0.9 in all, but must be 1 in all",
        ),
        (
            {"load.species": [{**STEEL, "share": 20}, {**ORE, "share": 80}]},
            "is 100 in all, but must be 1 in all: 20 % is 0.2",
        ),
        (
            {"load.species": [STEEL, {"name": "ore"}]},
            "load.species[1].share is missing, but must be given where there are several species",
        ),
        (
            {"load.species": [STEEL, STEEL]},
            "load.species[1].name is 'steel-ball', but must be another name than that of load.species[0]",
        ),
        (
            {"load.species": [{"name": "drum"}]},
            "load.species[0].name is 'drum', but must be a word of letters",
        ),
        ({"load.species": [{"name": "a b"}]}, "load.species[0].name is 'a b', but must be a word of letters"),
        ({"load.species": [{"share": 1.0}]}, "load.species[0].name is missing"),
        ({"load.species": [{"name": "a", "densty": 1.0}]}, "did you mean load.species[0].density?"),
        (
            {"load.species": [{"name": "a", "diameter": 0.02, "sizes": SIEVES}]},
            "load.species[0].diameter and load.species[0].sizes are both given",
        ),
        (
            {"load.species": [{"name": "a", "density": -1.0}]},
            "load.species[0].density is -1.0, but must be a positive",
        ),
        (
            {"load.species": "steel"},
            "load.species is 'steel', but must be a list of tables with the key name",
        ),
        (
            {"load.species": [{"name": "a", "contact": {"restitution": 0.3, "normal_damping": 3.0}}]},
            "load.species[0].contact.restitution and load.species[0].contact.normal_damping are both given",
        ),
        (
            {"contact.pair": [{"between": ["steel", "drum"]}]},
            "contact.pair[0].between is ['steel', 'drum'], but must be two names of load.species, or one and 'drum'; "
            "there are steel-ball, ore; did you mean 'steel-ball'?",
        ),
        (
            {"contact.pair": [{"between": ["drum", "drum"]}]},
            "contact.pair[0].between is ['drum', 'drum'], but must be",
        ),
        (
            {"contact.pair": [{"between": ["ore"]}]},
            "contact.pair[0].between is ['ore'], but must be a pair of names",
        ),
        (
            {"contact.pair": [{"between": [0, 1]}]},
            "contact.pair[0].between[0] is 0, but must be a pair of names",
        ),
        ({"contact.pair": [{"friction": 0.3}]}, "contact.pair[0].between is missing"),
        (
            {"contact.pair": [{"between": ["ore", "drum"], "frction": 0.3}]},
            "did you mean contact.pair[0].friction?",
        ),
        (
            {"contact.pair": [{"between": ["ore", "drum"], "friction": -1.0}]},
            "contact.pair[0].friction is -1",
        ),
        (
            {"contact.pair": [{"between": ["ore", "drum"]}, {"between": ["drum", "ore"]}]},
            "contact.pair[1].between is ['drum', 'ore'], but must be another than contact.pair[0].between",
        ),
        (
            {"load.species": None, "contact.pair": [{"between": ["steel", "drum"]}]},
            "contact.pair[0].between is ['steel', 'drum'], but must be two names of load.species",
        ),
        ({"load.mass": 5.0}, "drum.depth is missing, but must be given where load.mass is"),
        ({"load.mass": 5.0, "load.count": 5}, "load.count and load.mass are both given (5 and 5.0)"),
        ({"load.fill": 0.2, "load.bulk_fill": 0.2}, "load.fill and load.bulk_fill are both given"),
        (
            {"load.fill": None},
            "load.fill is missing, but must be given, or load.count or load.bulk_fill or load.mass instead",
        ),
        (
            {"load.solid_fraction": 0.8},
            "load.solid_fraction is 0.8, but must be left out: it goes with load.bulk_fill",
        ),
        ({"load.mass": 1e-9, "drum.depth": 1.0}, "load.mass is 1e-09, but must be between"),
        ({"load.fill": 1e-9}, "load.fill is 1e-09, but must be between"),
        ({"load.moisture": -0.1}, "load.moisture is -0.1, but must be a finite number of at least 0"),
    ],
)
def test_bad_loads_are_refused_in_a_sentence(changes, sentence):
    with pytest.raises(ConfigError) as refused:
        load(**changes)
    assert sentence in str(refused.value)


def sized(**sizes):
    return load(**{"load.species": [{"name": "ore", "sizes": {"by": "mass", **sizes}}]})


@pytest.mark.parametrize(
    ("sizes", "sentence"),
    [
        ({"law": "gaudin"}, "law is 'gaudin', but must be one of 'mix', 'table', 'gaudin-schuhmann'"),
        ({"law": "normal", "by": None, "mean": 0.02, "sigma": 1e-3}, "by is None, but must be 'mass'"),
        (
            {"law": "gaudin-schuhmann", "top_size": 0.03},
            "modulus is missing, but must be given: the law 'gaudin-schuhmann' has top_size and modulus, and may have "
            "smallest",
        ),
        (
            {"law": "normal", "mean": 0.02, "sigma": 1e-3, "modulus": 3.0},
            "modulus is 3.0, but must be left out: the law 'normal' has mean and sigma, and may have smallest and",
        ),
        (
            {"law": "rosin-rammler", "size_63": 0.03, "modulus": 1.2},
            "smallest is missing, but must be given where the modulus is at most 2, here 1.2: the number of discs goes",
        ),
        ({"law": "mix", "diameters": [0.02], "shares": [0.9]}, "shares is 0.9 in all, but must be 1 in all"),
        (
            {"law": "mix", "diameters": 0.02, "shares": [1.0]},
            "diameters is 0.02, but must be a list of numbers",
        ),
        (
            {**SIEVES, "passing": [1.0, 0.0]},
            "passing[1] is 0, but must be at least the one before it, 1: what passes",
        ),
        (
            {**SIEVES, "passing": [0.0, 100.0]},
            "passing[1] is 100, but must be 1, at a diameter that all is smaller",
        ),
    ],
)
def test_bad_size_laws_are_refused_in_a_sentence(sizes, sentence):
    with pytest.raises(ConfigError) as refused:
        sized(**sizes)
    assert f"load.species[0].sizes.{sentence}" in str(refused.value)


def test_bundles_larger_than_the_drum_are_refused():
    with pytest.raises(
        ConfigError, match=r"load.species\[0\].diameter is 0.5, but must be smaller than drum.diameter"
    ):
        drumrs.Simulation(load(**{"load.species": [{"name": "a", "diameter": 0.5}], "load.count": 1}))
    config = sized(law="mix", diameters=[0.02, 0.5], shares=[0.5, 0.5]).replace({"load.count": 1000})
    with pytest.raises(ConfigError, match=r"load.species\[0\].sizes is up to 0.5000 m, but must be smaller"):
        drumrs.Simulation(config)


def test_a_share_too_small_for_one_bundle_is_refused():
    species = [{**STEEL, "share": 1e-3}, {**ORE, "share": 0.999}]
    config = load(**{"load.species": species, "load.share_by": "number", "load.count": 100})
    with pytest.raises(
        ConfigError, match=r"load.species\[0\].share is 1.000e-3 of the number, but must be enough for"
    ):
        drumrs.Simulation(config)


def test_two_bodies_with_different_losses_need_a_word():
    with pytest.raises(ConfigError) as refused:
        with_contacts({"restitution": 0.3}, {"normal_damping": 100.0})
    assert str(refused.value) == (
        "contact.pair[steel-ball, ore].restitution is missing, but must be given: of steel-ball and ore one has "
        'restitution, the other normal_damping; write [[contact.pair]] with between = ["steel-ball", "ore"] and '
        "restitution"
    )


@pytest.mark.parametrize("amount", [{}, {"load.mass": 1.0, "drum.depth": 0.5}, {"load.bulk_fill": 0.3}])
@pytest.mark.parametrize(
    "sizes", [{"drum.diameter": 1e155}, {"drum.diameter": 1e201, "load.diameter": 1e200}]
)
@pytest.mark.parametrize("species", [{}, TWO])
def test_sizes_whose_squares_overflow_are_refused_or_counted(amount, sizes, species):
    with contextlib.suppress(ConfigError):
        assert Config().replace({**species, **amount, **sizes}).bundle_count < 10**7


def test_too_much_is_said_in_the_words_of_the_file():
    with pytest.raises(ConfigError, match=r"load.mass is 400.0 \(903 bundles\), but must be at most"):
        drumrs.Simulation(drumrs.baseline().replace({"load.mass": 400.0, "drum.depth": 1.0}))
    with pytest.raises(ConfigError, match=r"load.bulk_fill is 30.0 .* a fill of 30 % is 0.3"):
        drumrs.Simulation(drumrs.baseline().replace({"load.bulk_fill": 30.0}))
