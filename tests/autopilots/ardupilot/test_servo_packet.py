"""Servo packets of 16 and 32 channels, and what is not one."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.autopilots.ardupilot import ServoPacket, read_servo_packet

WORDS = st.integers(0, 65535)


def pack(packet: ServoPacket, magic: int) -> bytes:
    n = len(packet.pwm)
    return struct.pack(f"<HHI{n}H", magic, packet.frame_rate, packet.frame_count, *packet.pwm)


def test_the_layout_is_little_endian_and_packed() -> None:
    data = bytes.fromhex("1a48900105000000") + bytes.fromhex("dc05") * 16
    assert read_servo_packet(data) == ServoPacket(400, 5, (1500,) * 16)


@given(WORDS, st.integers(0, 2**32 - 1), st.lists(WORDS, min_size=32, max_size=32))
def test_every_packet_is_read_back(rate: int, count: int, pwm: list[int]) -> None:
    packet_16 = ServoPacket(rate, count, tuple(pwm[:16]))
    packet_32 = ServoPacket(rate, count, tuple(pwm))
    assert read_servo_packet(pack(packet_16, 18458)) == packet_16
    assert read_servo_packet(pack(packet_32, 29569)) == packet_32


@given(st.binary(max_size=100))
def test_anything_else_is_not_a_packet(data: bytes) -> None:
    is_packet = (len(data), data[:2]) in [(40, b"\x1a\x48"), (72, b"\x81\x73")]
    assert (read_servo_packet(data) is not None) == is_packet


@pytest.mark.parametrize("magic", [29569, 18459, 0])
def test_the_magic_of_another_size_is_wrong(magic: int) -> None:
    assert read_servo_packet(pack(ServoPacket(400, 1, (1500,) * 16), magic)) is None


@pytest.mark.parametrize(
    ("count", "before", "n_frames"),
    [(5, 4, 1), (5, 5, 0), (5, 9, -4), (0, 2**32 - 1, 1), (2**32 - 1, 0, -1)],
)
def test_frames_are_counted_across_the_greatest_number(
    count: int, before: int, n_frames: int
) -> None:
    assert ServoPacket(400, count, ()).frames_since(before) == n_frames
