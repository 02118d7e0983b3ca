"""Links of the pages lead somewhere. Their examples run by themselves: see conftest.py beside them."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# Copies that the documentation site is made of are not looked at again.
PAGES = [
    *(ROOT / name for name in ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md")),
    *sorted(page for page in (ROOT / "docs").rglob("*.md") if page.parent.name != "_generated"),
]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target
