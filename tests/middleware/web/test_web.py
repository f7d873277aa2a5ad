"""The rosbridge protocol over a real socket: a plain client, and hostile ones."""

from __future__ import annotations

import base64
import json
import socket
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from typing import Any

import cv2
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from tests.support.waiting import LIMIT
from uwsim.bus import Bus
from uwsim.errors import BadSetting, RunFailed, UwsimError
from uwsim.messages import (
    Empty,
    EmptyResponse,
    Float32MultiArray,
    GTpublish,
    GTpublishResponse,
    Image,
    String,
    TwistStamped,
    header,
)
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge


class Setting:
    """A bus with a server, and the simulation's thread is the test's."""

    def __init__(self, **options: Any) -> None:
        self.bus = Bus()
        self.lines: list[str] = []
        self.time = 0.0
        self.bridge = WebBridge(
            self.bus,
            lambda: self.time,
            WebOptions(port=0, **options),
            Log("web", self.lines.append),
        )
        self._stack = ExitStack()

    def client(self, path: str = "/", **options: Any) -> ClientConnection:
        uri = f"ws://127.0.0.1:{self.bridge.port}{path}"
        options = {"max_size": 2**26, "open_timeout": LIMIT, "ping_interval": None} | options
        return self._stack.enter_context(connect(uri, close_timeout=0.1, **options))

    def step_until(self, condition: Any) -> None:
        deadline = time.monotonic() + LIMIT
        while not condition():
            assert time.monotonic() < deadline, "it never came"
            self.bridge.step()
            time.sleep(0.001)

    def ask(self, client: ClientConnection, **frame: Any) -> Any:
        """Call a service of the simulation and return the response."""
        send(client, op="call_service", id="c", **frame)
        arrivals: list[Any] = []

        def is_answered() -> bool:
            try:
                arrivals.append(json.loads(client.recv(timeout=0.001)))
            except TimeoutError:
                return False
            return arrivals[-1].get("op") == "service_response"

        self.step_until(is_answered)
        return arrivals[-1]

    def close(self) -> None:
        self.bridge.close()
        assert not self.bridge._thread.is_alive()
        self._stack.close()


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Iterator[Setting]:
    monkeypatch.setattr("uwsim.middleware.web.server.CLOSE_TIMEOUT", 0.2)  # [s]
    new_setting = Setting()
    yield new_setting
    new_setting.close()


def send(client: ClientConnection, **frame: Any) -> None:
    client.send(json.dumps(frame))


def receive(client: ClientConnection) -> Any:
    return json.loads(client.recv(timeout=LIMIT))


def test_a_client_reads_a_topic_and_nothing_is_published_before(setting: Setting) -> None:
    say = setting.bus.publisher("twist", TwistStamped)
    assert not setting.bus.has_subscribers("twist")
    client = setting.client()
    send(client, op="subscribe", topic="/twist", type="geometry_msgs/TwistStamped")
    setting.step_until(lambda: setting.bus.has_subscribers("twist"))
    message = TwistStamped(header=header(0.5))
    message.twist.linear.x = 1.0 / 3.0
    say(message)
    setting.bus.deliver()
    frame = receive(client)
    assert (frame["op"], frame["topic"]) == ("publish", "/twist")
    assert frame["msg"]["twist"]["linear"]["x"] == 1.0 / 3.0
    assert frame["msg"]["header"]["stamp"] == {"sec": 1, "nanosec": 500_000_000}
    send(client, op="unsubscribe", topic="/twist")
    setting.step_until(lambda: not setting.bus.has_subscribers("twist"))
    send(client, op="subscribe", topic="/twist")
    setting.step_until(lambda: setting.bus.has_subscribers("twist"))
    client.close()
    setting.step_until(lambda: not setting.bus.has_subscribers("twist"))


def test_a_client_publishes(setting: Setting) -> None:
    inbox = setting.bus.inbox("corners", Float32MultiArray)
    client = setting.client()
    send(client, op="advertise", topic="/corners", type="std_msgs/msg/Float32MultiArray")
    send(client, op="publish", topic="/corners", msg={"data": [1.5, None]})
    setting.step_until(lambda: inbox.last_message is not None)
    assert inbox.last_message is not None
    assert inbox.last_message.data[0] == 1.5
    assert np.isnan(inbox.last_message.data[1])


