"""`drumrs studio` as a command."""

import os
import re
import signal
import subprocess
import sys
import urllib.request
from contextlib import contextmanager

import pytest


@contextmanager
def started():
    """Start the command in a process of its own, which is gone at the end; give it and its address."""
    command = [sys.executable, "-m", "drumrs", "studio", "--no-open", "--set", "load.count=5"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(command, stderr=subprocess.PIPE, env=environment, text=True) as studio:
        said = studio.stderr.readline()
        try:
            yield (
                studio,
                re.search(r"the studio is at (http://127\.0\.0\.1:\d+/\?token=\S+) and ends", said)[1],
            )
        finally:
            studio.kill()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_serves_until_it_is_ended(number):
    with started() as (studio, address):
        with urllib.request.urlopen(address, timeout=30.0) as answer:  # noqa: S310 - our own
            assert b"<title>drumrs studio</title>" in answer.read()
        studio.send_signal(number)
        rest = studio.stderr.read()
        studio.wait(30.0)
    assert (studio.returncode, rest) == (0, "")


def test_a_server_that_is_killed_is_said(browser):
    with started() as (studio, address):
        page = browser.new_page()
        page.goto(address)
        page.wait_for_function("() => window.studio?.recording?.end > 0.01")
        studio.kill()
        page.locator(".trouble").wait_for()
        assert "does not answer" in page.locator(".trouble").inner_text()
        # It stands, and may be looked at.
        page.locator(".mode").select_option("height")
        assert page.evaluate("studio.coloring.name") == "height"
        page.close()


def test_a_case_that_cannot_be_is_refused_before_a_page_is_there(drum):
    status, out, err = drum("studio", "--no-open", "--set", "load.fill=-1")
    assert (status, out) == (2, "")
    assert err.startswith("drumrs: load.fill is -1")


def test_the_extra_is_named_where_it_is_missing(drum, monkeypatch):
    monkeypatch.delitem(sys.modules, "drumrs.studio.server", raising=False)
    monkeypatch.setitem(sys.modules, "starlette.applications", None)
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    status, out, err = drum("studio", "--no-open")
    assert (status, out) == (2, "")
    assert "pip install 'drumrs[studio]'" in err
    assert len(err.splitlines()) == 1
