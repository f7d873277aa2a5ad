"""A stand-in for PX4 that behaves as its module simulator_mavlink does in lock-step."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

import pytest

N_START = 20
"""The number of HIL_SENSOR messages during which PX4's start script runs."""
Control = Callable[[Any], Sequence[float]]
"""A function from HIL_SENSOR to the outputs of PX4, at most 16."""


def import_dialect() -> ModuleType:
    """Return pymavlink's module of common messages, or skip the test."""
    module: ModuleType = pytest.importorskip("pymavlink.dialects.v20.common")
    return module


class Px4Stub:
    """A client that connects, sends HEARTBEAT and waits for HIL_SENSOR, in a thread.

    PX4's clock is the time of the last HIL_SENSOR. Once it has started, it answers each of them
    with HIL_ACTUATOR_CONTROLS of the same time, and with zeros unless it is armed.

    Args:
        port: the TCP port of the simulator.
        control: the controller.
        n_answers: the number of answers after which it leaves; None: it stays.
        flags: the flags of the answers.
        garbage: the bytes that it sends before each answer.
        is_armed: True to arm it.
        sends_stale: True to send the answer before this one as well.
        has_delay: True to send garbage apart from answers, which TCP then delays.
    """

    def __init__(
        self,
        port: int,
        control: Control,
        *,
        n_answers: int | None = None,
        flags: int = 1,
        garbage: bytes = b"",
        is_armed: bool = True,
        sends_stale: bool = False,
        has_delay: bool = False,
    ) -> None:
        self._dialect = import_dialect()
        self._port, self._control, self._n_answers = port, control, n_answers
        self._flags, self._garbage, self._is_armed = flags, garbage, is_armed
        self._sends_stale, self._has_delay = sends_stale, has_delay
        self.sensors: list[Any] = []
        """The HIL_SENSOR messages since the start."""
        self.other_messages: list[Any] = []
        """The other messages since the start."""
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def join(self) -> None:
        """Wait until the connection has been closed."""
        self._thread.join(timeout=30.0)

    def _run(self) -> None:
        connection = connect(self._port)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, not self._has_delay)
        link = self._dialect.MAVLink(None, srcSystem=1, srcComponent=1)
        connection.sendall(link.heartbeat_encode(0, 12, 0, 0, 0).pack(link))
        request = link.command_long_encode(0, 0, 511, 0, 115, 5000.0, 0, 0, 0, 0, 0)
        connection.sendall(request.pack(link))
        n_sensors = 0
        with connection:
            while self._n_answers is None or len(self.sensors) < self._n_answers:
                try:
                    data = connection.recv(4096)
                except OSError:
                    return
                if not data:
                    return
                for message in link.parse_buffer(data) or []:
                    is_sensor = message.get_type() == "HIL_SENSOR"
                    n_sensors += is_sensor
                    if n_sensors < N_START:
                        continue
                    if is_sensor:
                        self.sensors.append(message)
                        self._answer(connection, link, message)
                    else:
                        self.other_messages.append(message)

    def _answer(self, connection: socket.socket, link: Any, sensor: Any) -> None:
        outputs = self._control(sensor) if self._is_armed else ()
        controls = [*map(float, outputs), *[0.0] * (16 - len(outputs))]
        mode = 129 if self._is_armed else 1
        data = self._garbage
        if self._has_delay:
            connection.sendall(data)
            data = b""
        for time in [sensor.time_usec - 4000] * self._sends_stale + [sensor.time_usec]:
            data += link.hil_actuator_controls_encode(time, controls, mode, self._flags).pack(link)
        connection.sendall(data)


def connect(port: int) -> socket.socket:
    """Return a connection to a port of this computer, as soon as it is open."""
    while True:
        try:
            connection = socket.create_connection(("127.0.0.1", port), timeout=30.0)
        except ConnectionRefusedError:
            continue
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection


def find_free_port() -> int:
    """Return a TCP port that is free now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
