"""A player in a browser."""

import pytest

from drumrs.viewer import Player
from shown import Shown, scene


@pytest.fixture
def show(browser, tmp_path):
    """Return a function that opens a player; at the end no page may have complained or asked for anything."""
    opened, contexts = [], []

    def open_page(text: str | None = None, **options) -> Shown:
        file = tmp_path / f"page_{len(opened)}.html"
        file.write_text(text or Player(scene(), title="Three bundles").page(autoplay=False), encoding="utf-8")
        context = browser.new_context(viewport={"width": 1200, "height": 900}, **options)
        contexts.append(context)
        opened.append(Shown(context.new_page(), file))
        return opened[-1]

    yield open_page
    troubles = [trouble for shown in opened for trouble in shown.troubles]
    for context in contexts:
        context.close()
    assert troubles == []
