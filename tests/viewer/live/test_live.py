"""The live view: what viewers get, what they may say, and that they change nothing."""

import gzip
import http.client
import json
import struct
import threading
import tracemalloc
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

import uwsim
from tests.support.handshakes import status_of
from tests.support.short_benchmark import bench_of, fingerprint, run, write_benchmark
from tests.viewer.live.desk import Desk
from uwsim.algorithms.pilot import AXES, Pilot
from uwsim.base.geometry import Pose
from uwsim.errors import BadSetting
from uwsim.results import journal
from uwsim.results.result_file import load
from uwsim.runs.executors.executor import SerialExecutor, run_all
from uwsim.runs.trial.pilot_inputs import PilotInputs
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.viewer.live.clock import Clock
from uwsim.viewer.live.mapping import KEYS, PilotMapping, read_mapping, sum_inputs
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession

WAIT = 60.0
"""Bound on hanging [s]."""


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[LiveServer]:
    monkeypatch.setattr("uwsim.viewer.live.server.CLOSE_TIMEOUT", 0.2)  # [s]
    made = LiveServer(lambda: "<p>page</p>")
    yield made
    made.close()


def socket_of(server: LiveServer, **options: Any) -> ClientConnection:
    url = server.url.replace("http://", "ws://").replace("/?", "/socket?")
    reading = {"max_queue": None, "ping_interval": None} | options  # also while a test is busy
    return connect(url, open_timeout=WAIT, close_timeout=0.1, max_size=None, **reading)


def get(server: LiveServer, path: str) -> tuple[int, str]:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT)
    connection.request("GET", path)
    answer = connection.getresponse()
    body = answer.read().decode()
    connection.close()
    return answer.status, body


def test_the_page_needs_the_token_of_the_address(server: LiveServer) -> None:
    assert get(server, server.url.partition(str(server.port))[2]) == (200, "<p>page</p>")
    for path in ("/", "/?token=guess", "/socket", "/?token=%C3%A9"):
        assert get(server, path)[0] == 403
    assert get(server, "/other?" + server.url.partition("?")[2])[0] == 404


def test_a_socket_needs_the_token_and_the_origin_of_the_page(server: LiveServer) -> None:
    with pytest.raises(InvalidStatus), socket_of(server, origin="http://elsewhere.example"):
        pass
    guess = f"ws://127.0.0.1:{server.port}/socket?token=x"
    with pytest.raises(InvalidStatus), connect(guess, open_timeout=WAIT):
        pass
    server.publish("head", b"head")
    with socket_of(server, origin=f"http://127.0.0.1:{server.port}") as socket:
        assert socket.recv(timeout=WAIT) == b"head"


def test_whoever_comes_gets_the_newest_of_each_channel_oldest_first(server: LiveServer) -> None:
    server.publish("head", b"head")
    for k in range(5):
        server.publish("row", b"%d" % k)
    server.publish("?image/a", b"image")
    with socket_of(server) as one, socket_of(server) as two:
        for socket in (one, two):
            assert [socket.recv(timeout=WAIT) for _ in range(2)] == [b"head", b"4"]
        one.send(json.dumps({"type": "images", "cameras": ["a"]}))
        server_has(server, 1)
        server.publish("?image/a", b"newer")
        assert one.recv(timeout=WAIT) == b"newer"
        server.publish("row", b"5")
        assert two.recv(timeout=WAIT) == b"5"


def server_has(server: LiveServer, n: int) -> list[tuple[int, dict[str, Any]]]:
    """Wait until viewers have said n things."""
    found: list[tuple[int, dict[str, Any]]] = []
    pause = threading.Event()
    for _ in range(6000):
        found += server.pop_messages()
        if len(found) >= n:
            return found
        pause.wait(0.01)
    raise AssertionError(f"only {len(found)} messages came")


@pytest.mark.parametrize(
    "said",
    ["x" * 5000, "x" * 10_000_000, "no json", "[1]", '{"type": 3}', b"bytes", "[" * 4000],
    ids=["long", "10 MB", "text", "list", "number", "bytes", "deep"],
)
def test_a_viewer_who_says_nonsense_is_disconnected_and_the_others_stay(
    server: LiveServer, said: str | bytes
) -> None:
    server.publish("row", b"1")
    with socket_of(server) as good, socket_of(server) as bad:
        assert good.recv(timeout=WAIT) == bad.recv(timeout=WAIT) == b"1"
        with pytest.raises(ConnectionClosed):
            say(bad, said)
        server.publish("row", b"2")
        assert good.recv(timeout=WAIT) == b"2"


