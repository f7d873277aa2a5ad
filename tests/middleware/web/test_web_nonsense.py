"""Half characters, deep texts and broken requests of web clients are refused in one line."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from websockets.sync.client import connect

from tests.support.handshakes import status_of
from tests.support.waiting import wait_until
from uwsim.bus import Bus
from uwsim.errors import BadMessage
from uwsim.messages import String
from uwsim.middleware.lockstep.topics import JOIN
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge
from uwsim.middleware.web.session import name_in, read_frame


@pytest.mark.parametrize(
    "frame",
    [
        r'{"op": "publish", "topic": "/a\ud800b", "msg": {"data": "x"}}',
        r'{"op": "publish", "topic": "/a", "msg": {"data": "\uDC80"}}',
        r'{"op": "publish", "topic": "/a", "msg": {"\ud83d": [1]}}',
    ],
)
def test_half_of_a_character_is_refused_where_a_frame_is_read(frame: str) -> None:
    with pytest.raises(BadMessage, match="half of a surrogate pair"):
        read_frame(frame)


@pytest.mark.parametrize("id", ["NaN", "[1, -Infinity]", '{"a": 1e999}'])
def test_an_id_that_no_reader_of_json_takes_is_refused(id: str) -> None:
    with pytest.raises(BadMessage, match="'id' of a frame has a number that is not finite"):
        read_frame(f'{{"op": "call_service", "service": "/x", "id": {id}}}')


@pytest.mark.parametrize("name", ["/a\nuwsim: warning: forged", "b\x1b[2J", "/c\u2028d"])
def test_a_name_of_several_lines_is_refused(name: str) -> None:
    with pytest.raises(BadMessage, match="has characters that no name has"):
        name_in({"op": "advertise", "topic": name}, "topic")


@pytest.mark.parametrize("text", [r"\ud83d\udc1f", r"\\ud800", "\N{FISH}"])
def test_whole_characters_are_read(text: str) -> None:
    read = read_frame(f'{{"op": "publish", "topic": "/a", "msg": {{"data": "{text}"}}}}')
    assert read["msg"]["data"] in ("\N{FISH}", r"\ud800")


@pytest.fixture
def bridge() -> Iterator[WebBridge]:
    bus = Bus()
    bus.inbox(JOIN, String)
    bridge = WebBridge(
        bus, lambda: 0.0, WebOptions(port=0, token="secret"), Log("web", lambda line: None)
    )
    bridge.step()
    yield bridge
    bridge.close()


def test_a_join_of_nonsense_leaves_its_client_connected(
    bridge: WebBridge, capfd: pytest.CaptureFixture[str]
) -> None:
    with connect(f"ws://127.0.0.1:{bridge.port}?token=secret") as client:
        message = {"op": "publish", "topic": f"/{JOIN}", "msg": {"data": "[" * 200_000}}
        client.send(json.dumps(message))
        client.send(json.dumps(message))
        wait_until(lambda: bridge.arrivals.n_arrived[JOIN] == 2)
    assert "Traceback" not in capfd.readouterr().err


@pytest.mark.parametrize(
    "request_lines",
    [
        "GET //[x HTTP/1.1",
        "GET / HTTP/1.1\r\nAuthorization: Bearer \xff",
        "GET / HTTP/1.1\r\nAuthorization: Bearer a\r\nAuthorization: Bearer b",
    ],
)
def test_a_request_of_nonsense_is_refused_without_a_traceback(
    request_lines: str, bridge: WebBridge, capfd: pytest.CaptureFixture[str]
) -> None:
    assert status_of(bridge.port, request_lines, 60.0) == "401"
    assert "Traceback" not in capfd.readouterr().err
