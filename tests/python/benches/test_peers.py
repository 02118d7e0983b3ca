"""The comparison with other codes, as far as it goes without them: input, output, verdicts, what is missing."""

import doctest
import math

import numpy as np
import pytest

import codes.agreement
import codes.balance
import codes.speed
import compare
import drumrs
from codes import beds
from codes.balance import Measured, Trace, agree
from codes.case import Case, laws
from codes.lammps import Lammps, read_rows, read_timing
from codes.ours import trace_of
from codes.program import PeerError
from codes.yade import Yade
from drumrs.analysis import Estimate

PRINTED = """Step Atoms
    100 BEGAN:1700000000.250000000
    100
Loop time of 0.1 on 1 procs
ENDED:1700000002.750000000
"""


@pytest.fixture(scope="module")
def case():
    return Case.packed(drumrs.baseline(fill=0.1).replace({"run.duration": 0.06, "run.sample_every": 0.001}))


def program(folder, name, script):
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)


@pytest.mark.parametrize("module", [codes.agreement, codes.balance, codes.speed])
def test_examples_run(module):
    assert doctest.testmod(module).failed == 0


def test_the_laws_are_table_1s(case):
    assert case.pair.damping == pytest.approx(5.35e3, rel=1e-3)
    assert case.wall.damping == pytest.approx(7.74e3, rel=2e-3)
    mass = 1000.0 * math.pi * 0.02375**2 / 4.0
    assert case.pair.damping_rate == pytest.approx(case.pair.damping / (mass / 2.0))
    assert case.wall.damping_rate == pytest.approx(case.wall.damping / mass)


def test_a_law_that_no_deck_has_is_refused():
    with pytest.raises(ValueError, match=r"stiffness_ratio is 0\.5"):
        laws(drumrs.baseline().replace({"contact.bundle.stiffness_ratio": 0.5}))
    hertz = {"contact.base": "hertz", "contact.bundle.young_modulus": 1e8, "contact.drum.young_modulus": 1e8}
    with pytest.raises(ValueError, match="must be 'linear' in every deck"):
        laws(drumrs.baseline().replace(hertz))


def test_the_data_file_holds_the_state(tmp_path):
    simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    simulation.run(steps=1000)
    case = Case(simulation.config, simulation.state)
    case.write_data(tmp_path / "state.data")
    head, atoms, speeds = (
        (tmp_path / "state.data").read_text().replace("Velocities", "Atoms # sphere").split("Atoms # sphere")
    )
    assert "40 atoms" in head
    x, v = (
        np.array([line.split() for line in part.split("\n") if line], dtype=float) for part in (atoms, speeds)
    )
    assert np.array_equal(x[:, 4:6], simulation.positions)
    assert np.array_equal(v[:, 1:3], simulation.velocities)
    assert np.array_equal(v[:, 6], simulation.angular_velocities)


def test_the_clock_is_read_from_a_torn_output():
    timing = read_timing(PRINTED, 1000)
    assert timing.seconds == pytest.approx(2.5)
    assert timing.rate(100) == pytest.approx(40_000.0)


@pytest.mark.parametrize("printed", ["ERROR: lost atoms", PRINTED.replace("ENDED", "ended")])
def test_an_output_without_the_clock_is_told(printed):
    with pytest.raises(PeerError, match="no time taken"):
        read_timing(printed, 1000)


def test_rows_become_powers(case, tmp_path):
    rows = tmp_path / "rows.txt"
    steps = np.arange(0, 2001, 200)
    times = steps * case.time_step
    rows.write_text(
        "# head\n" + "".join(f"{s} 0.1 -0.2 {3.0 * t}\n" for s, t in zip(steps, times, strict=True))
    )
    measured = Measured.over(read_rows(rows, case), (0.0, float(times[-1])))
    assert measured.power.value == pytest.approx(case.angular_velocity * (9.81 * 0.1 + 3.0))
    assert (measured.x.value, measured.y.value) == pytest.approx((0.1, -0.2))


@pytest.mark.parametrize("text", ["", "0 1 2 3\n", "0 1 2 nan\n200 1 2 3\n", "0 1 2\n200 1 2\n", "step x\n"])
@pytest.mark.filterwarnings("ignore:loadtxt")
def test_bad_rows_are_told(case, tmp_path, text):
    (tmp_path / "rows.txt").write_text(text)
    with pytest.raises(PeerError, match=r"rows\.txt"):
        read_rows(tmp_path / "rows.txt", case)


def test_our_own_trace_is_the_power_of_the_balance(case):
    simulation = drumrs.Simulation(case.config, state=case.state)
    simulation.run()
    window = (0.02, 0.06)
    measured = Measured.over(trace_of(simulation), window)
    summary = simulation.summary(window)
    assert measured.power.value == pytest.approx(
        summary.moment_balance_power / simulation.masses.sum(), rel=1e-9
    )
    center = (summary.center_of_mass_x, summary.center_of_mass_y)
    assert (measured.x.value, measured.y.value) == pytest.approx(center, rel=1e-9)


def test_a_window_that_was_not_run_is_refused():
    times = np.linspace(0.0, 1.0, 101)
    trace = Trace(times, np.ones(100), np.ones(100), np.ones(100))
    with pytest.raises(ValueError, match="not"):
        Measured.over(trace, (0.5, 1.5))


