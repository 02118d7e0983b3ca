"""What is recorded of contacts: tables that add up to the ledger, in memory, in folders, across breaks, in sweeps."""

import json
import math

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs import measures
from drumrs.contact_records import COLUMNS
from drumrs.errors import ConfigError
from drumrs.run_folder import RunFolder
from drumrs.sweep import Case
from drumrs.sweep.store import Store

RECORD = ["contacts", "wall_profile", "ledger_split", "discs", "fields"]
ZONES = [{"name": "left", "corners": [[-0.24, -0.24], [0.0, -0.24], [0.0, 0.24]], "frame": "drum"}]
FILES = [f"{kind}.parquet" for kind in COLUMNS]
ENERGIES = ["dissipated_normal", "dissipated_tangential", "dissipated_rolling"]
TERMS = {"rolling_friction": 0.1, "tangential_damping_ratio": 0.2}


def recorded(duration: float = 0.3, **changes) -> drumrs.Config:
    config = drumrs.baseline(fill=0.15, baffles=True).softer(100.0)
    return config.replace({"run.record": RECORD, "run.zone": ZONES, "run.duration": duration, **changes})


@pytest.fixture(scope="module")
def result() -> drumrs.Result:
    """Two species with all terms, whose contacts take energy in every way."""
    species = [
        {"name": "heavy", "share": 0.5, "density": 2000.0, "diameter": 0.03},
        {"name": "light", "share": 0.5, "density": 800.0, "diameter": 0.02},
    ]
    terms = {f"contact.{side}.{key}": value for side in ("bundle", "drum") for key, value in TERMS.items()}
    config = drumrs.Config.model_validate(
        {
            "drum": {"baffles": {"count": 3}},
            "load": {"species": species, "share_by": "mass", "fill": 0.2},
            "run": {"record": RECORD, "zone": ZONES, "duration": 0.5, "time_step": "auto"},
        }
    ).softer(100.0)
    return drumrs.run(config.replace(terms), progress=False)


def total(table: pl.DataFrame, columns: list[str]) -> list[float]:
    return [math.fsum(table[name]) for name in columns]


def test_every_table_adds_up_to_the_ledger(result):
    taken = result.dissipated
    assert min(taken.values()) > 0.0
    tangential = taken["dissipated_sliding"] + taken["dissipated_tangential"]
    whole = [taken["dissipated_normal"], tangential, taken["dissipated_rolling"]]
    scale = 1e-12 * sum(whole)
    assert total(result.contacts, ENERGIES) == pytest.approx(whole, abs=scale)
    received = ["received_normal", "received_tangential", "received_rolling"]
    assert total(result.discs, received) == pytest.approx(whole, abs=scale)
    split = result.ledger_split
    assert total(split, list(taken)) == pytest.approx(list(taken.values()), abs=scale)
    walls = total(split.filter(~pl.col("other").is_in(["heavy", "light"])), list(taken))
    there = [walls[0], walls[1] + walls[2], walls[3]]
    assert min(there) > 0.0
    assert total(result.wall_profile, ENERGIES) == pytest.approx(there, abs=scale)


def test_bodies_have_their_names(result):
    pairs = list(result.ledger_split.select("body", "other").iter_rows())
    assert pairs[:4] == [("heavy", "heavy"), ("heavy", "light"), ("light", "light"), ("heavy", "rim")]
    assert len(pairs) == 3 + 2 * 4
    discs, contacts = result.discs, result.contacts
    assert tuple(discs["species"]) == result.frames.species
    assert discs["mass"].to_numpy() == pytest.approx(
        np.pi
        * discs["radius"].to_numpy() ** 2
        * np.where(discs["species"].cast(str) == "heavy", 2000.0, 800.0)
    )
    for row in result.ledger_split.iter_rows(named=True):
        if row["other"] in {"heavy", "light"}:
            kinds = discs["species"].cast(str)
            ends = contacts.filter(pl.col("part").is_null()).select("particle", "other", "dissipated_normal")
            named = [
                loss
                for one, other, loss in ends.iter_rows()
                if {kinds[one], kinds[other]} == {row["body"], row["other"]}
            ]
            assert math.fsum(named) == pytest.approx(row["dissipated_normal"])
    by_part = contacts.drop_nulls("part").group_by("part").agg(pl.col("dissipated_normal").sum())
    for part, loss in by_part.iter_rows():
        of_part = result.ledger_split.filter(pl.col("other") == part)
        assert math.fsum(of_part["dissipated_normal"]) == pytest.approx(loss)
        bins = result.wall_profile.filter(pl.col("part") == part)
        assert math.fsum(bins["dissipated_normal"]) == pytest.approx(loss)


