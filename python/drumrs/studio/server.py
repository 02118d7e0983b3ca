"""The server of the studio: one page, and one WebSocket by which the page asks and is told.

The page asks for a picture, and gets the newest: it has one to draw and one under way, and nothing is queued, so a page
that is slow or stands still costs nothing. Only this machine can connect, only with the token that is in the page's
address, and only from that page.

From the page comes JSON: ``{"do": "frame"}`` asks for the next picture; ``play``, ``pause``, ``step``, ``reset``;
``rate`` with ``value``, null for as fast as can be; ``speed`` with ``value``; ``set`` with ``key`` and ``value``;
``preset`` with ``value``; ``trade`` with ``value``, whose measures to make; ``case`` with ``value``, ``"toml"`` or
``"python"``; ``forces`` with ``value``, true where this page is to get the forces at contacts behind each picture. To
the page goes JSON with a ``kind``: ``start``, ``state``, ``measures``, ``case``, ``error``; and pictures as bytes, as
`scene` packs them.
"""

import asyncio
import contextlib
import json
import math
import secrets
import socket
import sys
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from drumrs.errors import ConfigError, DrumrsError, missing_package
from drumrs.studio.controls import controls
from drumrs.studio.page import page
from drumrs.studio.presets import preset, presets, trade_of
from drumrs.studio.session import Session
from drumrs.studio.trades import TRADES
from drumrs.studio.view import View

try:
    import uvicorn
    import websockets  # noqa: F401 - what uvicorn speaks WebSocket by
    from starlette.applications import Starlette
    from starlette.responses import HTMLResponse, PlainTextResponse, Response
    from starlette.routing import Route, WebSocketRoute
    from starlette.websockets import WebSocket, WebSocketDisconnect
except ModuleNotFoundError as error:
    raise missing_package("the studio", error, "studio") from None

if TYPE_CHECKING:
    from starlette.requests import Request

HOST = "127.0.0.1"
# What a page may say at once [bytes].
_LONGEST_MESSAGE = 10_000
# How long to wait for a picture before looking whether the page is still there [s].
_PATIENCE = 1.0
# Threads of Python wait for one another no longer than this [s], so that pictures need not wait for measures; it is a
# fifth of what they do unless told.
_SWITCH = 0.001
# Why a WebSocket is closed that has no right to be there.
_FORBIDDEN = 1008


@dataclass
class Wanted:
    """What a page waits for.

    Attributes
    ----------
    frame
        Set while it waits for a picture.
    forces
        Whether the picture is to come with the forces at its contacts.
    """

    frame: asyncio.Event = field(default_factory=asyncio.Event)
    forces: bool = False