def test_agreement_takes_both_errors():
    assert agree(Estimate(4.0, 0.01, 50), Estimate(4.2, 0.1, 50))
    assert not agree(Estimate(4.0, 0.01, 50), Estimate(4.2, 0.02, 50))
    # With few degrees of freedom the interval is wide.
    assert agree(Estimate(4.0, 0.05, 2), Estimate(4.3, 0.05, 2))
    assert not agree(Estimate(4.0, 0.05, 50), Estimate(4.3, 0.05, 50))


def test_what_is_missing_is_named_with_what_installs_it(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert [code.name for code in compare.present(["drumrs", "lammps", "liggghts", "yade"])] == ["drumrs"]
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 3
    assert "apt-get install lammps" in told[0]
    assert "'yade'" in told[2]


def test_a_check_without_another_code_fails(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    assert compare.main(["check", "--codes", "drumrs", "lammps"]) == 1
    assert capsys.readouterr().err.endswith("check needs another code beside drumrs, but there is none\n")


def test_a_code_that_fails_is_told_with_its_last_words(case, monkeypatch, tmp_path):
    program(tmp_path, "lmp", "echo 'ERROR: Lost atoms: original 40 current 39'; exit 1")
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    with pytest.raises(PeerError, match=r"(?s)status 1.*Lost atoms"):
        Lammps().time(case, 10, 10, tmp_path)


def test_a_code_gets_the_case(case, monkeypatch, tmp_path):
    program(tmp_path, "lmp", 'echo "$@" > words; echo BEGAN:1.0; echo ENDED:2.0')
    program(tmp_path, "yade", "echo BEGAN:1.0; echo ENDED:2.0")
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    assert Lammps().time(case, 10, 20, tmp_path).steps == 20
    words = (tmp_path / "words").read_text()
    assert f"-var omega {case.angular_velocity}" in words
    assert "-var timed 20" in words
    assert Yade().time(case, 10, 20, tmp_path).steps == 20
    assert np.loadtxt(tmp_path / "state.txt").shape == (40, 5)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [(["speeed"], "speeed"), (["--repeats", "0"], "--repeats is 0"), (["--sizes", "0"], "--sizes has 0")],
)
def test_bad_options_are_refused(words, sentence, capsys):
    with pytest.raises(SystemExit) as leaving:
        compare.main(words)
    assert leaving.value.code == 2
    assert sentence in capsys.readouterr().err


def test_copies_of_a_piece_do_not_overlap():
    random = np.random.default_rng(1)
    size, diameter = 10.0, 1.0
    lattice = (
        np.array([(i + 0.5 * (j % 2), j * math.sqrt(0.75)) for j in range(12) for i in range(10)]) % size
    )
    places = lattice + random.uniform(-1e-4, 1e-4, lattice.shape)
    places = places[((places >= 0.0) & (places < size)).all(axis=1)]
    kept = places[beds._apart_across_edges(places, size, diameter)]
    assert len(kept) > 0.8 * len(places)
    tiled = np.concatenate([kept + size * np.array(shift) for shift in ((0, 0), (1, 0), (0, 1), (1, 1))])
    gaps = np.hypot(*(tiled[:, None] - tiled[None]).transpose(2, 0, 1)) + 10.0 * np.eye(len(tiled))
    assert gaps.min() > 0.998 * diameter


def test_a_drum_grows_at_one_froude_number():
    config = beds.grown(10_000)
    radius, omega = config.drum.diameter / 2.0, config.rotation.rpm * math.pi / 30.0
    assert omega**2 * radius / 9.81 == pytest.approx(0.774, rel=1e-3)
    assert 10_000 * config.load.diameter**2 / config.drum.diameter**2 == pytest.approx(0.4)


def test_a_settled_drum_goes_on_with_its_baffles_where_they_are(tmp_path, monkeypatch):
    monkeypatch.setattr(beds, "_TUMBLED", 2.0)
    case = beds.settled(100, tmp_path, baffles=True)
    assert case.config.drum.baffles.phase > 30.0
    again = beds.settled(100, tmp_path, baffles=True)
    assert again.config == case.config
    assert np.array_equal(again.motion(), case.motion())
    # A bundle within a baffle, or outside of the drum, would be refused.
    assert drumrs.Simulation(case.config, state=case.state).count == 100


def test_a_large_bed_is_made_of_copies(tmp_path, monkeypatch):
    monkeypatch.setattr(beds, "_LARGEST_TUMBLED", 1000)
    monkeypatch.setattr(beds, "_TUMBLED_LARGE", 2.0)
    case = beds.settled(4000, tmp_path)
    simulation = drumrs.Simulation(case.config.replace({"run.sample_every": 1e-5}), state=case.state)
    simulation.run(steps=20)
    assert simulation.count == 4000
    assert simulation.series["contact_count"][-1] > 200
    # Seen from the drum the bed is nearly at rest.
    seen = beds._turned(case.motion(), -case.angular_velocity)
    assert np.median(np.hypot(seen[:, 2], seen[:, 3])) < 0.5 * case.angular_velocity * case.radius
