"""What is told phase by phase: the summary's numbers, works that add up, and works known in closed form."""

import math

import numpy as np
import polars as pl
import pytest

import drumrs
from drumrs.errors import DrumrsWarning
from drumrs.verification import scenes
from drumrs.verification.scenes import DRUM_RADIUS, GRAVITY, MASS, RADIUS

RHYTHM = {
    "repeat": 2,
    "reversing": True,
    "phase": [
        {"name": "tumble", "duration": 0.02, "rpm": 54.0},
        {"name": "stop", "duration": 0.01, "rpm": 0.0},
    ],
}


def rpm(angular_velocity: float) -> float:
    return angular_velocity * 30.0 / math.pi


@pytest.fixture(scope="module")
def simulation():
    """Reverse a small load, which takes off in 0.07 s, in the middle of the last phase."""
    phases = [RHYTHM, {"name": "up", "duration": 1.0, "ramp": [0.0, 54.0]}]
    config = (
        drumrs.baseline(0.1, baffles=True)
        .softer(100.0)
        .replace({"run.duration": 0.07, "load.start_speed": 1.0})
    )
    with pytest.warns(DrumrsWarning, match="what comes later is not simulated"):
        simulation = drumrs.Simulation(config.replace({"rotation.phase": phases}))
    simulation.run()
    return simulation


@pytest.fixture(scope="module")
def table(simulation):
    return drumrs.phases(simulation.result())


def test_a_row_for_each_phase_that_has_begun(table):
    assert table["phase"].to_list() == ["tumble", "stop", "tumble", "stop", "up"]
    assert table["number"].to_list() == [1, 1, 2, 2, 1]
    assert table["start"].to_list() == pytest.approx([0.0, 0.02, 0.03, 0.05, 0.06])
    assert table["end"].to_list() == pytest.approx([0.02, 0.03, 0.05, 0.06, 0.07], abs=1e-4)


def test_means_are_those_of_the_summary(simulation, table):
    for row in table.iter_rows(named=True):
        summary = simulation.summary((row["start"], row["end"]))
        same = [name for name in table.columns if hasattr(summary, name)]
        assert {name: row[name] for name in same} == {name: getattr(summary, name) for name in same}
        assert len(same) > 20


def test_works_add_up_to_that_of_the_run(simulation, table):
    assert table["phase_work"].sum() == pytest.approx(simulation.series["drum_work"][-1], rel=1e-12)
    mass = simulation.masses.sum()
    assert table["phase_specific_work"].to_list() == pytest.approx(
        (table["phase_work"] / mass).to_list(), rel=1e-9
    )


def test_the_ledger_closes_over_jumps_and_reversals(simulation):
    assert simulation.series["dissipated_sliding"][-1] > 0.0
    assert simulation.series["energy_residual"].max() < 1e-12
    assert simulation.summary((0.0, 0.07)).power_disagreement < 1e-10


def test_a_phase_between_two_samples_has_no_means(simulation):
    phases = [{"name": "blink", "duration": 1e-5, "rpm": 1.0}, {"name": "rest", "duration": 9.0, "rpm": 1.0}]
    config = simulation.config.replace({"rotation.phase": phases})
    table = drumrs.phases(drumrs.Result(config, None, simulation.series, None))
    assert table["phase_work"].to_list()[0] is None
    assert table["phase_work"].to_list()[1] == simulation.series["drum_work"][-1]


def test_without_phases_there_is_no_row(simulation):
    config = simulation.config.replace({"rotation.rpm": 54.0})
    assert drumrs.phases(drumrs.Result(config, None, simulation.series, None)).is_empty()


def test_every_column_has_a_unit_and_a_meaning(table):
    assert {column.name for column in drumrs.registry.known(table.columns)} == set(table.columns) - {"phase"}