def say(socket: ClientConnection, text: str | bytes) -> None:
    socket.send(text)  # may end while it is being sent
    socket.recv(timeout=WAIT)


def test_a_viewer_who_says_too_much_is_disconnected(
    server: LiveServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.viewer.live.server.MAX_MESSAGES", 3)  # a second, on any computer
    with socket_of(server) as socket, pytest.raises(ConnectionClosed):
        say_much(socket)


def say_much(socket: ClientConnection) -> None:
    for _ in range(1000):
        socket.send('{"type": "input"}')
    socket.recv(timeout=WAIT)


def test_a_reader_who_stalls_costs_nothing_and_the_others_go_on(server: LiveServer) -> None:
    big = bytes(200_000)
    with socket_of(server) as good, socket_of(server, max_queue=1) as stalled:
        assert stalled is not None
        for k in range(50):
            server.publish("row", struct.pack("<I", k) + big)
        last = -1
        while last < 49:
            data = good.recv(timeout=WAIT)
            assert isinstance(data, bytes)
            (last,) = struct.unpack_from("<I", data)


def test_a_reader_who_stalls_holds_less_than_a_megabyte(server: LiveServer) -> None:
    image, n = bytes(60_000), 400  # 24 MB: more than sockets of the system hold
    server.publish("row", image)
    with socket_of(server, max_queue=1), socket_of(server, max_queue=1) as good:
        good.recv(timeout=WAIT)
        tracemalloc.start()
        try:
            for k in range(n):
                server.publish("row", struct.pack("<I", k) + image)
                good.recv(timeout=WAIT)
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
    assert peak < 1e6  # [byte]; readers and server are in this process


@pytest.mark.parametrize(
    "request_lines",
    [
        "GET //[ HTTP/1.1",
        "GET http://[::1/socket HTTP/1.1",
        "GET TARGET HTTP/1.1\r\nOrigin: http://a\r\nOrigin: http://b",
    ],
)
def test_a_request_of_nonsense_is_answered_and_the_page_serves_on(
    server: LiveServer, request_lines: str, capfd: pytest.CaptureFixture[str]
) -> None:
    target = "/socket?" + server.url.partition("?")[2]
    lines = request_lines.replace("TARGET", target)
    assert status_of(server.port, lines, WAIT) in ("400", "403")
    with socket_of(server):
        pass
    assert "Traceback" not in capfd.readouterr().err


def test_a_port_that_is_taken_is_said_in_a_line(server: LiveServer) -> None:
    with pytest.raises(BadSetting, match=rf"--port {server.port}: cannot be opened: Address al.*"):
        LiveServer(lambda: "", server.port)


def test_a_clock_waits_for_the_wall_and_single_steps_are_counted() -> None:
    now = [0.0]
    clock = Clock(2.0, lambda: now[0], lambda seconds: now.__setitem__(0, now[0] + seconds))
    clock.begin(0.0)
    assert not clock.has_to_wait(0.0)
    while clock.has_to_wait(1.0):
        clock.sleep(1.0)
    assert now[0] == pytest.approx(0.5, abs=0.01)
    assert clock.apply_control({"action": "step"})
    assert not clock.has_to_wait(9.0)
    clock.count_step()
    assert clock.has_to_wait(9.0)
    assert clock.apply_control({"action": "play"})
    assert clock.apply_control({"action": "speed", "speed": 0})
    assert not clock.has_to_wait(99.0)
    assert not clock.apply_control({"action": "speed", "speed": "fast"})
    assert not clock.apply_control({"action": "reset"})


def test_keys_gamepad_and_sticks_become_axes_and_nonsense_counts_as_nothing() -> None:
    mapping = PilotMapping()
    at = AXES.index
    values = mapping.values({"keys": ["w", "q", "?"], "axes": [0.05, 0.5], "sticks": [0, 0, 1, 1]})
    assert values[at("surge")] == 1.0
    assert values[at("yaw")] == -1.0
    assert values[at("heave")] == -0.5
    assert values[at("sway")] == 1.0
    odd = {"keys": "w", "axes": [None, float("nan"), "1"], "buttons": {}, "sticks": [True]}
    assert not any(mapping.values(odd))
    assert sum_inputs({}) is None
    assert sum_inputs({1: values, 2: values})[at("heave")] == -1.0  # type: ignore[index]
    assert not {"f", "c", "1", "2", "3"} & KEYS.keys()  # those of the page


def test_a_mapping_file_changes_what_it_names_and_errors_name_the_nearest(tmp_path: Path) -> None:
    path = tmp_path / "mapping.toml"
    path.write_text('dead_zone = 0.2\naxes = ["surge"]\n[keys]\nz = "+jaw"\n')
    mapping = read_mapping(path)
    assert mapping.values({"axes": [0.5]})[:1] == (0.5,)
    assert mapping.keys == {**KEYS, "z": "+jaw"}
    assert mapping.sticks == PilotMapping().sticks
    path.write_text('buttons = ["thruster2"]\n[keys]\nw = "+thruster1 -thruster3"\n')
    values = dict(
        zip(AXES, read_mapping(path).values({"keys": ["w"], "buttons": [0.7]}), strict=True)
    )
    moved = {axis: value for axis, value in values.items() if value}
    assert moved == {"thruster1": 1.0, "thruster2": 0.7, "thruster3": -1.0}
    for text, said in [
        ('axes = ["surg"]', "Did you mean 'surge'"),
        ('axes = ["surge thruster13"]', "no axis is called 'thruster13'"),
        ("dead_zone = 2", "expected 0 to 1"),
        ("key = 1", "Did you mean 'keys'"),
        ('keys = ["w"]', "keys is"),
        ("[", "cannot be read"),
    ]:
        path.write_text(text)
        with pytest.raises(BadSetting, match="--pilot-mapping") as error:
            read_mapping(path)
        assert said in str(error.value)


def test_a_bench_with_a_viewer_has_the_bytes_of_one_without(
    server: LiveServer, tmp_path: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    run(benchmark, tmp_path / "without")
    session = LiveSession(server, real_time_factor=0.0)
    with socket_of(server) as socket:
        socket.send(json.dumps({"type": "images", "cameras": ["bowtech1"]}))
        topics = ["cornersTopic", "autoInit", "uwsim/camera1", "no such topic"]
        socket.send(json.dumps({"type": "topics", "names": topics}))
        run_all([bench_of(benchmark, tmp_path / "with")], SerialExecutor(session))
        session.end("over")
        heard: list[Any] = []
        while not heard or "over" not in str(heard[-1]):
            heard.append(socket.recv(timeout=WAIT))
    assert fingerprint(tmp_path / "with") == fingerprint(tmp_path / "without")
    kinds = {data[0] for data in heard if isinstance(data, bytes)}
    assert {0, 1} <= kinds
    head = next(data for data in heard if isinstance(data, bytes) and data[0] == 0)
    content = gzip.decompress(head[16:])
    (length,) = struct.unpack_from("<I", content)
    motion = json.loads(content[4 : 4 + length])["motion"]
    row = [data for data in heard if isinstance(data, bytes) and data[0] == 1][-1]
    assert len(np.frombuffer(row, "<f4", offset=16)) == 7 * len(motion["bodies"]) + len(
        motion["signals"]
    )
    texts = [json.loads(data) for data in heard if isinstance(data, str)]
    assert {"readings", "topics"} <= {text["type"] for text in texts}
    levels = [text["levels"] for text in texts if text["type"] == "levels"][-1]
    assert [level["label"] for level in levels] == ["fog 0", "fog 0.4", "fog 0.8"]


def test_a_row_follows_soon_after_an_input_and_as_often_as_ever_if_inputs_keep_coming() -> None:
    desk, now = Desk(), [0.0]
    session = LiveSession(desk, real_time_factor=0.0, mapping=PilotMapping(), wall=lambda: now[0])  # type: ignore[arg-type]
    rows: list[int] = []  # at these milliseconds

    def pass_by(milliseconds: int) -> None:
        for _ in range(milliseconds):
            now[0] = round(now[0] + 0.001, 3)
            desk.published.clear()
            simulation.advance()
            rows.extend([round(1e3 * now[0])] * len(desk.on("row")))

    with uwsim.load("remus-scene") as simulation:
        session.open(simulation, "scene")
        pass_by(100)
        began = rows[-1] + 2
        pass_by(began - round(1e3 * now[0]))
        desk.said.append((1, {"type": "input", "keys": ["w"]}))
        pass_by(15)
        assert [row - began for row in rows if row > began] == [11]
        desk.said.append((1, {"type": "input", "keys": ["w"]}))  # as before: no news
        pass_by(15)
        assert rows[-1] == began + 11
        n = len(rows)
        for k in range(200):
            desk.said.append((1, {"type": "input", "keys": ["w"] if k % 2 else []}))
            pass_by(1)
        assert 10 <= len(rows) - n <= 25


@pytest.mark.parametrize(
    "scene",
    [
        "currents-scene",
        pytest.param("grasp-scene", marks=pytest.mark.slow),
        pytest.param("two-vehicles-scene", marks=pytest.mark.slow),
        "cirs",
    ],
)
def test_a_reset_puts_everything_back_where_it_began_and_time_goes_on(scene: str) -> None:
    desk = Desk()
    session = LiveSession(desk, real_time_factor=0.0, mapping=PilotMapping(), allows_reset=True)  # type: ignore[arg-type]
    with uwsim.load(scene) as simulation:
        PilotInputs(simulation, session.pilot)
        simulation.attach(Pilot(), parameters={**pilot_topics(simulation), "start": ""})
        session.open(simulation, "scene")
        name = simulation.world.vehicles.names[0]
        began = simulation.pose(name).position.copy()
        desk.said.append((1, {"type": "input", "keys": ["w", "q", "t"]}))
        simulation.advance(2.0)
        assert np.abs(simulation.pose(name).position - began).max() > 0.1
        desk.said += [
            (1, {"type": "input", "keys": []}),
            (1, {"type": "control", "action": "reset"}),
        ]
        simulation.advance()
        back = simulation.pose(name).position
        assert simulation.time == pytest.approx(2.002)
        assert np.abs(back - began).max() < 0.01
        simulation.advance(1.0)
        again = np.abs(simulation.pose(name).position - began).max()
        assert again < 0.3


def test_nobody_resets_a_benchmark() -> None:
    desk = Desk()
    session = LiveSession(desk, real_time_factor=0.0)  # type: ignore[arg-type]
    with uwsim.load("cirs") as simulation:
        session.open(simulation, "scene")
        world_from_elsewhere = Pose.from_rpy((1.0, 2.0, -3.0), (0.0, 0.0, 0.0))
        simulation.world.engine.place_vehicle(0, world_from_elsewhere)
        desk.said.append((1, {"type": "control", "action": "reset"}))
        simulation.advance(0.01)
        assert simulation.pose("girona500", "W").position == pytest.approx([1.0, 2.0, -3.0])


class Scribble:
    """A pilot whose hand is a function of how often it is asked."""

    def __init__(self) -> None:
        self.n = 0

    def __call__(self) -> tuple[float, ...]:
        self.n += 1
        values = [0.0] * len(AXES)
        values[0], values[5] = (self.n % 7) / 7.0, ((self.n // 3) % 5) / 5.0 - 0.4
        return tuple(values)


def test_a_pilots_run_is_stored_and_sent_again_with_the_same_bytes(
    server: LiveServer, tmp_path: Path
) -> None:
    text = write_benchmark(tmp_path, "0.2").read_text()
    benchmark = tmp_path / "pilot.xml"
    benchmark.write_text(text.replace("visibility-scene.xml", "currents-scene.xml"))
    session = LiveSession(server, real_time_factor=0.0, mapping=PilotMapping())
    session.pilot = Scribble()  # type: ignore[method-assign]
    settings, levels = ["algorithm.speed=0.8"], ["fog=0.4"]
    flown = bench_of(
        benchmark, tmp_path / "flown", algorithm="pilot", settings=settings, levels=levels
    )
    run_all([flown], SerialExecutor(session))
    stored = journal.path_of(tmp_path / "flown", 0).with_suffix(journal.INPUTS)
    head, *lines = stored.read_text().splitlines()
    assert json.loads(head)["axes"] == list(AXES)
    assert len(lines) >= 5
    stored_again = f"scripted:{tmp_path / 'flown'}"
    run(benchmark, tmp_path / "again", algorithm=stored_again, levels=levels)
    assert fingerprint(tmp_path / "again") == fingerprint(tmp_path / "flown")
    assert load(tmp_path / "again").run.algorithm == "pilot"
