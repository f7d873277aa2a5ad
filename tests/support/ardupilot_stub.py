"""A stand-in for ArduPilot's software in the loop, which sends and reads as its JSON backend does.

It sends servo packets with counts, sends a packet again after a silence, and reads answers by the
rules of that backend, not as JSON: the text between the last two line ends, and a search for each
key in turn. Its control law is a function of the state that it has read; it can lose packets and
answers, start again, and send what is wrong.
"""

from __future__ import annotations

import random
import socket
import struct
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

MAGIC_16, MAGIC_32 = 18458, 29569
KEYS = (
    ("", "timestamp", 1, True),
    ("imu", "gyro", 3, True),
    ("imu", "accel_body", 3, True),
    ("", "position", 3, False),
    ("", "latitude", 1, False),
    ("", "longitude", 1, False),
    ("", "altitude", 1, False),
    ("", "attitude", 3, False),
    ("", "quaternion", 4, False),
    ("", "velocity", 3, True),
    *(("", f"rng_{i}", 1, False) for i in range(1, 7)),
    ("", "velocity_wind", 3, False),
    ("battery", "voltage", 1, False),
    ("battery", "current", 1, False),
)
"""The section, key, count of numbers, and whether ArduPilot requires the key."""
State = dict[str, tuple[float, ...]]
Law = Callable[[State], list[int]]
NEUTRAL_WIDTHS = [1500] * 8


def read_number(text: str) -> tuple[float, str]:
    """Read the longest number at the begin of a text, as C's strtod does; 0 without one."""
    for end in range(len(text), 0, -1):
        try:
            return float(text[:end]), text[end:]
        except ValueError:
            continue
    return 0.0, text


def scan_vector(text: str, count: int) -> tuple[float, ...] | None:
    """Read ``[1, 2, 3]`` as C's sscanf does with the format "[%f, %f, %f]"."""
    if not text.startswith("["):
        return None
    numbers, rest = [], text[1:]
    for i in range(count):
        rest = rest.lstrip()
        word = rest[:40].split(",")[0].split("]")[0]
        number, left = read_number(word)
        if left == word:
            return None
        numbers.append(number)
        rest = rest[len(word) - len(left) :]
        if i < count - 1:
            if not rest.startswith(","):
                return None
            rest = rest[1:]
    return tuple(numbers)


def read_answer(buffer: bytes) -> State | None:
    """Read the newest answer in a buffer; None if there is none or a required key is missing."""
    end = buffer.rfind(b"\n")
    begin = buffer.rfind(b"\n", 0, max(end, 0))
    if end <= 0 or begin < 0:
        return None
    text, state = buffer[begin + 1 : end].decode("latin-1"), State()
    for section, key, count, is_required in KEYS:
        index = text.find(section)
        if index >= 0:
            index = text.find(key, index + len(section) + 1)
        if index < 0:
            if is_required:
                return None
            continue
        value = text[index + len(key) + 2 :]
        numbers = (
            (read_number(value[:40].split(",")[0].split("}")[0])[0],)
            if count == 1
            else scan_vector(value, count)
        )
        if numbers is None:
            break
        state[f"{section}.{key}" if section else key] = numbers
    has_position = "position" in state or "latitude" in state
    return state if has_position and ("attitude" in state or "quaternion" in state) else None


@dataclass
class Stub:
    """An autopilot that exchanges packets with the port of a simulation, in a thread."""

    port: int
    law: Law = lambda state: NEUTRAL_WIDTHS
    n_channels: int = 16
    timeout: float = 1.1
    """The silence after which a packet is sent again [s]; 1.1 s as ArduPilot."""
    loss: float = 0.0
    """The probability that a packet is lost, and that an answer is lost [0..1]."""
    restart_at: int = -1
    """The number of answers after which it starts again from count 0; -1: never."""
    max_answers: int = -1
    """The number of answers after which it is silent; -1: never."""
    states: list[State] = field(default_factory=list)
    n_repeats: int = 0
    n_sent: int = 0
    n_frames: int = 0
    max_states: int = 1_000_000

    def __post_init__(self) -> None:
        self._is_stopped = threading.Event()
        self._generator = random.Random(1)
        self._socket = self._new_socket()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def _new_socket(self) -> socket.socket:
        new_socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        new_socket.settimeout(self.timeout)
        return new_socket

    def __enter__(self) -> Stub:
        self._thread.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()

    def stop(self) -> None:
        self._is_stopped.set()
        self._thread.join(timeout=20.0)
        self._socket.close()

    def wait(self, limit: float = 60.0) -> None:
        """Wait until it has read all answers that it waits for."""
        self._thread.join(timeout=limit)
        assert not self._thread.is_alive()

    def _run(self) -> None:
        count, buffer, pwm = 0, b"", self.law({})
        while not self._is_stopped.is_set():
            if self.n_frames == self.max_answers:
                return
            if self.n_frames == self.restart_at:
                self._socket.close()
                self._socket, self.restart_at, count = self._new_socket(), -1, 0
            self._send(count, pwm)
            answer = self._receive(count, pwm)
            if answer is None:
                return
            buffer += answer
            state = read_answer(buffer)
            if state is None:
                continue
            buffer = buffer[buffer.rfind(b"\n") :]
            self.n_frames += 1
            if len(self.states) < self.max_states:
                self.states.append(state)
            pwm, count = self.law(state), count + 1

    def _send(self, count: int, pwm: list[int]) -> None:
        self.n_sent += 1
        if self.loss and self._generator.random() < self.loss:
            return
        channels = [*pwm, *[0] * (self.n_channels - len(pwm))]
        magic = MAGIC_16 if self.n_channels == 16 else MAGIC_32
        packet = struct.pack(f"<HHI{self.n_channels}H", magic, 400, count, *channels)
        self._socket.sendto(packet, ("127.0.0.1", self.port))

    def _receive(self, count: int, pwm: list[int]) -> bytes | None:
        start = time.monotonic()
        while not self._is_stopped.is_set():
            # the simulation may not have opened its port yet
            timeout = self.timeout if self.n_frames else min(self.timeout, 0.3)
            left = timeout - (time.monotonic() - start)
            try:
                self._socket.settimeout(min(max(left, 0.001), 0.1))  # reads in any case
                answer = self._socket.recv(65000)
                if self.loss and self._generator.random() < self.loss:
                    continue
                return answer
            except ConnectionError:
                time.sleep(0.01)
            except TimeoutError:
                if left > 0.1:
                    continue
                self.n_repeats += 1
                self._send(count, pwm)
                start = time.monotonic()
        return None


def free_port() -> int:
    """Return a UDP port that is free now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