def test_work_of_a_ramp_is_the_kinetic_energy_of_what_the_drum_carries():
    count, slow, fast = 6, 20.0, 30.0
    orbit = DRUM_RADIUS - RADIUS
    angles = np.linspace(0.0, math.tau, count, endpoint=False)
    positions = orbit * np.column_stack([np.cos(angles), np.sin(angles)])
    velocities = slow * np.column_stack([-positions[:, 1], positions[:, 0]])
    state = drumrs.State(positions, velocities, angular_velocities=np.full(count, slow))
    phases = [
        {"name": "settle", "duration": 0.02, "rpm": rpm(slow)},
        {"name": "up", "duration": 0.1, "ramp": [rpm(slow), rpm(fast)]},
        {"name": "carry", "duration": 0.02, "rpm": rpm(fast)},
    ]
    # Rolling friction keeps the discs from rolling on the rim that is accelerated.
    law = {"contact.drum.friction": 2.0, "contact.drum.rolling_friction": 2.0}
    config = scenes.drum({**law, "gravity": (0.0, 0.0), "rotation.phase": phases})
    table = drumrs.phases(scenes.after(config, state, 0.14, samples=1400).result())
    up = table.row(by_predicate=pl.col("phase") == "up", named=True)
    inertia = count * (MASS * orbit**2 + 0.5 * MASS * RADIUS**2)
    losses = (
        sum(up[f"dissipated_{name}_power"] for name in ("normal", "sliding", "tangential", "rolling")) * 0.1
    )
    gained = 0.5 * inertia * (fast**2 - slow**2)
    assert up["phase_work"] == pytest.approx(gained + losses, rel=3e-3)
    assert losses < 0.01 * gained


def test_a_locked_disc_takes_the_same_impulse_in_every_period_at_any_speed():
    slow, duration, friction = 1.0, 0.1, 0.5
    angle = math.atan(friction)
    orbit = DRUM_RADIUS - RADIUS + MASS * GRAVITY * math.cos(angle) / scenes.WALL_STIFFNESS
    state = drumrs.State([[orbit * math.sin(angle), -orbit * math.cos(angle)]])
    period = [
        {"name": "slow", "duration": duration, "rpm": rpm(slow)},
        {"name": "fast", "duration": duration, "rpm": rpm(2.0 * slow)},
    ]
    changes = {"load.spin_locked": True, "contact.drum.friction": friction}
    config = scenes.drum({**changes, "rotation.phase": [{"phase": period, "repeat": 3}]})
    table = drumrs.phases(scenes.after(config, state, 6.0 * duration, samples=6000).result())
    torque = MASS * GRAVITY * DRUM_RADIUS * math.sin(angle)
    assert table["drum_torque"].to_list() == pytest.approx([torque] * 6, rel=2e-3)
    assert table["phase_work"].to_list() == pytest.approx(
        [torque * slow * duration * k for k in (1, 2) * 3], rel=2e-3
    )
    impulse = (table["drum_torque"] * duration).sum()
    assert impulse == pytest.approx(3.0 * (table["drum_torque"][:2] * duration).sum(), rel=2e-3)


def test_they_are_saved_and_printed(tmp_path, drum, simulation):
    case = tmp_path / "case.toml"
    case.write_text(simulation.config.to_toml(), encoding="utf-8")
    status, printed, _ = drum("run", case, "--out", tmp_path / "out")
    assert status == 0
    kept = pl.read_parquet(tmp_path / "out" / "phases.parquet")
    assert kept.columns == drumrs.phases(drumrs.load(tmp_path / "out")).columns
    assert f"wrote {tmp_path / 'out' / 'phases.parquet'}" in printed
    rows = [line.split()[:3] for line in printed.splitlines()]
    assert ["tumble", "2", "0.04"] in rows
    plain = drumrs.load(tmp_path / "out")
    config = plain.config.replace({"rotation.rpm": 54.0})
    drumrs.save(
        drumrs.Result(config, plain.summary, plain.series, plain.frames),
        tmp_path / "out",
        pictures=False,
        force=True,
    )
    assert not (tmp_path / "out" / "phases.parquet").exists()
