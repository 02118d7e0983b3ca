"""The documentation site: built without a warning, complete, no network needed, no serious fault found by axe."""

import importlib
import subprocess
import sys
from pathlib import Path

import pytest
from sphinx.util.inventory import InventoryFile

ROOT = Path(__file__).parents[3]
PAGES = [
    "index",
    "tutorials/first-run",
    "how-to/index",
    "theory/model",
    "measures/README",
    "reference/python",
    "reference/api/drumrs.Simulation",
    "reference/keys",
    "_generated/drumrs.analysis",
    "gallery/index",
    "gallery/10_ball_mill",
    "study/README",
]


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
def test_every_public_name_is_in_the_reference(site):
    listed = InventoryFile.loads((site / "objects.inv").read_bytes(), uri="").data
    names = {name for kind, entries in listed.items() if kind.startswith("py:") for name in entries}
    modules = sorted(name for name in names if name in listed["py:module"])
    assert {"drumrs.analysis", "drumrs.errors", "drumrs.figures", "drumrs.measures"} <= set(modules)
    missing = []
    for module in ["drumrs", *modules]:
        for name in getattr(importlib.import_module(module), "__all__", []):
            kind = getattr(getattr(importlib.import_module(module), name), "__module__", "")
            missing += [] if {f"{module}.{name}", f"{kind}.{name}", f"drumrs.{name}"} & names else [name]
    assert not missing


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
