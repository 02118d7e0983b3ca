"""A short run to share, and the command line called in this process."""

import os

import pytest

os.environ.setdefault("MPLBACKEND", "Agg")

import drumrs
from drumrs.cli import run_command

SHORT = {"run.duration": 0.06, "run.sample_every": 0.001, "run.frame_every": 0.01}


@pytest.fixture
def short() -> drumrs.Config:
    """Simulate 0.06 s of a drum with baffles: a second of work."""
    return drumrs.baseline(fill=0.1, baffles=True).replace(SHORT)


@pytest.fixture
def drum(capsys):
    """Call the command line; return status, standard output, standard error."""

    def call(*words: str) -> tuple[int, str, str]:
        status = run_command([str(word) for word in words])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return call
