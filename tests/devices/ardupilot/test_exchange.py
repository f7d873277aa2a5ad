"""The rules for the numbers of frames, apart from sockets."""

from __future__ import annotations

import struct
from collections.abc import Sequence

import pytest

from uwsim.autopilots.ardupilot.servo_packet import MAGIC_16
from uwsim.devices.ardupilot.exchange import Exchange
from uwsim.errors import ClientLost
from uwsim.world import Address

SENDER = ("127.0.0.1", 40000)


class ListedPort:
    """A port that receives the frames of a list, without waiting."""

    address = ("127.0.0.1", 9002)
    n_dropped = 0

    def __init__(self, frames: Sequence[int]) -> None:
        self.frames = list(frames)
        self.sent: list[bytes] = []
        self.peer: Address | None = None

    def set_peer(self, peer: Address | None) -> None:
        self.peer = peer

    def receive(self, timeout: float = 0.0) -> tuple[bytes, Address] | None:
        if not self.frames or timeout == 0.0:
            return None
        return struct.pack("<HHI16H", MAGIC_16, 400, self.frames.pop(0), *[1500] * 16), SENDER

    def receive_others(self, limit: int) -> Sequence[tuple[bytes, Address]]:
        return ()

    def send(self, data: bytes) -> bool:
        self.sent.append(data)
        return True


def exchange_all(frames: Sequence[int], *, is_ended: bool = False) -> Exchange:
    """Return the exchange after one answer to each new frame."""
    port = ListedPort(frames)
    exchange = Exchange(port, timeout=0.1, on_restart="end" if is_ended else "continue", hint="")
    while port.frames:
        exchange.wait_for_packet(0.0)
        exchange.send_answer(b"answer")
    return exchange


@pytest.mark.parametrize("late_frame", [399, 398, 100])
def test_an_old_packet_that_the_network_delayed_is_no_new_start(late_frame: int) -> None:
    state = exchange_all([*range(401), late_frame, 401, 402]).state
    assert (state.n_restarts, state.n_duplicates, state.frame_count) == (0, 1, 402)
    assert state.n_exchanges == 403


@pytest.mark.parametrize("frames", [[0, 1], [1, 2], [20, 20, 21]])
def test_a_number_near_0_or_a_lower_one_twice_is_a_new_start(frames: list[int]) -> None:
    state = exchange_all([*range(401), *frames]).state
    assert (state.n_restarts, state.frame_count) == (1, frames[-1])
    with pytest.raises(ClientLost, match="was started again"):
        exchange_all([*range(401), *frames], is_ended=True)


def test_numbers_of_frames_begin_again_after_2_to_the_32() -> None:
    last_frame = 2**32 - 1
    state = exchange_all([last_frame - 1, last_frame, 0, 1, last_frame, 2]).state
    assert (state.n_restarts, state.n_lost, state.n_duplicates) == (0, 0, 1)
