"""The server's manners: who may come in, what is said to those who talk nonsense, and what is not waited for."""

import http.client
import json
import math
import struct
import time
from contextlib import closing
from socket import SHUT_RDWR

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import drumrs
from drumrs.errors import ConfigError
from drumrs.studio import Session
from drumrs.studio.server import Server
from served import serving


@pytest.fixture
def server():
    config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0)
    with Session(config, rate=math.inf) as session, serving(Server(session, "mine")) as server:
        yield server


def join(server, *, token=None, origin=None):
    token = server._token if token is None else token
    address = f"{server._origin.replace('http', 'ws')}/session?token={token}"
    return connect(address, origin=origin or server._origin)


def status_of(server, path, **headers) -> tuple[int, str]:
    """Return status and content security policy of the answer to a request."""
    with closing(http.client.HTTPConnection(server._origin.removeprefix("http://"))) as connection:
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.getheader("content-security-policy", "")


def told(socket, kind: str) -> dict:
    """Return the next of what is told that is of a kind; pictures and the rest are left out."""
    while True:
        message = socket.recv(timeout=30.0)
        if isinstance(message, str) and (found := json.loads(message))["kind"] == kind:
            return found


def ask(socket, **message) -> None:
    socket.send(json.dumps(message))


def picture(socket) -> bytes:
    ask(socket, do="frame")
    while True:
        message = socket.recv(timeout=30.0)
        if isinstance(message, bytes):
            return message


def test_the_page_is_for_those_who_have_its_address(server):
    path = server.address.removeprefix(server._origin)
    status, policy = status_of(server, path)
    assert status == 200
    assert "default-src 'none'" in policy
    assert [status_of(server, wrong)[0] for wrong in ("/", "/?token=guess", "/session", "/other")] == [
        403,
        403,
        404,
        404,
    ]
    # Another name for this machine, such as one of a page that would have it for its own.
    assert status_of(server, path, host="evil.example")[0] == 403


@pytest.mark.parametrize("wrong", [{"token": "guess"}, {"origin": "http://evil.example"}, {"origin": "null"}])
def test_nobody_else_comes_in(server, wrong):
    with pytest.raises(InvalidStatus, match="403"), join(server, **wrong):
        pass
    assert not server.session.view.playing


def test_another_name_for_this_machine_does_not_come_in(server):
    headers = {
        "host": "evil.example",
        "origin": server._origin,
        "upgrade": "websocket",
        "connection": "Upgrade",
        "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ==",
        "sec-websocket-version": "13",
    }
    path = f"/session?token={server._token}"
    assert status_of(server, path, **headers)[0] == 403
    assert status_of(server, path, **headers | {"host": server._origin.removeprefix("http://")})[0] == 101


def test_it_runs_while_somebody_looks(server):
    assert not server.session.view.playing
    with join(server) as socket:
        ask(socket, do="frame")
        start = told(socket, "start")
        assert start["preset"] == "mine"
        assert {"mine", "baseline", "washer"} <= start["presets"].keys()
        assert [one["key"] for one in start["controls"]][:2] == ["rotation.rpm", "load.fill"]
        assert told(socket, "state")["playing"]
        times = [struct.unpack_from("<d", picture(socket), 8)[0] for _ in range(3)]
        assert sorted(set(times)) == times
    deadline = time.monotonic() + 20.0
    while server.session.view.playing and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not server.session.view.playing


def test_what_the_page_asks_for_is_done(server):
    with join(server) as socket:
        for message in (
            {"do": "pause"},
            {"do": "speed", "value": 70.0},
            {"do": "step"},
            {"do": "rate", "value": None},
            {"do": "case", "value": "toml"},
        ):
            ask(socket, **message)
        case = drumrs.Config.from_toml(told(socket, "case")["text"])
        assert case == server.session.case()
        assert case.rotation.program[-1][1] == 70.0
        ask(socket, do="case", value="python")
        names: dict = {}
        script = told(socket, "case")["text"]
        exec(script.replace("result = drumrs.run(config)", ""), names)
        assert names["config"] == case
        ask(socket, do="set", key="load.fill", value=0.2)
        ask(socket, do="frame")
        assert told(socket, "start")["controls"][1]["value"] == 0.2
        state = told(socket, "state")
        assert state["title"] == "80 bundles (20 % fill), 3 baffles, 70 rpm, seed 1"
        assert state["said"][-1] == "Started anew from seed 1, with load.fill = 0.2."
        ask(socket, do="preset", value="dryer")
        ask(socket, do="frame")
        assert told(socket, "start")["preset"] == "dryer"
        ask(socket, do="preset", value="mine")
        ask(socket, do="case", value="toml")
        assert drumrs.Config.from_toml(told(socket, "case")["text"]).bundle_count == 40


