"""Commands to thrusters from outside: applied, refused, counted, and never in the way."""

from __future__ import annotations

import os
import random
import socket
import time
from pathlib import Path

import numpy as np
import pytest

from tests.devices.streams.stream_scenes import instrument, open_streams
from tests.support.opened import open_scene
from uwsim.autopilots.instruments.commands import ThrusterCommands
from uwsim.autopilots.instruments.utc import parse_epoch
from uwsim.devices.streams.actuator_stream import ActuatorStream
from uwsim.devices.streams.instrument_stream import InstrumentStream
from uwsim.errors import SceneError
from uwsim.messages import Float64MultiArray
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

COMMAND = ThrusterCommands(values=(0.5,) * 8)


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


def actuator(address: str, *, format: str = "sentence", more: str = "") -> str:
    return (
        f"<u:actuatorStream> <name>thrusters</name> <address>{address}</address>"
        f"<format>{format}</format> {more} </u:actuatorStream>"
    )


def stream_of(simulation: Simulation) -> ActuatorStream:
    return next(d for d in simulation.world.devices if isinstance(d, ActuatorStream))


class Sender:
    """A program outside that sends datagrams to a stream."""

    def __init__(self, port: int) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._port = port

    def send(self, data: bytes) -> None:
        self._socket.sendto(data, ("127.0.0.1", self._port))

    def close(self) -> None:
        self._socket.close()


@pytest.mark.parametrize("format", ["sentence", "binary"])
def test_a_command_moves_the_vehicle_and_is_published(tmp_path: Path, format: str) -> None:
    port = free_port()
    text = actuator(f"udpin:127.0.0.1:{port}", format=format, more="<topic>applied</topic>")
    with open_streams(tmp_path, text, udp_address="127.0.0.1") as simulation:
        applied: list[Float64MultiArray] = []
        simulation.bus.subscribe("applied", Float64MultiArray, applied.append)
        data = COMMAND.to_binary() if format == "binary" else COMMAND.to_sentence().to_bytes()
        sender = Sender(port)
        sender.send(data)
        simulation.advance(1.0)
        vehicle = simulation.world.vehicles.find("rov")
        assert float(np.abs(vehicle.velocity).max()) > 0.05
        assert stream_of(simulation).state.n_valid == 1
        assert [message.data.tolist() for message in applied] == [[0.5] * 8]
        sender.close()


def test_thrusters_stop_when_no_command_arrives_for_the_timeout(tmp_path: Path) -> None:
    port = free_port()
    more = "<timeout>0.2</timeout> <topic>applied</topic>"
    text = actuator(f"udpin:127.0.0.1:{port}", more=more)
    with open_streams(tmp_path, text, udp_address="127.0.0.1") as simulation:
        applied: list[tuple[float, float]] = []
        simulation.bus.subscribe(
            "applied", Float64MultiArray, lambda m: applied.append((simulation.time, m.data[0]))
        )
        sender = Sender(port)
        sender.send(COMMAND.to_sentence().to_bytes())
        simulation.advance(1.0)
        sender.close()
    assert [value for _, value in applied] == [0.5, 0.0]
    assert applied[1][0] == pytest.approx(0.2, abs=0.006)


def test_a_sentence_may_arrive_in_pieces_on_a_terminal(tmp_path: Path) -> None:
    with open_streams(tmp_path, actuator("pty"), udp_address="127.0.0.1") as simulation:
        path = stream_of(simulation).description.split()[3]
        terminal = os.open(path, os.O_RDWR | os.O_NOCTTY)
        data = b"noise" + COMMAND.to_sentence().to_bytes()
        for i in range(0, len(data), 7):
            os.write(terminal, data[i : i + 7])
            simulation.advance()
        os.close(terminal)
        state = stream_of(simulation).state
    assert (state.n_valid, state.n_invalid, state.n_skipped) == (1, 0, 5)


def test_a_command_for_other_thrusters_is_refused(tmp_path: Path) -> None:
    port = free_port()
    with open_streams(
        tmp_path, actuator(f"udpin:127.0.0.1:{port}"), udp_address="127.0.0.1"
    ) as simulation:
        sender = Sender(port)
        sender.send(ThrusterCommands(values=(0.5,) * 6).to_sentence().to_bytes())
        simulation.advance(0.1)
        sender.close()
        state = stream_of(simulation).state
    assert (state.n_valid, state.n_invalid) == (0, 1)


