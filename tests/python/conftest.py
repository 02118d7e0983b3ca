"""A short run to share, and the command line called in this process."""

import os
import shutil
import signal

import hypothesis
import pytest

import drumrs
from drumrs.cli import run_command

# A shell that starts the tests in the background has them ignore Ctrl-C, which some are about.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# How long an example takes depends on what else the machine does.
hypothesis.settings.register_profile("drumrs", deadline=None)
hypothesis.settings.load_profile("drumrs")

SHORT = {"run.duration": 0.06, "run.sample_every": 0.001, "run.frame_every": 0.01}


@pytest.fixture(autouse=True)
def _no_lines_of_progress(monkeypatch):
    """Let no line of progress come within a test, however slow the machine is."""
    monkeypatch.setattr("drumrs.progress._FIRST_PAUSES", (600.0,))


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


# Not for the whole session: while it is there, this thread seems to be in an event loop, which others may mind.
@pytest.fixture(scope="module")
def browser():
    """Start the system's Chromium, driven by Playwright; none is ever downloaded."""
    from playwright.sync_api import sync_playwright

    found = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if found is None:
        sentence = "no Chromium is on the path: install it (apt-get install chromium) to test the pages"
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(sentence)
    with sync_playwright() as driver:
        # As root, as in a container, Chromium starts without its sandbox only.
        flags = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        running = driver.chromium.launch(executable_path=found, args=flags)
        yield running
        running.close()
