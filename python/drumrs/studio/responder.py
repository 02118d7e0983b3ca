"""What pages ask of a session, and what they are told: the same through a WebSocket and in a notebook.

A page asks for a picture, and gets the newest: it has one to draw and one under way, and nothing is queued, so a page
that is slow or stands still costs nothing. A page says objects: ``{"do": "frame"}`` asks for the next picture;
``play``, ``pause``, ``step``, ``reset``; ``rate`` with ``value``, null for as fast as can be; ``speed`` with ``value``;
``set`` with ``key`` and ``value``; ``preset`` with ``value``; ``trade`` with ``value``, whose measures to make;
``case`` with ``value``, ``"toml"`` or ``"python"``; ``forces`` with ``value``, true where this page is to get the
forces at contacts behind each picture. A page is told objects with a ``kind``: ``start``, ``state``, ``measures``,
``case``, ``error``; and pictures as bytes, as `scene` packs them.
"""

import math
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from drumrs.errors import ConfigError, DrumrsError
from drumrs.studio.controls import controls
from drumrs.studio.presets import preset, presets, trade_of
from drumrs.studio.session import Session
from drumrs.studio.trades import TRADES
from drumrs.studio.view import View

if TYPE_CHECKING:
    from collections.abc import Callable


class Responder:
    """Answers the pages of a session, which stands still while there is none.

    Parameters
    ----------
    session
        What is shown.
    name
        What the choice of presets calls the case that the session began with.
    """

    def __init__(self, session: Session, name: str = "") -> None:
        self.session = session
        self._first = (name, session.view.config)
        self._preset = name
        self._pages, self._was_playing = 0, session.view.playing
        self._coming = threading.Lock()
        session.pause()

    def come(self) -> None:
        """Take note of a page, and let the simulation go on where it did before the last page left."""
        with self._coming, suppress(DrumrsError):
            self._pages += 1
            if self._pages == 1 and self._was_playing:
                self.session.play()

    def leave(self) -> None:
        """Take note that a page is gone, and let the simulation stand still where nobody is left to see it."""
        with self._coming, suppress(DrumrsError):
            self._pages -= 1
            if self._pages == 0:
                self._was_playing = self.session.view.playing
                self.session.pause()

    def news(self, view: View, known: View | None) -> list[dict[str, Any]]:
        """Return what a page that knows a view, or nothing yet, is to be told before a later view's picture."""
        news: list[dict[str, Any]] = []
        if known is None or known.start != view.start:
            choices = {self._first[0]: self._first[0]} | presets()
            news.append(
                {
                    "kind": "start",
                    "number": view.start,
                    "scene": view.scene,
                    "controls": controls(view.config, view.speed),
                    "presets": choices,
                    "preset": self._preset,
                    "trades": list(TRADES),
                }
            )
        state = _state(view)
        if known is None or _state(known) != state:
            news.append({"kind": "state", **state})
        if view.measures and (known is None or known.measures != view.measures or len(news) > 1):
            news.append({"kind": "measures", **view.measures})
        return news

    def answer(self, asked: Any) -> dict[str, Any] | None:
        """Do what a page asks for, but for pictures and forces; return what it is to be told of that, if anything."""
        try:
            return self._do(_understood(asked))
        except DrumrsError as error:
            return {"kind": "error", "text": f"{error}"}

    def _do(self, asked: dict[str, Any]) -> dict[str, Any] | None:
        session, value = self.session, asked.get("value")
        plain: dict[str, Callable[[], None]] = {
            "play": session.play,
            "pause": session.pause,
            "step": lambda: session.advance(1),
            "reset": session.reset,
        }
        match asked["do"]:
            case what if what in plain:
                plain[what]()
            case "rate":
                session.set_rate(math.inf if value is None else _number("rate", value))
            case "speed":
                session.set_speed(_number("speed", value))
            case "set":
                # Lists and tables are for case files.
                session.change({str(asked.get("key")): _number(str(asked.get("key")), value)})
            case "preset":
                name, config = self._first
                chosen = config if value == name else preset(str(value))
                self._preset = str(value)
                session.load(chosen)
                session.set_trade(trade_of(self._preset))
            case "trade":
                session.set_trade(str(value))
            case "case":
                return {"kind": "case", "as": value, "text": case_text(session.case(), str(value))}
            case unknown:
                raise ConfigError("do", unknown, "what a page of drumrs studio asks for")
        return None


def wants_picture(asked: Any) -> bool:
    """Say whether a page asks for the next picture."""
    return isinstance(asked, dict) and asked.get("do") == "frame"


def wants_forces(asked: Any) -> bool | None:
    """Say whether a page asks for forces behind its pictures, or for none; `None` where it asks for something else."""
    if not isinstance(asked, dict) or asked.get("do") != "forces":
        return None
    return asked.get("value") is True


def picture(view: View, *, forces: bool) -> bytes:
    """Return the picture of a view, with the forces at contacts behind it for who wants them."""
    return view.frame + view.forces if forces else view.frame


def case_text(config: Any, kind: str) -> str:
    """Return a case as a file, ``"toml"``, or as a script, ``"python"``."""
    toml: str = config.to_toml(comments=False)
    if kind == "toml":
        return toml
    if kind == "python":
        return f'import drumrs\n\nconfig = drumrs.Config.from_toml("""\n{toml}""")\nresult = drumrs.run(config)\n'
    raise ConfigError("as", kind, "'toml' or 'python'")


def _state(view: View) -> dict[str, Any]:
    return {
        "title": view.title,
        "facts": view.facts,
        "playing": view.playing,
        "rate": view.rate if math.isfinite(view.rate) else None,
        "speed": view.speed,
        "trade": view.trade,
        "said": list(view.said),
    }


def _understood(asked: Any) -> dict[str, Any]:
    if not isinstance(asked, dict) or not isinstance(asked.get("do"), str):
        raise ConfigError("what came from the page", problem="is not understood, but must be JSON with 'do'")
    return asked


def _number(what: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ConfigError(what, value, "a finite number")
    return float(value)