class Server:
    """A session in the browser.

    Parameters
    ----------
    session
        What is shown.
    name
        What the choice of presets calls the case that the session began with.
    port
        Port to listen at; a free one unless given.

    Raises
    ------
    ConfigError
        Where the port cannot be had.
    """

    def __init__(self, session: Session, name: str = "", port: int = 0) -> None:
        self.session = session
        self._first = (name, session.view.config)
        self._preset = name
        self._token = secrets.token_urlsafe(16)
        self._pages, self._was_playing = 0, session.view.playing
        # Without anybody who looks it stands still.
        session.pause()
        self._socket = socket.socket()
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            self._socket.bind((HOST, port))
        except (OSError, OverflowError) as error:
            self._socket.close()
            problem = f"cannot be listened at: {error}"
            raise ConfigError("--port", port, problem=problem, hint="leave it out for a free one") from None
        self._origin = f"http://{HOST}:{self._socket.getsockname()[1]}"

    @property
    def address(self) -> str:
        """Address of the page, token included."""
        return f"{self._origin}/?token={self._token}"

    def serve(self, on_ready: Callable[[], None]) -> None:
        """Answer until Ctrl-C or `stop`.

        Parameters
        ----------
        on_ready
            Called as soon as the page can be opened.
        """

        @contextlib.asynccontextmanager
        async def lifespan(_: Any) -> AsyncIterator[None]:
            self._socket.listen()
            on_ready()
            yield

        routes = [Route("/", self._show), WebSocketRoute("/session", self._talk)]
        config = uvicorn.Config(
            Starlette(routes=routes, lifespan=lifespan),
            log_level="warning",
            ws="websockets-sansio",
            ws_max_size=_LONGEST_MESSAGE,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=1,
        )
        self._uvicorn = uvicorn.Server(config)
        before = sys.getswitchinterval()
        sys.setswitchinterval(_SWITCH)
        try:
            self._uvicorn.run(sockets=[self._socket])
        finally:
            sys.setswitchinterval(before)

    def stop(self) -> None:
        """End `serve`; safe from any thread."""
        self._uvicorn.should_exit = True

    def _may(self, headers: Any, token: str | None) -> bool:
        # The host is that of the address, and no name that another page has made point to this machine.
        host = self._origin.removeprefix("http://")
        return headers.get("host") == host and secrets.compare_digest(
            (token or "").encode(), self._token.encode()
        )

    async def _show(self, request: "Request") -> "Response":
        if not self._may(request.headers, request.query_params.get("token")):
            return PlainTextResponse(
                "This page needs the address that drumrs studio has printed, with its token.\n", 403
            )
        text, policy = page()
        headers = {
            "Content-Security-Policy": policy,
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
        }
        return HTMLResponse(text, headers=headers)

    async def _talk(self, socket: "WebSocket") -> None:
        is_ours = socket.headers.get("origin") == self._origin
        if not (is_ours and self._may(socket.headers, socket.query_params.get("token"))):
            await socket.close(_FORBIDDEN)
            return
        await socket.accept()
        await self._come(1)
        wanted = Wanted()
        sender = asyncio.create_task(self._send_frames(socket, wanted))
        try:
            while True:
                message = await socket.receive()
                if message["type"] == "websocket.disconnect":
                    break
                await self._hear(socket, message.get("text"), wanted)
        except WebSocketDisconnect:
            pass
        finally:
            sender.cancel()
            await self._come(-1)

    async def _come(self, more: int) -> None:
        """Let the simulation go on where there is somebody to see it, and stand still where nobody is left."""
        before, self._pages = self._pages, self._pages + more
        session = self.session
        with contextlib.suppress(DrumrsError):
            if before == 0 and self._was_playing:
                await asyncio.to_thread(session.play)
            elif self._pages == 0:
                self._was_playing = session.view.playing
                await asyncio.to_thread(session.pause)

    async def _send_frames(self, socket: "WebSocket", wanted: "Wanted") -> None:
        """Send the newest picture whenever one is wanted, and what has changed beside it."""
        known: View | None = None

        def next_picture() -> tuple[View, bytes]:
            number = -1 if known is None else known.number
            view = self.session.wait(number, _PATIENCE)
            if view.number == number:
                return view, b""
            return view, view.frame + view.forces if wanted.forces else view.frame

        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            while True:
                await wanted.frame.wait()
                view, picture = await asyncio.to_thread(next_picture)
                if not picture:
                    continue
                wanted.frame.clear()
                for told in self._news(view, known):
                    await socket.send_text(json.dumps(told))
                await socket.send_bytes(picture)
                known = view

    def _news(self, view: View, known: View | None) -> list[dict[str, Any]]:
        """Return what the page does not know yet."""
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

    async def _hear(self, socket: "WebSocket", text: str | None, wanted: "Wanted") -> None:
        """Do what the page asks for; say so where that cannot be."""
        try:
            asked = _parse(text)
            if asked["do"] == "frame":
                wanted.frame.set()
                return
            if asked["do"] == "forces":
                wanted.forces = asked.get("value") is True
                await asyncio.to_thread(self.session.show)
                return
            answer = await asyncio.to_thread(self._do, asked)
        except DrumrsError as error:
            answer = {"kind": "error", "text": f"{error}"}
        if answer is not None:
            await socket.send_text(json.dumps(answer))

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


def _parse(text: str | None) -> dict[str, Any]:
    try:
        asked = json.loads(text or "")
    except (ValueError, RecursionError):
        asked = None
    if not isinstance(asked, dict) or not isinstance(asked.get("do"), str):
        raise ConfigError("what came from the page", problem="is not understood, but must be JSON with 'do'")
    return asked


def _number(what: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ConfigError(what, value, "a finite number")
    return float(value)