def test_a_client_calls_services_and_asks_what_there_is(setting: Setting) -> None:
    setting.bus.publisher("twist", TwistStamped)
    setting.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    setting.bridge.step()
    client = setting.client()
    actual = setting.ask(client, service="/rosapi/topics")
    assert actual["values"] == {
        "topics": ["/rosout", "/twist"],
        "types": ["rcl_interfaces/msg/Log", "geometry_msgs/msg/TwistStamped"],
    }
    assert "/reset" in setting.ask(client, service="/rosapi/services")["values"]["services"]
    requests = {"service": "/rosapi/service_type", "args": {"service": "/reset"}}
    assert setting.ask(client, **requests)["values"] == {"type": "std_srvs/srv/Empty"}
    answer = setting.ask(client, service="/reset")
    assert (answer["result"], answer["values"], answer["id"]) == (True, {}, "c")
    error_reply = setting.ask(client, service="/rest")
    assert error_reply["result"] is False
    assert "Did you mean '/reset'?" in error_reply["values"]


def test_a_client_that_comes_before_the_first_step_finds_what_there_is(setting: Setting) -> None:
    setting.bus.services.serve("reset", Empty, lambda request: EmptyResponse())
    client = setting.client()
    send(client, op="call_service", id="c", service="/rosapi/services")
    with pytest.raises(TimeoutError):
        client.recv(timeout=0.2)
    setting.bridge.step()
    assert "/reset" in receive(client)["values"]["services"]


def test_closing_does_not_wait_for_a_client_that_came_before_the_first_step() -> None:
    setting = Setting()
    with setting.client() as client:
        setting.close()
        with pytest.raises(ConnectionClosed, match="the simulation has ended"):
            client.recv(timeout=LIMIT)


def test_the_simulation_calls_a_service_of_a_client(setting: Setting) -> None:
    client = setting.client()
    kind = "underwater_sensor_msgs/GTpublish"
    send(client, op="advertise_service", service="/autoInit", type=kind)
    setting.step_until(lambda: setting.bus.services.is_offered("autoInit"))
    requests: list[Any] = []

    def answer() -> None:
        frame = receive(client)
        requests.append(frame)
        send(client, op="service_response", id=frame["id"], service="/autoInit", result=True)

    services = threading.Thread(target=answer)
    services.start()
    response = setting.bus.services.call(
        "autoInit", GTpublish(groundTruth=np.array([1, 2], np.float32))
    )
    services.join()
    assert isinstance(response, GTpublishResponse)
    assert (requests[0]["op"], requests[0]["args"]) == ("call_service", {"groundTruth": [1.0, 2.0]})


def test_a_service_whose_client_leaves_fails_and_is_withdrawn(setting: Setting) -> None:
    client = setting.client()
    kind = "underwater_sensor_msgs/srv/GTpublish"
    send(client, op="advertise_service", service="/autoInit", type=kind)
    setting.step_until(lambda: setting.bus.services.is_offered("autoInit"))
    client.close()
    with pytest.raises((RunFailed, UwsimError), match="disconnected"):
        setting.bus.services.call("autoInit", GTpublish(groundTruth=np.zeros(8, np.float32)))
    setting.step_until(lambda: not setting.bus.services.is_offered("autoInit"))


def test_images_come_as_json_as_png_and_as_cbor(setting: Setting) -> None:
    say = setting.bus.publisher("image", Image)
    pixels = np.arange(12, dtype=np.uint8)
    clients = {}
    for compression in ("none", "png", "cbor"):
        clients[compression] = setting.client()
        send(clients[compression], op="subscribe", topic="/image", compression=compression)
    setting.step_until(lambda: len(setting.bridge._readers.readers_of("image")) == 3)
    setting.step_until(lambda: setting.bus.has_subscribers("image"))
    say(Image(height=2, width=2, encoding="rgb8", step=6, data=pixels))
    setting.bus.deliver()
    json_image = receive(clients["none"])
    assert base64.b64decode(json_image["msg"]["data"]) == pixels.tobytes()
    png = base64.b64decode(receive(clients["png"])["data"])
    image = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None
    assert json.loads(image[..., ::-1].tobytes()) == json_image
    binary = clients["cbor"].recv(timeout=LIMIT)
    assert isinstance(binary, bytes)
    assert b"\x64data\x4c" + pixels.tobytes() in binary


