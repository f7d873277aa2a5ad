"""Bytes of MAVLink messages: against pymavlink's own parser, and from hostile streams."""

from __future__ import annotations

import math

import pymavlink.dialects.v20.ardupilotmega as dialect
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.autopilots.mavlink import Codec, Identity, Message, MessageReader
from uwsim.autopilots.mavlink.commands import heartbeat
from uwsim.autopilots.mavlink.stream import MAX_BUFFER, MAX_FRAMES_PER_CALL
from uwsim.errors import UwsimError

CODEC = Codec()
VEHICLE = Identity(1, 1)
HEARTBEAT = CODEC.encode(heartbeat(type=18), VEHICLE, 7)
NUMBERS = {
    "uint8_t": st.integers(0, 2**8 - 1),
    "uint16_t": st.integers(0, 2**16 - 1),
    "uint32_t": st.integers(0, 2**32 - 1),
    "uint64_t": st.integers(0, 2**64 - 1),
    "int8_t": st.integers(-(2**7), 2**7 - 1),
    "int16_t": st.integers(-(2**15), 2**15 - 1),
    "int32_t": st.integers(-(2**31), 2**31 - 1),
    "int64_t": st.integers(-(2**63), 2**63 - 1),
    "float": st.floats(width=32, allow_nan=False),
    "double": st.floats(allow_nan=False),
}
TYPES = [
    kind
    for kind in dialect.mavlink_map.values()
    if set(kind.fieldtypes) <= set(NUMBERS)  # texts are tested apart
]


@st.composite
def messages(draw: st.DrawFn) -> Message:
    kind = draw(st.sampled_from(TYPES))
    fields = {}
    for name, type in zip(kind.fieldnames, kind.fieldtypes, strict=True):
        length = kind.array_lengths[kind.ordered_fieldnames.index(name)]
        number = NUMBERS[type]
        fields[name] = draw(number if length == 0 else st.tuples(*[number] * length))
    return Message(kind.msgname, fields)


def parse_with_pymavlink(data: bytes) -> list[dict[str, object]]:
    parser = dialect.MAVLink(None)
    return [message.to_dict() for message in parser.parse_buffer(data) or []]


@given(message=messages(), sequence=st.integers(0, 1000))
@settings(max_examples=150, deadline=None)
def test_every_message_survives_and_is_what_pymavlink_reads(
    message: Message, sequence: int
) -> None:
    frame = CODEC.encode(message, Identity(3, 197), sequence)
    (read,) = MessageReader(CODEC).read(frame)
    assert (read.name, read.system, read.component) == (message.name, 3, 197)
    for name, value in message.fields.items():
        assert read.fields[name] == (list(value) if isinstance(value, tuple) else value)
    (parsed,) = parse_with_pymavlink(frame)
    assert parsed.pop("mavpackettype") == message.name
    assert parsed == read.fields


@given(text=st.text(st.characters(codec="ascii"), max_size=50))
@settings(max_examples=50, deadline=None)
def test_a_text_of_ascii_letters_survives(text: str) -> None:
    text = text.rstrip("\0").replace("\0", "")
    frame = CODEC.encode(Message("STATUSTEXT", {"severity": 4, "text": text}), VEHICLE, 0)
    (read,) = MessageReader(CODEC).read(frame)
    assert read.fields["text"] == text


@given(noise=st.binary(max_size=400), cut=st.integers(1, 20))
@settings(max_examples=150, deadline=None)
def test_messages_among_noise_are_found_and_noise_is_counted(noise: bytes, cut: int) -> None:
    noise = noise.replace(b"\xfd", b"").replace(b"\xfe", b"")
    data = HEARTBEAT + noise + HEARTBEAT
    reader = MessageReader(CODEC)
    read = [message for k in range(0, len(data), cut) for message in reader.read(data[k : k + cut])]
    assert [message.name for message in read] == ["HEARTBEAT", "HEARTBEAT"]
    assert reader.state.n_invalid_bytes == len(noise)
    assert reader.state.buffer == b""


@given(data=st.lists(st.binary(max_size=3000), max_size=8))
@settings(max_examples=150, deadline=None)
def test_no_bytes_end_the_reader_and_none_are_lost_from_the_count(data: list[bytes]) -> None:
    reader = MessageReader(CODEC)
    for piece in data:
        reader.read(piece)
    valid_bytes = sum(map(len, data)) - reader.state.n_invalid_bytes - len(reader.state.buffer)
    assert 0 <= valid_bytes <= 280 * reader.state.n_messages


@given(position=st.integers(1, len(HEARTBEAT) - 1), flip=st.integers(1, 255))
@settings(max_examples=60, deadline=None)
def test_an_altered_message_is_never_read(position: int, flip: int) -> None:
    altered = bytearray(HEARTBEAT)
    altered[position] ^= flip
    reader = MessageReader(CODEC)
    assert reader.read(bytes(altered)) == []
    names = [message.name for message in reader.read(b"\0" * 300 + HEARTBEAT)]
    assert names == ["HEARTBEAT"]  # what follows is read again


@pytest.mark.parametrize("byte", [0xFE, 0xFD, 0x00])
def test_a_flood_costs_little_and_its_oldest_bytes_are_discarded(byte: int) -> None:
    decoded = 0

    class CountingCodec(Codec):
        def decode(self, frame: bytes | bytearray) -> Message | None:
            nonlocal decoded
            decoded += 1
            return super().decode(frame)

    reader = MessageReader(CountingCodec())
    for _ in range(10):
        decoded = 0
        reader.read(bytes([byte]) * 60000)
        assert decoded <= MAX_FRAMES_PER_CALL
    assert len(reader.state.buffer) <= MAX_BUFFER
    assert reader.state.n_messages == 0
    assert reader.state.n_invalid_bytes + len(reader.state.buffer) == 600000


def test_a_value_that_does_not_fit_is_an_error() -> None:
    for message, expected in [
        (Message("HEARTBEAT", {"type": 256}), "does not fit"),
        (Message("ODOMETRY", {"q": (1.0, 0.0)}), "expected 4"),
        (Message("HEARTBEET"), "no message 'HEARTBEET'"),
        (Message("HEARTBEAT", {"speed": 1}), "no field 'speed'"),
    ]:
        with pytest.raises(UwsimError, match=expected):
            CODEC.encode(message, VEHICLE, 0)


def test_numbers_of_a_hostile_message_are_finite() -> None:
    message = Message("LOCAL_POSITION_NED", {"x": math.nan, "y": math.inf, "z": 2.0})
    assert [message.number(name) for name in "xyzw"] == [0.0, 0.0, 2.0, 0.0]