@pytest.mark.parametrize(
    "rubbish",
    [
        "",
        "{",
        "[1]",
        '"frame"',
        '{"do": 7}',
        '{"do": "explode"}',
        '{"do": "speed"}',
        '{"do": "speed", "value": "54"}',
        '{"do": "speed", "value": 1e999}',
        '{"do": "rate", "value": -1}',
        '{"do": "set", "key": "load", "value": 3}',
        '{"do": "set", "key": "no.such", "value": 3}',
        '{"do": "set", "key": ["run"], "value": 3}',
        '{"do": "set", "key": "load.fill", "value": {}}',
        '{"do": "preset", "value": "../../secret"}',
        '{"do": "case", "value": "exe"}',
        "[" * 5000,
    ],
)
def test_nonsense_is_answered_and_changes_nothing(server, rubbish):
    with join(server) as socket:
        before = server.session.case().replace({"run.duration": 30.0})
        socket.send(rubbish)
        assert told(socket, "error")["text"]
        socket.send(b"\xff\x00")
        assert "is not understood" in told(socket, "error")["text"]
        assert server.session.case().replace({"run.duration": 30.0}) == before
        assert picture(socket)


def test_a_page_that_stalls_is_sent_one_picture_and_keeps_nobody_waiting(server):
    with join(server) as slow, join(server) as quick:
        ask(slow, do="frame")
        times = [struct.unpack_from("<d", picture(quick), 8)[0] for _ in range(20)]
        assert times[-1] > times[0]
        assert picture(slow)
        # The one that comes after it is the newest, not the next.
        assert struct.unpack_from("<d", picture(slow), 8)[0] >= times[-1]


def test_a_page_that_says_too_much_is_cut_off(server):
    with join(server) as socket:
        socket.send("x" * 20_000)
        with pytest.raises(ConnectionClosed, match="1009"):
            told(socket, "error")
    with join(server) as socket:
        assert picture(socket)


def test_a_page_that_is_gone_without_a_word_does_no_harm(server):
    with join(server) as gone:
        ask(gone, do="frame")
        gone.socket.shutdown(SHUT_RDWR)
        with join(server) as other:
            assert picture(other)


def test_a_port_that_is_taken_is_refused(server):
    taken = server._socket.getsockname()[1]
    with pytest.raises(ConfigError, match=r"^--port cannot be listened at: .*leave it out"):
        Server(server.session, port=taken)
    with pytest.raises(ConfigError, match="--port"):
        Server(server.session, port=70000)


def test_forces_come_with_the_pictures_of_those_who_ask_for_them(server):
    server.session.pause()
    with join(server) as one, join(server) as other:
        ask(one, do="pause")
        plain = len(picture(one))
        assert plain == 48 + 8 * 40
        ask(one, do="forces", value=True)
        with_forces = picture(one)
        # They come with the picture that stands, and no other page is sent them.
        assert len(with_forces) >= plain + 16
        assert (len(with_forces) - plain - 16) % 5 == 0
        assert len(picture(other)) == plain
        for nothing in (False, "yes", None):
            ask(one, do="forces", value=nothing)
            assert len(picture(one)) == plain


def test_a_trade_is_measured_and_another_machine_has_its_own(server):
    with join(server) as socket:
        ask(socket, do="frame")
        assert told(socket, "start")["trades"] == ["washer", "dryer", "mill", "coater"]
        assert told(socket, "state")["trade"] == "washer"
        ask(socket, do="trade", value="mill")
        ask(socket, do="frame")
        assert told(socket, "state")["trade"] == "mill"
        ask(socket, do="preset", value="dryer")
        while server.session.view.trade != "dryer":
            picture(socket)
        ask(socket, do="trade", value="baker")
        assert told(socket, "error")["text"].startswith("trade is 'baker', but must be one of washer, dryer")