@pytest.mark.parametrize("format", ["sentence", "binary"])
def test_hostile_datagrams_are_counted_and_the_rate_is_kept(tmp_path: Path, format: str) -> None:
    port, rng = free_port(), random.Random(3)
    text = actuator(f"udpin:127.0.0.1:{port}", format=format)
    valid = COMMAND.to_binary() if format == "binary" else COMMAND.to_sentence().to_bytes()
    floods = [
        rng.randbytes(1400),
        b"$" * 1400,
        b"$\n" * 700,
        b"UW\x01\x20" * 350,
        valid.replace(b"0.5000", b"nan") if format == "sentence" else valid[:-1] + b"\x00",
        b"\n" * 1400,
        b"",
    ]
    with open_streams(tmp_path, text, udp_address="127.0.0.1") as simulation:
        simulation.advance(0.1)
        sender, stream = Sender(port), stream_of(simulation)
        longest = 0.0
        for _ in range(30):
            for flood in floods * 8:
                sender.send(flood)
            start = time.process_time()
            simulation.advance()
            longest = max(longest, time.process_time() - start)
        state = stream.state
        assert state.n_valid == 0
        assert state.n_invalid + state.n_skipped > 1000
        assert len(state.rest) <= 512
        assert longest < 0.1  # usually 3 ms; a step takes 2 ms of simulation time
        for _ in range(500):  # the port's buffer empties at a bounded rate
            sender.send(valid)
            simulation.advance()
            if state.n_valid:
                break
        assert state.n_valid
        sender.close()


def test_a_run_without_connections_receives_nothing(tmp_path: Path) -> None:
    with open_streams(tmp_path, actuator("udpin:127.0.0.1:1")) as simulation:
        simulation.advance(0.1)
        assert not stream_of(simulation).is_open


def test_a_vehicle_without_thrusters_is_an_error_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"

    path.write_text(
        '<UWSimScene xmlns:u="urn:uwsim:1">\n<vehicle> <name>rov</name>'
        "<file>bluerov2_heavy.urdf</file>\n" + actuator("pty") + "</vehicle></UWSimScene>"
    )
    with pytest.raises(SceneError, match=r"scene.xml:3: .*rov has no thrusters"):
        open_scene(read_scene(path))


class Notes:
    """An observer that keeps what it is told."""

    def __init__(self) -> None:
        self.notes: list[tuple[object, ...]] = []

    def note_sent(self, name: str, time: float, due_time: float) -> None:
        self.notes.append((name, time, due_time))

    def note_unsent(self, name: str) -> None:
        self.notes.append((name,))

    def note_command(self, name: str, stamp: float | None) -> None:
        self.notes.append((name, stamp))


@pytest.mark.parametrize("format", ["sentence", "binary"])
def test_an_observer_learns_which_measurement_a_command_answers(
    tmp_path: Path, format: str
) -> None:
    port = free_port()
    text = actuator(f"udpin:127.0.0.1:{port}", format=format)
    answer = ThrusterCommands(
        values=(0.1,) * 8, time_us=parse_epoch("2026-01-01T00:00:00Z") + 250_000
    )
    with open_streams(tmp_path, text, udp_address="127.0.0.1") as simulation:
        observer = Notes()
        stream_of(simulation).observer = observer
        sender = Sender(port)
        for command in (answer, ThrusterCommands(values=(0.1,) * 8)):
            data = command.to_binary() if format == "binary" else command.to_sentence().to_bytes()
            sender.send(data)
        simulation.advance(0.1)
        sender.close()
    assert observer.notes == [("thrusters", 0.25), ("thrusters", None)]


def test_an_observer_learns_when_a_message_leaves_a_slow_line(tmp_path: Path) -> None:
    port = free_port()
    more = f"<bitRate>9600</bitRate> <address>udpout:127.0.0.1:{port}</address>"
    stream = instrument("PD4", "/dvl", name="dvl_line", more=more)
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
        open_streams(tmp_path, stream, udp_address="127.0.0.1") as simulation,
    ):
        receiver.bind(("127.0.0.1", port))
        observer = Notes()
        device = next(d for d in simulation.world.devices if isinstance(d, InstrumentStream))
        device.observer = observer
        simulation.advance(0.18)
    (first, second) = observer.notes
    assert first == ("dvl_line", 0.0, pytest.approx(47 * 10 / 9600))
    assert second == ("dvl_line", 0.1, pytest.approx(0.1 + 47 * 10 / 9600))