def test_contacts_are_where_and_when_they_happened(result):
    contacts, series = result.contacts, result.series
    at_rim = contacts.filter((pl.col("part") == "rim") & (pl.col("opened") > 0.0))
    radius = result.config.drum.diameter / 2.0
    assert np.hypot(at_rim["x"].to_numpy(), at_rim["y"].to_numpy()) == pytest.approx(radius, abs=1e-3)
    turned = np.interp(contacts["opened"], series["time"], series["drum_angle"])
    assert contacts["drum_angle"].to_numpy() == pytest.approx(turned, abs=0.02)
    assert contacts.filter(pl.col("opened") > 0.0)["normal_speed"].min() > 0.0
    ended = contacts.filter(~pl.col("is_open"))
    ends = ended["opened"] + ended["duration"]
    assert ends.round(9).is_sorted()
    still = contacts.filter(pl.col("is_open"))
    assert abs(len(still) - series["contact_count"][-1]) < 20
    assert (still["opened"] + still["duration"]).to_numpy() == pytest.approx(0.5, abs=1e-4)
    flights = result.discs
    assert (flights["drum_landings"] + flights["load_landings"] <= flights["flights"]).all()
    assert flights["flight_time"].max() <= 0.5 + 1e-4


def test_bins_lie_on_the_outline(result):
    profile, radius = result.wall_profile, result.config.drum.diameter / 2.0
    rim = profile.filter(pl.col("part") == "rim")
    places, normals = rim.select("x", "y").to_numpy(), rim.select("normal_x", "normal_y").to_numpy()
    assert np.hypot(*places.T) == pytest.approx(radius)
    assert (places * normals).sum(axis=1) == pytest.approx(-radius)
    assert rim["arc_end"][-1] == pytest.approx(2.0 * np.pi * radius)
    assert rim["arc_end"][0] == pytest.approx(radius / 20.0, rel=0.01)
    for index, corners in enumerate(result.frames.baffles, start=1):
        bins = profile.filter(pl.col("part") == f"baffle {index}")
        sides = np.diff([*corners, corners[0]], axis=0)
        assert bins["arc_end"][-1] == pytest.approx(np.hypot(*sides.T).sum())
        inward = np.column_stack([bins["x"], bins["y"]]) - corners.mean(axis=0)
        assert (inward * bins.select("normal_x", "normal_y").to_numpy()).sum(axis=1).min() > 0.0


def test_a_folder_holds_the_tables_with_their_units(result, tmp_path):
    drumrs.save(result, tmp_path, pictures=False)
    again = drumrs.load(tmp_path)
    assert again.dissipated == result.dissipated
    for kind, columns in COLUMNS.items():
        assert getattr(again, kind).equals(getattr(result, kind))
        assert getattr(again, kind).columns == [column.name for column in columns]
        words = pl.read_parquet_metadata(tmp_path / f"{kind}.parquet")
        assert json.loads(words["units"]) == {column.name: column.unit for column in columns}
        assert json.loads(words["dissipated"]) == result.dissipated


def test_nothing_is_recorded_unasked(tmp_path):
    result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.01}), progress=False)
    assert result.contact_tables() == {}
    drumrs.save(result, tmp_path, pictures=False)
    assert not set(FILES) & {path.name for path in tmp_path.iterdir()}
    with pytest.raises(ConfigError, match=r"run\.record.*'wall_profile'"):
        drumrs.baseline().replace({"run.record": ["forces"]})


def test_small_contacts_are_one_row():
    whole = drumrs.run(recorded(), progress=False)
    floor = 1e-3
    result = drumrs.run(recorded(**{"run.contact_floor": floor}), progress=False)
    closed = whole.contacts.filter(~pl.col("is_open"))
    energy = closed.select(ENERGIES).sum_horizontal()
    kept, last = result.contacts[:-1], result.contacts[-1]
    assert kept.equals(pl.concat([closed.filter(energy >= floor), whole.contacts.filter(pl.col("is_open"))]))
    assert last["count"].item() == (energy < floor).sum() > 10
    assert last["particle"].item() is None
    assert result.contacts["count"].sum() == len(whole.contacts)
    assert total(result.contacts, ENERGIES) == pytest.approx(total(whole.contacts, ENERGIES))


