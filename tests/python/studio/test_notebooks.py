"""The studio in real notebooks: JupyterLab and marimo, of an environment of their own, in a browser."""

import json
import os
import socket
import subprocess
import sysconfig
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PYTHON = ROOT / "target" / "notebooks" / "bin" / "python"
CELL = """import drumrs
studio = drumrs.widget(drumrs.baseline(fill=0.1, baffles=True).softer(100.0))
studio"""
PATIENCE = 120_000  # milliseconds: notebooks are slow to start

pytestmark = pytest.mark.slow


@contextmanager
def serving(folder: Path, *words: str) -> Iterator[str]:
    """Serve notebooks from a folder; give the address."""
    if not PYTHON.exists():
        sentence = f"{PYTHON} is not there: make check-long makes it"
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(sentence)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    # drumrs, and what it needs, are those that are tested; settings of notebooks are nobody's.
    path = os.pathsep.join((str(ROOT / "python"), sysconfig.get_path("purelib")))
    environment = {**os.environ, "PYTHONPATH": path, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder)}
    command = [str(PYTHON), "-m", *words, f"--port={port}"]
    with (folder / "log").open("w") as log:
        server = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
    try:
        address = f"http://127.0.0.1:{port}/"
        wait_for(address)
        yield address
    finally:
        server.terminate()
        server.wait(60.0)


def wait_for(address: str) -> None:
    deadline = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < deadline:
        with suppress(OSError), urllib.request.urlopen(address, timeout=10.0):  # noqa: S310 - our own
            return
        time.sleep(0.3)
    raise TimeoutError(address)


@pytest.fixture
def page(browser):
    """Open a page whose widgets must cause no error."""
    context = browser.new_context(viewport={"width": 1400, "height": 1300})
    page, troubles = context.new_page(), []
    page.set_default_timeout(PATIENCE)
    page.on("pageerror", lambda error: troubles.append(str(error)))
    page.on("console", lambda said: troubles.append(said.text) if "anywidget" in said.text else None)
    yield page
    context.close()
    assert troubles == []


def seconds(page) -> float:
    # Nothing is written before the first picture.
    text = page.locator(".time").first.inner_text()
    return float(text.split()[0]) if text else 0.0


def wait_for_seconds(page, least: float) -> None:
    deadline = time.monotonic() + PATIENCE / 1000
    while seconds(page) <= least:
        assert time.monotonic() < deadline
        page.wait_for_timeout(100)


def assert_studio_works(page) -> None:
    """See it run, turn faster, and stand."""
    wait_for_seconds(page, 0.5)
    page.locator("input[data-key='rotation.rpm']").focus()
    page.keyboard.press("PageUp")
    page.locator(".turning", has_text="64.0 rpm").wait_for()
    page.locator(".play").click()
    page.locator(".player:not(.playing)").wait_for()
    page.locator(".pace", has_text="Paused").wait_for()
    stands = seconds(page)
    page.wait_for_timeout(1000)
    assert seconds(page) == stands
    # A key that is a command of notebooks is the studio's here.
    page.locator(".stage").click()
    page.keyboard.press("m")
    page.locator(".quantity", has_text="Height").wait_for()
    page.keyboard.press(" ")
    wait_for_seconds(page, stands + 0.2)
    assert page.locator(".trouble").is_hidden()


def test_in_jupyterlab(page, tmp_path):
    cell = {"cell_type": "code", "id": "one", "execution_count": None, "metadata": {}, "outputs": []}
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook = {
        "cells": [cell | {"source": CELL}, cell | {"id": "two", "source": ""}],
        "metadata": {"kernelspec": kernel},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    (tmp_path / "drum.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    words = ["--no-browser", "--allow-root", "--IdentityProvider.token=", "--ServerApp.port_retries=0"]
    with serving(tmp_path, "jupyterlab", *words) as address:
        page.goto(f"{address}lab/tree/drum.ipynb", wait_until="commit")
        page.locator(".jp-Cell .cm-content").first.click()
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
        page.keyboard.press("Control+Enter")
        page.locator(".stage").wait_for()
        assert_studio_works(page)
        page.locator(".stage").click()
        page.keyboard.press("d")
        page.keyboard.press("d")
        assert page.locator(".jp-Cell").count() == 2
        # A new kernel knows nothing of the widget, which says so, whatever is asked of it, until its cell runs again.
        page.get_by_role("menuitem", name="Kernel", exact=True).click()
        page.get_by_text("Restart Kernel…", exact=True).click()
        page.get_by_role("button", name="Confirm Kernel Restart").click()
        page.locator(".trouble", has_text="run this cell again").wait_for()
        page.locator(".play").click()
        page.wait_for_timeout(500)
        assert page.locator(".trouble").is_visible()
        page.locator(".jp-Cell .cm-content").first.click()
        page.keyboard.press("Control+Enter")
        page.locator(".trouble").wait_for(state="hidden")
        wait_for_seconds(page, 0.2)
        # Before its server ends, of which it would complain.
        page.close()


@pytest.mark.parametrize("how", ["run", "edit"])
def test_in_marimo(page, tmp_path, how):
    lines = "\n".join(f"    {line}" for line in CELL.splitlines())
    text = f"import marimo\n\napp = marimo.App()\n\n\n@app.cell\ndef _():\n{lines}\n    return\n"
    (tmp_path / "drum.py").write_text(text, encoding="utf-8")
    with serving(tmp_path, "marimo", "-q", how, "drum.py", "--headless", "--no-token") as address:
        # Its fonts come from elsewhere, and are not waited for.
        page.goto(address, wait_until="commit")
        if how == "edit":
            page.locator(".cm-content").first.click()
            page.keyboard.press("Control+Enter")
        page.locator(".stage").wait_for()
        assert_studio_works(page)
        page.close()
