"""The server of the studio: one page, and one WebSocket by which the page asks and is told.

Only this machine can connect, only with the token that is in the page's address, and only from that page. What is said
is that of `responder`: objects as JSON, pictures as bytes.
"""

import asyncio
import contextlib
import json
import secrets
import socket
import sys
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from drumrs.errors import ConfigError, DrumrsError, missing_package
from drumrs.studio.page import page
from drumrs.studio.responder import Responder, picture, wants_forces, wants_picture
from drumrs.studio.session import Session
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
        self._responder = Responder(session, name)
        self._token = secrets.token_urlsafe(16)
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
        await asyncio.to_thread(self._responder.come)
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
            await asyncio.to_thread(self._responder.leave)

    async def _send_frames(self, socket: "WebSocket", wanted: "Wanted") -> None:
        """Send the newest picture whenever one is wanted, and what has changed beside it."""
        known: View | None = None
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            while True:
                await wanted.frame.wait()
                view = self.session.view
                if known is not None and view.number == known.number:
                    view = await asyncio.to_thread(self.session.wait, known.number, _PATIENCE)
                    if view.number == known.number:
                        continue
                wanted.frame.clear()
                # Forces of many contacts take milliseconds; a picture alone is packed before a thread would have begun.
                shown = await asyncio.to_thread(picture, view, forces=True) if wanted.forces else view.frame
                for told in self._responder.news(view, known):
                    await socket.send_text(json.dumps(told))
                await socket.send_bytes(shown)
                known = view

    async def _hear(self, socket: "WebSocket", text: str | None, wanted: "Wanted") -> None:
        """Do what the page asks for; say so where that cannot be."""
        asked = _read(text)
        if wants_picture(asked):
            wanted.frame.set()
            return
        if (forces := wants_forces(asked)) is not None:
            wanted.forces = forces
            with contextlib.suppress(DrumrsError):
                await asyncio.to_thread(self.session.show)
            return
        answer = await asyncio.to_thread(self._responder.answer, asked)
        if answer is not None:
            await socket.send_text(json.dumps(answer))


def _read(text: str | None) -> Any:
    """Return what a text says; `None` where it is no JSON."""
    try:
        return json.loads(text or "")
    except (ValueError, RecursionError):
        return None