def test_throttled_and_queued_messages_are_few(setting: Setting) -> None:
    say = setting.bus.publisher("text", String)
    client = setting.client()
    send(client, op="subscribe", topic="/text", throttle_rate=3_600_000)
    setting.step_until(lambda: setting.bus.has_subscribers("text"))
    for n in range(5):
        say(String(data=str(n)))
    setting.bus.deliver()
    send(client, op="unsubscribe", topic="/text")
    assert receive(client)["msg"] == {"data": "0"}
    assert setting.ask(client, service="/rosapi/nodes")["values"] == {"nodes": ["/uwsim"]}


def test_a_reader_that_stalls_costs_a_known_amount_of_memory(setting: Setting) -> None:
    say = setting.bus.publisher("image", Image)
    client = setting.client(max_queue=1)
    send(client, op="subscribe", topic="/image")
    setting.step_until(lambda: setting.bus.has_subscribers("image"))
    for _ in range(300):
        say(Image(height=480, width=640, step=1920, data=np.zeros(921_600, np.uint8)))
        setting.bus.deliver()
    ((session, _),) = setting.bridge._readers.readers_of("image")
    assert session._queue._n_bytes <= 64 * 2**20
    assert session._queue.n_dropped > 0
    assert any("too slowly" in line for line in setting.lines)


BAD_FRAMES = [
    "",
    "nonsense",
    "[1, 2]",
    '{"op": 3}',
    '{"op": "sing"}',
    "[" * 100_000,
    '{"op": "publish"}',
    '{"op": "publish", "topic": "/nobody", "msg": {}}',
    '{"op": "advertise", "topic": "/a", "type": "no/Such"}',
    '{"op": "advertise", "topic": "/twist", "type": "std_msgs/String"}',
    '{"op": "publish", "topic": "/twist", "msg": {"twist": 3}}',
    '{"op": "publish", "topic": "/twist", "msg": [1]}',
    '{"op": "subscribe", "topic": 5}',
    '{"op": "subscribe", "topic": "/twist", "throttle_rate": -1}',
    '{"op": "subscribe", "topic": "/twist", "throttle_rate": "x"}',
    '{"op": "subscribe", "topic": "/twist", "compression": "zip"}',
    '{"op": "service_response", "id": "call:1"}',
    '{"op": "advertise_service", "service": "/s", "type": "no/Such"}',
    '{"op": "unsubscribe", "topic": ""}',
]


def test_frames_that_mean_nothing_are_answered_with_a_status(setting: Setting) -> None:
    setting.bus.publisher("twist", TwistStamped)
    setting.bridge.step()
    client = setting.client()
    client.send(b"\x00\x01")
    assert "binary" in receive(client)["msg"]
    for frame in BAD_FRAMES:
        client.send(frame)
        status = receive(client)
        assert (status["op"], status["level"]) == ("status", "error"), frame[:80]
        assert len(status["msg"]) < 2000
    assert setting.ask(client, service="/rosapi/nodes")["result"] is True
    assert len(setting.lines) < 20


def test_a_client_that_subscribes_to_a_hidden_topic_gets_the_reason(setting: Setting) -> None:
    publish = setting.bus.publisher("truth/odometry", String)
    setting.bus.hide_topic("truth/odometry", "(PATToROSOdom) is not in track 'b'")
    setting.bridge.step()
    client = setting.client()
    send(client, op="subscribe", topic="/truth/odometry")
    status = receive(client)
    assert status["level"] == "error"
    assert status["msg"] == "Topic /truth/odometry (PATToROSOdom) is not in track 'b'."
    publish(String(data="secret"))
    setting.bus.deliver()
    setting.bridge.step()
    with pytest.raises(TimeoutError):
        client.recv(timeout=0.05)


def test_a_flood_of_messages_is_bounded_and_the_others_are_served(setting: Setting) -> None:
    inbox = setting.bus.inbox("twist", TwistStamped)
    setting.bridge.step()
    flooder, other = setting.client(), setting.client()
    frame = json.dumps({"op": "publish", "topic": "/twist", "msg": {}})
    for _ in range(2000):
        flooder.send(frame)
    assert setting.ask(other, service="/rosapi/nodes")["result"] is True
    setting.step_until(lambda: setting.bridge.arrivals.n_arrived["twist"] == 2000)
    setting.bridge.step()
    assert inbox.last_message is not None