def test_breaks_leave_the_same_files(tmp_path, monkeypatch):
    """A run that goes to disk in many parts, breaks off after a checkpoint, and goes on; and one in memory."""
    config = recorded(**{"run.contact_floor": 1e-6})
    drumrs.save(drumrs.run(config, progress=False), tmp_path / "memory", pictures=False)
    simulation, folder = drumrs.Simulation(config), RunFolder(tmp_path / "broken")
    folder.begin(config)
    monkeypatch.setattr("drumrs.run_folder.PART_SIZE", 1)
    simulation.run(steps=3001)
    folder.save(simulation)
    simulation.run(steps=1777)
    folder.flush(simulation)
    assert len(list(tmp_path.glob("broken/records/contacts-*.parquet"))) == 2
    again = folder.load(2)
    folder.restore(again)
    assert len(list(tmp_path.glob("broken/records/contacts-*.parquet"))) == 1
    for steps in (500, 700):
        again.run(steps=steps)
        folder.flush(again)
    with pytest.raises(
        ConfigError, match=r"run\.record has 'contacts', but the first \d+ of them are no longer"
    ):
        again.result()
    # With all its records in memory again, it is as if it had never been on disk.
    folder.save(again)
    loaded = drumrs.Simulation.load(tmp_path / "broken" / "checkpoint.bin")
    loaded.run()
    whole = loaded.result()
    assert whole.contacts.equals(pl.read_parquet(tmp_path / "memory" / "contacts.parquet"))
    again.run()
    folder.conclude(again)
    for name in FILES:
        assert (tmp_path / "memory" / name).read_bytes() == (tmp_path / "broken" / name).read_bytes(), name


def test_a_finished_run_goes_on_with_its_contacts(drum, tmp_path):
    goal = ["--until", "0.0001", "--limit", "0.3"]
    record = f"run.record={json.dumps(RECORD)}"
    case = ["--softer", "100", "--set", "load.count=40", "--set", record, "--set", "run.duration=0.1"]
    zone = 'run.zone=[{name="left", corners=[[-0.2, -0.2], [0.0, -0.2], [0.0, 0.2]]}]'
    case += ["--set", "run.window=[0.05, 0.1]", "--set", zone, "--out"]
    assert drum("run", *case, tmp_path / "whole", *goal)[0] == 0
    assert drum("run", *case, tmp_path / "twice")[0] == 0
    assert drum("run", "--resume", tmp_path / "twice", *goal)[0] == 0
    for name in FILES:
        assert (tmp_path / "whole" / name).read_bytes() == (tmp_path / "twice" / name).read_bytes(), name


def test_a_sweep_keeps_the_tables(tmp_path):
    case, store = Case(recorded(0.05)), Store(tmp_path)
    result = drumrs.run(case.config, progress=False)
    store.write(case, result, {})
    assert store.fault(case) is None
    for kind in COLUMNS:
        assert store.contact_table(case, kind).equals(getattr(result, kind))
    (tmp_path / f"{case.id}.discs.parquet").unlink()
    assert "discs" in store.fault(case)


def test_bins_need_a_width():
    with pytest.raises(ConfigError, match=r"run\.arc_bin is 1e-9, but must be at least"):
        drumrs.Simulation(recorded(**{"run.arc_bin": 1e-9}))
    config = recorded(
        **{"drum.rim": False, "drum.baffles.count": 0, "drum.walls": [[[0.0, 0.0], [1.0, 0.0]]]}
    )
    state = drumrs.State(np.array([[0.5, 0.1]]))
    with pytest.raises(ConfigError, match=r"run\.arc_bin is not given, but must be given in a drum without"):
        drumrs.Simulation(config, state=state)
    with pytest.raises(ConfigError, match='without "fields" in a drum without rim'):
        drumrs.Simulation(config.replace({"run.arc_bin": 0.1}), state=state)
    without = {"run.arc_bin": 0.1, "run.record": RECORD[:-1]}
    assert drumrs.Simulation(config.replace(without), state=state).step == 0


def test_frames_hold_velocities_and_numbers_of_contacts(tmp_path):
    """Those of the last frame are what the simulation says then; a bundle in flight is among them."""
    config = drumrs.baseline(fill=0.3, baffles=True).softer(100.0).replace({"run.duration": 0.4})
    simulation = drumrs.Simulation(config)
    simulation.run(steps=10 * round(config.run.frame_every / simulation.time_step))
    frames, contacts = simulation.frames, simulation.state.contacts
    assert frames.times[-1] == simulation.time
    bodies = np.concatenate(
        [contacts["pairs"]["particle"], contacts["pairs"]["other"], contacts["walls"]["particle"]]
    )
    counted = np.bincount(bodies, minlength=frames.count)
    assert counted.min() == 0
    assert np.array_equal(frames.contacts[-1], counted)
    assert np.array_equal(frames.velocities[-1], simulation.velocities.astype(np.float32))
    assert np.allclose(frames.speeds[-1], np.hypot(*simulation.velocities.T), rtol=1e-6)
    frames.save(tmp_path / "frames.parquet")
    again = drumrs.Frames.load(tmp_path / "frames.parquet")
    assert np.array_equal(again.velocities, frames.velocities)
    assert np.array_equal(again.contacts, frames.contacts)


