"""Errors carry fields, make their messages of them, pickle, and belong to the families that callers catch."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import drumrs
from drumrs import errors

# So fast that they overlap too deep within a few steps.
PRESSED = drumrs.State(positions=[[0.0, 0.0], [0.0238, 0.0]], velocities=[[30.0, 0.0], [-30.0, 0.0]])


def of(action, kind):
    with pytest.raises(kind) as caught:
        action()
    return caught.value


def unstable():
    config = drumrs.baseline().replace({"run.overlap_limit": 0.1, "run.duration": 0.1, "run.time_step": 1e-5})
    return of(drumrs.Simulation(config, state=PRESSED).run, errors.UnstableError)


def fields(error):
    return {key: value for key, value in vars(error).items() if not key.startswith("__")}


@pytest.mark.parametrize(
    ("error", "family", "message"),
    [
        (errors.DrumrsError("one sentence"), Exception, "one sentence"),
        (
            errors.ConfigError("load.fill", 2.0, "at most 1"),
            ValueError,
            "load.fill is 2.0, but must be at most 1",
        ),
        (
            errors.ConfigError("x", problem="is not a key", hint="write y"),
            ValueError,
            "x is not a key; write y",
        ),
        (errors.ConfigError(Path("a b"), problem="is damaged"), ValueError, "'a b' is damaged"),
        (errors.UnstableError("it broke", "shorten it", bundle=3), RuntimeError, "it broke; shorten it"),
        (
            errors.CheckpointError("it is damaged", "a.ckpt", "begin anew"),
            ValueError,
            "cannot use the checkpoint 'a.ckpt': it is damaged; begin anew",
        ),
        (errors.CheckpointError("it is damaged"), ValueError, "cannot use this checkpoint: it is damaged"),
    ],
)
def test_errors_pickle_with_their_fields(error, family, message):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error) == message
    assert fields(again) == fields(error)
    assert isinstance(again, errors.DrumrsError)
    assert isinstance(again, family)


def test_a_refused_value_has_key_value_and_limit():
    error = of(lambda: drumrs.baseline(fill=-0.1), errors.ConfigError)
    assert (error.key, error.value, error.limit) == ("load.fill", -0.1, "a positive finite number")
    assert str(error) == "load.fill is -0.1, but must be a positive finite number"


def test_a_misspelled_key_has_a_hint():
    error = of(lambda: drumrs.baseline().replace({"drum.bafles.count": 3}), errors.ConfigError)
    assert (error.key, error.value) == ("drum.bafles", {"count": 3})
    assert error.hint == "did you mean drum.baffles?"


def test_keys_that_do_not_go_together_name_their_table():
    error = of(
        lambda: drumrs.baseline().replace({"drum.rim": False, "drum.baffles.count": 3}), errors.ConfigError
    )
    assert (error.key, error.value, error.limit) == ("drum.baffles.count", 3, "0 where drum.rim is false")


def test_the_core_raises_with_fields():
    error = of(
        lambda: drumrs.Simulation(drumrs.baseline().replace({"run.time_step": 1e-3})), errors.ConfigError
    )
    assert (error.key, error.value) == ("run.time_step", 1e-3)
    assert error.bound == pytest.approx(drumrs.baseline().derived.drum.collision_time / 10.0, rel=0.5)
    assert error.hint == 'or set run.time_step = "auto"'
    # What the message says is taken.
    digits = error.limit.split()[2].rstrip(",")
    assert len(digits) == len("1.904e-5")
    assert drumrs.Simulation(drumrs.baseline().replace({"run.time_step": float(digits)})).step == 0
    assert 0.999 * error.bound < float(digits) <= error.bound


def test_a_load_that_does_not_fit_has_the_greatest_number():
    config = drumrs.baseline().replace({"load.count": 500})
    error = of(lambda: drumrs.Simulation(config), errors.ConfigError)
    assert (error.key, error.value) == ("load.count", 500)
    assert error.limit.startswith(f"at most {error.bound}: no more bundles")
    by_fill = of(lambda: drumrs.Simulation(drumrs.baseline(fill=1.25)), errors.ConfigError)
    assert (by_fill.key, by_fill.value) == ("load.fill", 1.25)
    assert by_fill.bound == drumrs.baseline().fill_of(error.bound)


def test_an_overlap_at_the_start_has_its_ratio():
    state = drumrs.State(positions=[[0.0, 0.0], [0.01, 0.0]])
    error = of(lambda: drumrs.Simulation(drumrs.baseline(), state=state), errors.ConfigError)
    assert error.key == "state.positions[0]"
    assert error.value == pytest.approx((0.02375 - 0.01) / 0.011875)
    assert error.bound == 0.1
    assert str(error) == f"{error.key} {error.problem}; {error.hint}"


def test_an_unstable_run_says_which_bundle_when_and_where():
    error = unstable()
    assert error.bundle in {0, 1}
    assert error.step > 0
    assert error.time == pytest.approx(error.step * 1e-5)
    assert np.hypot(*error.position) < 0.2375
    assert error.speed > 0.0
    assert error.value > error.limit == 0.1
    assert f"at step {error.step} " in str(error)
    assert str(error).endswith(error.hint)
    assert fields(pickle.loads(pickle.dumps(error))) == fields(error)


def test_a_checkpoint_that_cannot_be_used_is_named(tmp_path):
    path = tmp_path / "run.ckpt"
    path.write_bytes(b"drumrs checkpoint 99\n" + bytes(64))
    error = of(lambda: drumrs.Simulation.load(path), errors.CheckpointError)
    assert error.path == str(path)
    assert error.reason == "it is of version '99', but must be of '1'"