def mask(text: str) -> bytes:
    """A frame of a client with a text of less than 126 bytes; its mask is 0."""
    data = text.encode()
    assert len(data) < 126
    return bytes((0x81, 0x80 | len(data), 0, 0, 0, 0)) + data


@pytest.mark.slow
def test_of_a_flood_of_100_000_the_newest_are_kept_and_the_log_says_so(
    setting: Setting,
) -> None:
    limits = setting.bridge._limits  # read as fast as it can be
    limits.share, limits.work = 1e3, None
    actual: list[String] = []
    setting.bus.subscribe("text", String, actual.append)
    setting.bridge.step()
    flooder = setting.client()
    n = 100_000
    frames = b"".join(
        mask(json.dumps({"op": "publish", "topic": "/text", "msg": {"data": str(i)}}))
        for i in range(n)
    )
    thread = threading.Thread(target=flooder.socket.sendall, args=(frames,))
    thread.start()
    max_length = 0
    deadline = time.monotonic() + LIMIT
    while setting.bridge.arrivals.n_arrived["text"] < n:  # while it does not step
        max_length = max(max_length, len(setting.bridge.arrivals._queues.get("text", ())))
        assert time.monotonic() < deadline, "they never came"
        time.sleep(0.01)
    thread.join()
    assert 0 < max_length <= 1000
    assert any("faster than the simulation reads them" in line for line in setting.lines)
    assert len(setting.lines) < 20
    setting.bridge.step()
    assert [int(entry.data) for entry in actual] == list(range(n - 1000, n))
    assert setting.ask(setting.client(), service="/rosapi/nodes")["result"] is True


def test_a_publisher_that_breaks_off_in_the_middle_of_a_frame_is_forgotten(
    setting: Setting,
) -> None:
    inbox = setting.bus.inbox("text", String)
    setting.bridge.step()
    frame = mask('{"op": "publish", "topic": "/text", "msg": {"data": "whole"}}')
    broken_client = setting.client()
    broken_client.socket.sendall(frame + frame[:20])
    setting.step_until(lambda: inbox.last_message is not None)
    linger = struct.pack("ii", 1, 0)
    broken_client.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
    broken_client.socket.shutdown(socket.SHUT_RDWR)
    setting.step_until(lambda: not setting.bridge._sessions)
    other = setting.client()
    other.socket.sendall(frame)
    setting.step_until(lambda: setting.bridge.arrivals.n_arrived["text"] == 2)


def test_bytes_that_are_no_http_a_large_frame_and_a_vanished_peer_do_no_harm(
    setting: Setting,
) -> None:
    address = ("127.0.0.1", setting.bridge.port)
    for garbage in (b"\x00" * 1000, b"GET / HTTP/1.1\r\n\r\n", b"GET"):
        with socket.create_connection(address, timeout=LIMIT) as raw_peer:
            raw_peer.sendall(garbage)
    stalled_peer = socket.create_connection(address, timeout=LIMIT)
    large_client = setting.client()
    with suppress(ConnectionClosed):
        large_client.send("x" * (17 * 2**20))
    with pytest.raises(ConnectionClosed):
        large_client.recv(timeout=LIMIT)
    vanished_client = setting.client()
    vanished_client.socket.shutdown(socket.SHUT_RDWR)
    assert setting.ask(setting.client(), service="/rosapi/nodes")["result"] is True
    stalled_peer.close()


def test_a_reader_that_breaks_off_while_images_come_is_forgotten(setting: Setting) -> None:
    say = setting.bus.publisher("image", Image)
    client = setting.client(max_queue=1)
    send(client, op="subscribe", topic="/image")
    setting.step_until(lambda: setting.bus.has_subscribers("image"))
    for _ in range(20):
        say(Image(height=480, width=640, step=1920, data=np.zeros(921_600, np.uint8)))
        setting.bus.deliver()
    client.socket.shutdown(socket.SHUT_RDWR)
    setting.step_until(lambda: not setting.bus.has_subscribers("image"))
    assert setting.ask(setting.client(), service="/rosapi/nodes")["result"] is True