def test_fields_and_visits_begin_with_the_window():
    spray = {"name": "spray", "corners": [[-0.24, -0.24], [0.24, -0.24], [0.24, 0.0], [-0.24, 0.0]]}
    config = recorded(0.3, **{"run.window": [0.1, 0.3], "run.zone": [spray], "run.record": ["fields"]})
    result = drumrs.run(config, progress=False)
    area = result.config.load.diameter**2 / 4.0
    mass = measures.disc_masses(config, result.frames).sum()
    assert result.fields["density"].sum() * area == pytest.approx(mass, rel=1e-12)
    visits = result.zone_visits
    assert visits["id"].to_list() == list(range(config.bundle_count))
    looks = visits["time_inside"].to_numpy() / (32.0 * result.summary.time_step)
    assert looks == pytest.approx(np.rint(looks))
    # What lies below the axis all the time is there for the 0.2 s of the window, and nobody for longer.
    assert visits["time_inside"].max() == pytest.approx(0.2, abs=64.0 * result.summary.time_step)
    assert visits["entries"].sum() > 0
    assert (visits["cycles"] <= visits["entries"]).all()


def test_fields_and_visits_end_with_the_window():
    """As those of a run that ends there; and one that goes on beyond its window has lost nothing."""
    spray = {"name": "spray", "corners": [[-0.24, -0.24], [0.24, -0.24], [0.24, 0.0], [-0.24, 0.0]]}

    def tables(window, *durations):
        asked = {"run.window": window, "run.zone": [spray], "run.record": ["fields"]}
        simulation = drumrs.Simulation(recorded(durations[0], **asked))
        simulation.run()
        for longer in durations[1:]:
            simulation.extend_to(longer)
            simulation.run()
        made = simulation.records.contact_tables()
        return made["fields"], made["zone_visits"]

    def same(one, other):
        return all(own.equals(theirs) for own, theirs in zip(one, other, strict=True))

    early = tables([0.1, 0.2], 0.2)
    assert same(tables([0.1, 0.2], 0.4), early)
    assert same(tables([0.1, 0.2], 0.3, 0.4), tables([0.1, 0.4], 0.4))
    assert not same(tables([0.1, 0.4], 0.4), early)


@pytest.mark.parametrize(
    ("zone", "message"),
    [
        ({"corners": [[1.0, 0.0], [0.3, 0.0], [0.3, 0.1]]}, "zone.0..corners .* in or near the drum"),
        (
            {"corners": [[0.3, 0.0], [0.4, 0.0], [0.3, 0.1]]},
            "outside the drum, but must .* radius is 0.2375 m",
        ),
        ({"corners": [[0.0, 0.0], [0.1, 0.1], [0.1, 0.0], [0.0, 0.1]]}, "sides 1 and 3 cross"),
        ({"corners": [[0.0, 0.0], [0.1, 0.1], [0.2, 0.2]]}, "cross or touch"),
        ({"corners": [[0.0, 0.0], [0.1, 0.1]]}, "at least 3 points"),
        ({"frame": "lab"}, "'laboratory' or 'drum'"),
    ],
)
def test_zones_that_cannot_be_are_refused(zone, message):
    whole = {"name": "spray", "corners": [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]], **zone}
    with pytest.raises(ConfigError, match=message):
        drumrs.Simulation(recorded(**{"run.zone": [whole]}))


def test_zones_and_cells_that_are_too_many_are_refused():
    spray = {"name": "spray", "corners": [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]}
    with pytest.raises(ConfigError, match=r"zone\[1\].name is spray, but must be another name"):
        drumrs.Simulation(recorded(**{"run.zone": [spray, spray]}))
    with pytest.raises(ConfigError, match="at most 64 zones"):
        drumrs.Simulation(recorded(**{"run.zone": [{**spray, "name": str(k)} for k in range(65)]}))
    with pytest.raises(ConfigError, match=r"run.cell is 1e-6, but must be at least 4.750e-4"):
        drumrs.Simulation(recorded(**{"run.cell": 1e-6}))


def test_a_zone_that_was_not_recorded_is_named():
    with pytest.raises(ConfigError, match="no zone named 'spray'"):
        measures.recorded_visits(None, "spray")
