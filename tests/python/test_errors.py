"""Errors pickle, and belong to the families that callers catch."""

import pickle

import pytest

from drumrs import errors


@pytest.mark.parametrize(
    ("kind", "family"),
    [
        (errors.DrumrsError, Exception),
        (errors.ConfigError, ValueError),
        (errors.UnstableError, RuntimeError),
        (errors.CheckpointError, ValueError),
    ],
)
def test_errors_pickle(kind, family):
    error = pickle.loads(pickle.dumps(kind("one sentence")))
    assert type(error) is kind
    assert str(error) == "one sentence"
    assert isinstance(error, errors.DrumrsError)
    assert isinstance(error, family)
