"""The documentation site: built without a warning, it needs no network, and axe finds no serious fault in it."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGES = ["index", "guide", "designers", "theory/model", "reference/python", "_generated/keys", "study/README"]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "--fail-on-warning",
        "-q",
        "-d",
        folder / "trees",
        "docs",
        folder / "html",
    ]
    made = subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr
    return folder / "html"


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1240, 390])
def test_pages_need_no_network_and_have_no_serious_fault(site, browser, scheme, width):
    from axe_playwright_python.sync_playwright import Axe

    context = browser.new_context(
        color_scheme=scheme, viewport={"width": width, "height": 900}, reduced_motion="reduce"
    )
    asked, errors = [], []
    for page_name in PAGES:
        page = context.new_page()
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto((site / f"{page_name}.html").as_uri())
        found = Axe().run(page).response["violations"]
        serious = [
            (one["id"], one["nodes"][0]["html"]) for one in found if one["impact"] in {"serious", "critical"}
        ]
        assert not serious, (page_name, serious)
        # Tables and code scroll by themselves; the page does not.
        assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), page_name
        page.close()
    assert not errors
    assert all(url.startswith(("file:", "data:", "blob:")) for url in asked)
