"""The studio as a widget of a notebook, by anywidget: Jupyter, marimo, and others that show such widgets.

Its page is that of `drumrs studio`, and says and is told the same (`responder`); messages of the notebook's kernel take
the place of the WebSocket. A notebook does not tell that a page is gone, so one that has not asked for a picture for a
while counts as gone.
"""

import threading
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from drumrs.errors import DrumrsError, missing_package
from drumrs.studio.responder import Responder, picture, wants_forces, wants_picture
from drumrs.studio.session import Session
from drumrs.studio.view import View
from drumrs.viewer import module

try:
    import anywidget
except ModuleNotFoundError as error:
    raise missing_package("the studio in a notebook", error, "notebook") from None

# A page that has not asked for a picture for so long is gone, or in a tab that nobody looks at [s].
_GONE = 2.0
# How long to wait for the next picture before the page is told that there is none yet [s]; the kernel waits, too.
_SOON = 1.0 / 60.0


@dataclass
class _Page:
    """What a page knows, when it last asked for a picture, whether it counts as there, and whether it wants forces."""

    known: View | None = None
    asked: float = 0.0
    is_there: bool = False
    forces: bool = False


class StudioWidget(anywidget.AnyWidget):
    """A session in a notebook; `drumrs.widget` makes one.

    Parameters
    ----------
    session
        What is shown.
    name
        What the choice of presets calls the case that the session began with.

    Attributes
    ----------
    session
        The same: to read the case and the series of what is seen, and to change it from other cells.
    """

    _esm = module("studio_widget.js")

    def __init__(self, session: Session, name: str = "") -> None:
        super().__init__()
        self.session = session
        self._responder = Responder(session, name)
        self._pages: dict[str, _Page] = {}
        # Pages are looked after by the kernel's thread, which answers them, and by the one that waits for them to go.
        self._looking = threading.Lock()
        self._is_closed = threading.Event()
        self.on_msg(self._hear)
        threading.Thread(target=self._watch, name="drumrs widget", daemon=True).start()

    def __repr__(self) -> str:
        """Say what is simulated."""
        return f"<StudioWidget of {self.session.view.title}>"

    def close(self) -> None:
        """End the simulation and remove the widget from the notebook."""
        # A widget that could not be made is closed, too, when it is collected.
        if "session" in vars(self) and not self._is_closed.is_set():
            self._is_closed.set()
            self.session.close()
        super().close()

    def _hear(self, _: Any, asked: Any, __: Any) -> None:
        """Answer a page: at once, but for a picture that is about to come."""
        name = str(asked.get("page")) if isinstance(asked, dict) else ""
        if self._is_closed.is_set():
            return
        if wants_picture(asked):
            self._show(name)
        elif isinstance(asked, dict) and asked.get("do") == "leave":
            self._leave(name)
        elif (forces := wants_forces(asked)) is not None:
            self._page(name).forces = forces
            with suppress(DrumrsError):
                self.session.show()
        elif (answer := self._responder.answer(asked)) is not None:
            self.send({"page": name, "told": [answer], "isPicture": False})

    def _show(self, name: str) -> None:
        """Send the newest picture, and before it what else is new; nothing where there is nothing new."""
        page = self._page(name)
        with self._looking:
            page.asked = time.monotonic()
            if not page.is_there:
                page.is_there = True
                self._responder.come()
        known = page.known
        view = self.session.wait(-1 if known is None else known.number, _SOON)
        is_new = known is None or view.number != known.number
        told = self._responder.news(view, known) if is_new else []
        page.known = view
        self.send(
            {"page": name, "told": told, "isPicture": True},
            [picture(view, forces=page.forces)] if is_new else [],
        )

    def _page(self, name: str) -> _Page:
        with self._looking:
            return self._pages.setdefault(name, _Page())

    def _leave(self, name: str) -> None:
        with self._looking:
            page = self._pages.pop(name, None)
            if page is not None and page.is_there:
                self._responder.leave()

    def _watch(self) -> None:
        """Take note of pages that have ceased to ask; they may come back."""
        while not self._is_closed.wait(_GONE / 4.0):
            with self._looking:
                now = time.monotonic()
                for page in self._pages.values():
                    if page.is_there and now - page.asked > _GONE:
                        page.is_there = False
                        self._responder.leave()
