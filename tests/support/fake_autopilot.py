"""An autopilot of MAVLink at a TCP port, made with pymavlink: it answers as ArduSub does.

It has no physics. It changes mode and arming on command, refuses to arm while ``can_arm`` is False,
and keeps all messages. It is polled, so tests decide when it reads and sends.
"""

from __future__ import annotations

import socket
import time
from typing import Any

import pymavlink.dialects.v20.ardupilotmega as dialect

SUBMARINE, ARDUPILOT = 12, 3


class FakeAutopilot:
    """A server of one client, which sends heartbeats once a second of the test's own clock."""

    def __init__(
        self,
        *,
        system: int = 1,
        vehicle_type: int = SUBMARINE,
        listener: socket.socket | None = None,
    ) -> None:
        self._owns_listener = listener is None
        self._listener = listener or socket.create_server(("127.0.0.1", 0))
        self._listener.setblocking(False)
        self._peer: socket.socket | None = None
        self._link = dialect.MAVLink(None, system, 1)
        self._link.robust_parsing = True
        self._heartbeat_time = 0.0
        self.vehicle_type, self.can_arm = vehicle_type, True
        self.has_estimate = False
        self.is_armed, self.mode = False, 19
        self.messages: list[Any] = []

    @property
    def address(self) -> str:
        return f"tcp:127.0.0.1:{self._listener.getsockname()[1]}"

    def accept(self) -> None:
        """Wait for the client."""
        end = time.monotonic() + 10.0
        while self._peer is None:
            assert time.monotonic() < end
            try:
                self._peer, _ = self._listener.accept()
            except BlockingIOError:
                time.sleep(0.005)
        self._peer.setblocking(False)

    def poll(self, now: float) -> None:
        """Read and answer messages; send a heartbeat if one is due at ``now`` [s]."""
        assert self._peer is not None
        try:
            data = self._peer.recv(1 << 20)
        except BlockingIOError:
            data = b""
        for message in self._link.parse_buffer(data) or []:
            self.messages.append(message)
            self._answer(message)
        if now >= self._heartbeat_time:
            self._heartbeat_time = now + 1.0
            self.send_heartbeat()
            if self.has_estimate:
                self.send(dialect.MAVLink_local_position_ned_message(0, 0, 0, 0, 0, 0, 0))

    def _answer(self, message: Any) -> None:
        if message.get_type() != "COMMAND_LONG":
            return
        result = 0
        if message.command == 400:
            if message.param1 and not self.can_arm:
                result = 4
                self.send_text(2, "Arm: EKF attitude is bad")
            else:
                self.is_armed = bool(message.param1)
        elif message.command == 176:
            self.mode = int(message.param2)
        self.send(dialect.MAVLink_command_ack_message(message.command, result, 0, 0, 255, 190))
        self.send_heartbeat()

    def send_heartbeat(self) -> None:
        base_mode = 1 | (128 if self.is_armed else 0)
        self.send(
            dialect.MAVLink_heartbeat_message(
                self.vehicle_type, ARDUPILOT, base_mode, self.mode, 4, 3
            )
        )

    def send_text(self, severity: int, text: str) -> None:
        self.send(dialect.MAVLink_statustext_message(severity, text.encode(), 0, 0))

    def send(self, message: Any) -> None:
        self.send_bytes(bytes(message.pack(self._link)))
        self._link.seq = (self._link.seq + 1) % 256

    def send_bytes(self, data: bytes) -> None:
        assert self._peer is not None
        self._peer.sendall(data)

    def find_messages(self, name: str) -> list[Any]:
        """Return the messages of a name that have come so far."""
        return [message for message in self.messages if message.get_type() == name]

    def close(self) -> None:
        if self._owns_listener:
            self._listener.close()
        if self._peer is not None:
            self._peer.close()
