"""What pages ask of a session, and what they are told: the same through a WebSocket and in a notebook.

A page asks for the next picture when it has drawn one, and gets the newest: nothing is queued, so a page that is slow
or stands still costs nothing. A page says objects: ``{"do": "frame"}`` asks for the next picture; ``play``, ``pause``,
``step``, ``reset``; ``rate`` with ``value``, null for as fast as can be; ``speed`` with ``value``; ``set`` with ``key``
and ``value``; ``preset`` with ``value``; ``case`` with ``value``, ``"toml"`` or ``"python"``. A page is told objects
with a ``kind``: ``start``, ``state``, ``measures``, ``case``, ``error``; and pictures as bytes.
"""

import math
import threading
from contextlib import suppress
from typing import Any

from drumrs.errors import ConfigError, DrumrsError
from drumrs.studio.controls import controls
from drumrs.studio.presets import preset, presets
from drumrs.studio.session import Session, View


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
                }
            )
        state = _state(view)
        if known is None or _state(known) != state:
            news.append({"kind": "state", **state})
        if view.measures and (known is None or known.measures != view.measures or len(news) > 1):
            news.append({"kind": "measures", **view.measures})
        return news

    def answer(self, asked: Any) -> dict[str, Any] | None:
        """Do what a page asks for, but for pictures; return what it is to be told of that, if anything."""
        try:
            return self._do(_understood(asked))
        except DrumrsError as error:
            return {"kind": "error", "text": f"{error}"}

    def _do(self, asked: dict[str, Any]) -> dict[str, Any] | None:
        session, value = self.session, asked.get("value")
        match asked["do"]:
            case "play":
                session.play()
            case "pause":
                session.pause()
            case "step":
                session.advance(1)
            case "reset":
                session.reset()
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
            case "case":
                return {"kind": "case", "as": value, "text": case_text(session.case(), str(value))}
            case unknown:
                raise ConfigError("do", unknown, "what a page of drumrs studio asks for")
        return None


def wants_picture(asked: Any) -> bool:
    """Say whether a page asks for the next picture."""
    return isinstance(asked, dict) and asked.get("do") == "frame"


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
