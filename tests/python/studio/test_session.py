"""A session is the batch run of its case, bit for bit, whatever is done to it."""

import math
import struct
import time

import pytest

import drumrs
from drumrs.errors import ConfigError, DrumrsError
from drumrs.studio import Session

QUICK = {"run.duration": 0.5, "run.frame_every": 0.01, "run.time_step": "auto"}


@pytest.fixture
def quick() -> drumrs.Config:
    return drumrs.baseline(fill=0.1, baffles=True).softer(100.0).replace(QUICK)


def reach(session: Session, until: float) -> None:
    """Wait until a session has come so far."""
    deadline = time.monotonic() + 60.0
    while session.view.frame and now(session) < until:
        assert time.monotonic() < deadline
        session.wait(session.view.number, 1.0)


def now(session: Session) -> float:
    return struct.unpack_from("<d", session.view.frame, 8)[0]


def assert_is_run_of_its_case(session: Session) -> None:
    session.pause()
    series, case = session.series(), session.case()
    result = drumrs.run(drumrs.Config.from_toml(case.to_toml()), progress=False)
    assert len(series) > 20
    assert result.series.head(len(series)).equals(series)


def test_an_untouched_session_is_the_run_of_its_configuration(quick):
    with Session(quick, rate=math.inf) as session:
        reach(session, 0.6)
        session.pause()
        assert session.case().replace({"run.duration": 0.5}) == quick
        series = session.series()
        for _ in range(3):  # reading changes nothing
            session.advance(7)
        assert session.series().head(len(series)).equals(series)
        assert_is_run_of_its_case(session)


def test_a_session_with_changes_of_speed_is_the_run_of_its_case(quick):
    with Session(quick, rate=math.inf) as session:
        for until, rpm in ((0.05, 70.0), (0.1, 20.0), (0.11, -30.0), (0.4, 80.0)):
            reach(session, until)
            session.set_speed(rpm)
        reach(session, 0.7)
        assert session.case().rotation.program[-1][1] == 80.0
        assert_is_run_of_its_case(session)


def test_other_keys_start_anew_from_the_same_seed_at_the_present_speed(quick):
    with Session(quick, playing=False) as session:
        session.advance(200)
        session.set_speed(70.0)
        first = session.view.start
        session.change({"load.fill": 0.2})
        assert session.view.start == first + 1
        assert now(session) == 0.0
        assert session.view.said[-1] == "Started anew from seed 1, with load.fill = 0.2."
        case = session.case()
        assert (case.load.fill, case.rotation.rpm, case.run.time_step) == (0.2, 70.0, "auto")
        session.advance(2000)
        assert_is_run_of_its_case(session)
        session.reset()
        assert (now(session), session.case()) == (0.0, case)


def test_what_cannot_be_is_refused_and_changes_nothing(quick):
    with Session(quick, playing=False) as session:
        session.advance(10)
        for change in (
            lambda: session.change({"load.fill": -1.0}),
            lambda: session.change({"load.full": 0.3}),
            lambda: session.set_speed(math.nan),
            lambda: session.set_rate(0.0),
            lambda: session.change({"load.fill": 0.99}),
        ):
            with pytest.raises(ConfigError):
                change()
        assert session.case() == quick
        session.advance(10)
        assert now(session) > 0.0
    with pytest.raises(DrumrsError, match="closed"):
        session.reset()


def test_time_passes_as_fast_as_asked_for(quick):
    with Session(quick, rate=0.1) as session:
        began = time.perf_counter()
        reach(session, 0.05)
        assert time.perf_counter() - began > 0.4
        session.pause()
        stands = now(session)
        assert session.wait(session.view.number, 0.1).number == session.view.number
        session.advance(1)
        step = now(session) - stands
        assert 0.0 < step < 1e-3


def test_measures_build_up(quick):
    with Session(quick, rate=4.0) as session:
        reach(session, 2.4)  # two thirds of which are more than a turn
        session.pause()
        deadline = time.monotonic() + 60.0
        while session.view.measures.get("window", (0.0, 0.0))[1] < now(session):
            assert time.monotonic() < deadline
            session.wait(session.view.number, 0.1)
        measures = session.view.measures
        tiles = {tile["name"]: tile for tile in measures["tiles"]}
        assert tiles["energy_residual"]["value"] < 1e-9
        assert tiles["drum_power"]["value"] > 0.0
        assert "±" in tiles["drum_power"]["text"]
        assert 0.0 <= tiles["mixed_in_a_turn"]["value"] < 1.0
        assert tiles["falls_per_turn"]["value"] > 0.0
        assert len(measures["panels"]) == 2


def test_a_frame_is_what_it_says(quick):
    with Session(quick, playing=False) as session:
        session.advance(500)
        view, frame = session.view, session.view.frame
        assert len(frame) == 48 + 8 * 40
        start, at, angle, spin, _, _ = struct.unpack_from("<6d", frame)
        assert (start, spin) == (view.start, pytest.approx(54.0 * math.pi / 30.0))
        assert angle == pytest.approx(spin * at)