def test_pages_of_other_origins_are_refused(setting: Setting) -> None:
    assert setting.client(origin="http://localhost:8080")
    for origin in ("https://example.org", "null", "http://localhost.example.org"):
        with pytest.raises(InvalidStatus) as excinfo:
            setting.client(origin=origin)
        assert excinfo.value.response.status_code == 403


def test_a_token_is_asked_for() -> None:
    setting = Setting(token="secret")
    try:
        for path in ("/", "/?token=wrong"):
            with pytest.raises(InvalidStatus) as excinfo:
                setting.client(path)
            assert excinfo.value.response.status_code == 401
        assert setting.client("/?token=secret")
        assert setting.client(additional_headers={"Authorization": "Bearer secret"})
    finally:
        setting.close()


def test_other_computers_need_a_token_and_a_used_port_is_one_line(setting: Setting) -> None:
    with pytest.raises(BadSetting, match="UWSIM_WEB_TOKEN"):
        WebOptions(host="0.0.0.0")
    with pytest.raises(BadSetting, match="--web 70000"):
        WebOptions(port=70000)
    with pytest.raises(BadSetting, match="cannot listen on 127"):
        WebBridge(Bus(), lambda: 0.0, WebOptions(port=setting.bridge.port))


def test_the_clock_of_ros_is_served(setting: Setting) -> None:
    client = setting.client()
    send(client, op="subscribe", topic="/clock")
    setting.time = 0.25
    setting.step_until(lambda: "clock" in setting.bridge._readers)
    setting.bridge.step()
    assert receive(client)["msg"] == {"clock": {"sec": 1, "nanosec": 250_000_000}}


def test_more_clients_than_are_served_are_refused_with_a_line(
    setting: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.middleware.web.server.MAX_CLIENTS", 1)
    setting.bridge.step()
    setting.client()
    with pytest.raises(InvalidStatus, match="503"):
        setting.client()
    assert "uwsim: web: more than 1 clients; one is refused" in setting.lines


def test_a_service_of_a_client_that_does_not_answer_holds_up_who_calls_it_alone(
    setting: Setting,
) -> None:
    kind = "underwater_sensor_msgs/srv/GTpublish"
    setting.bridge.step()
    offerer, caller = setting.client(), setting.client()
    send(offerer, op="advertise_service", service="/slow", type=kind)
    setting.step_until(lambda: "slow" in setting.bridge.graph.services)
    send(caller, op="call_service", id="1", service="/slow", args={"groundTruth": [1.0]})
    start_time = time.monotonic()
    requests: list[Any] = []

    def is_asked() -> bool:
        with suppress(TimeoutError):
            requests.append(json.loads(offerer.recv(timeout=0.001)))
        return bool(requests)

    setting.step_until(is_asked)
    for _ in range(10):
        setting.bridge.step()
    assert time.monotonic() - start_time < 10.0  # a call that is waited for takes 60 s
    with pytest.raises(TimeoutError):
        caller.recv(timeout=0.01)
    send(offerer, op="service_response", id=requests[0]["id"], values={}, result=True)
    assert receive(caller)["result"] is True
    send(caller, op="call_service", id="2", service="/slow", args={"groundTruth": [1.0]})
    requests.clear()
    setting.step_until(is_asked)
    offerer.close()
    answers: list[Any] = []

    def is_answered() -> bool:
        with suppress(TimeoutError):
            answers.append(json.loads(caller.recv(timeout=0.001)))
        return bool(answers)

    setting.step_until(is_answered)
    assert answers[0]["result"] is False


def test_a_message_to_one_client_reaches_no_other(setting: Setting) -> None:
    setting.bus.publisher("tick", String)
    clients = [setting.client() for _ in range(2)]
    for client in clients:
        send(client, op="subscribe", topic="/tick", id="t")
    setting.step_until(lambda: len(setting.bridge._readers.readers_of("tick")) == 2)
    name = f"client 127.0.0.1:{clients[0].local_address[1]}"
    setting.bridge.send_to(name, "tick", String(data="no"))
    setting.bridge.send("tick", String(data="all"))
    arrivals = [json.loads(client.recv(LIMIT))["msg"]["data"] for client in clients]
    assert arrivals == ["no", "all"]
