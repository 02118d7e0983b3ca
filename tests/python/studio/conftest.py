"""A studio in a browser."""

import math

import pytest

import drumrs
from drumrs.studio import Session
from drumrs.studio.server import Server
from served import serving


class Page:
    """The page of a studio, and what it complained about or asked of others."""

    def __init__(self, context, server: Server):
        self.server, self.session = server, server.session
        self.troubles: list[str] = []
        self.page = context.new_page()
        self.page.on("console", lambda message: self.troubles.append(message.text))
        self.page.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.page.on("request", lambda request: self._ask(request.url))
        self.page.goto(server.address)

    def _ask(self, url):
        if not url.startswith((self.server.address, "data:", "blob:")):
            self.troubles.append(f"asked for {url}")

    def part(self, name):
        return self.page.locator(f".{name}")

    def wait(self, condition):
        """Wait until a condition on the studio holds."""
        self.page.wait_for_function(f"studio => {condition}", arg=self.page.evaluate_handle("studio"))

    @property
    def time(self) -> float:
        return self.page.evaluate("studio.recording?.end ?? 0")

    def pixels(self) -> str:
        """Return what the drum shows."""
        return self.part("stage").evaluate("canvas => canvas.toDataURL()")

    def slide(self, key, value):
        """Move a slider as a hand does, and let it go."""
        script = """(input, value) => {
          input.value = value;
          for (const name of ["input", "change"]) input.dispatchEvent(new Event(name));
        }"""
        self.page.locator(f"input[data-key='{key}']").evaluate(script, value)


@pytest.fixture
def show(browser):
    """Return a function that opens a studio; at the end no page may have complained or asked others for anything."""
    config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0)
    opened = []
    with Session(config, rate=math.inf) as session, serving(Server(session, "mine")) as server:

        def open_page(**options) -> Page:
            context = browser.new_context(viewport={"width": 1200, "height": 1000}, **options)
            opened.append((Page(context, server), context))
            return opened[-1][0]

        yield open_page
        troubles = [trouble for page, _ in opened for trouble in page.troubles]
        for _, context in opened:
            context.close()
    assert troubles == []
