"""Commands to thrusters: round trips, and streams of damaged bytes."""

from __future__ import annotations

import contextlib
import math
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.autopilots.instruments.commands import (
    ThrusterCommands,
    read_binary_commands,
    read_command_sentence,
)
from uwsim.autopilots.instruments.framing import split_binary, split_lines
from uwsim.autopilots.instruments.satellite import Fix, Position
from uwsim.autopilots.instruments.sentence import MAX_LENGTH, format_number, read_sentence
from uwsim.autopilots.instruments.usbl import BeaconPosition, read_beacon_position
from uwsim.autopilots.instruments.utc import (
    format_time_of_day,
    nearest_time,
    parse_epoch,
    parse_time_of_day,
)
from uwsim.errors import BadMessage

NOW = parse_epoch("2026-01-01T00:00:00Z") + 1_500_000
COMMANDS = st.lists(st.floats(-1.0, 1.0, width=32), min_size=1, max_size=32).map(tuple)
TIMES = st.none() | st.integers(-43_000_000, 43_000_000).map(lambda ms: NOW + 1000 * ms)


@given(COMMANDS, TIMES)
def test_a_sentence_of_commands_is_read_as_written(
    values: tuple[float, ...], time_us: int | None
) -> None:
    commands = ThrusterCommands(values=values, time_us=time_us)
    read = read_command_sentence(commands.to_sentence().to_bytes(), NOW)
    assert read.values == pytest.approx(values, abs=5.1e-5)
    if time_us is not None:
        assert read.time_us is not None
        assert abs(read.time_us - time_us) < 1000
    widths = read_command_sentence(commands.to_pulse_widths().to_bytes(), NOW)
    assert widths.values == pytest.approx(values, abs=0.51 / 400.0)


@given(COMMANDS, TIMES, st.integers(0, 2**32 - 1))
def test_a_binary_command_is_read_as_written(
    values: tuple[float, ...], time_us: int | None, sequence: int
) -> None:
    commands = ThrusterCommands(values=values, time_us=time_us, sequence=sequence)
    assert read_binary_commands(commands.to_binary()) == commands


def test_the_bytes_of_a_binary_command_are_those_of_the_table() -> None:
    data = ThrusterCommands(values=(1.0, -0.5), time_us=2_000_000, sequence=258).to_binary()
    assert data[:-2].hex(" ", -4) == ("55570102 02010000 00000000 00000040 0000803f 000000bf")


@pytest.mark.parametrize(
    "line",
    [
        b"$PUWTC,*00\r\n",
        b"$PUWTC,,0.5,nan*2D\r\n",
        b"$PUWTC,250000.000,0.5*11\r\n",
        b"$GPGGA,123519*00\r\n",
        b"PUWTC,,0.5",
        b"$" + b"1" * 1000,
        b"$PUWTC,,\xff\xfe*00",
        b"",
    ],
)
def test_a_damaged_sentence_is_an_error(line: bytes) -> None:
    with pytest.raises(BadMessage):
        read_command_sentence(line, NOW)


@given(st.binary(max_size=600))
def test_any_bytes_are_read_or_refused(data: bytes) -> None:
    for read in (read_binary_commands, read_beacon_position, Position.from_bytes, read_sentence):
        with contextlib.suppress(BadMessage):
            read(data)


@given(st.lists(COMMANDS, max_size=4), st.binary(max_size=100).map(lambda b: b.replace(b"UW", b"")))
def test_binary_commands_between_other_bytes_are_found(
    values: list[tuple[float, ...]], noise: bytes
) -> None:
    messages = [ThrusterCommands(values=v).to_binary() for v in values]
    frames = split_binary(noise.rstrip(b"U") + b"".join(messages))
    assert list(frames.messages) == messages
    assert frames.rest == b""


@given(st.binary(max_size=2000), st.lists(st.integers(1, 50), max_size=200))
def test_a_stream_in_pieces_has_the_messages_of_the_whole(data: bytes, sizes: list[int]) -> None:
    data += ThrusterCommands(values=(0.5,)).to_binary() + b"\n$PUWTC,,0.5000*35\r\n"
    for split in (split_lines, split_binary):
        messages: list[bytes] = []
        rest, position = b"", 0
        for size in [*sizes, len(data)]:
            frames = split(rest + data[position : position + size])
            messages += frames.messages
            rest, position = frames.rest, position + size
            assert len(rest) <= MAX_LENGTH
        whole = split(data).messages
        assert messages[-1:] == list(whole[-1:])
        assert messages


def test_every_byte_is_counted_once() -> None:
    data = b"noise\n$PUWTC,,0.5*05\r\nmore$PUW"
    frames = split_lines(data)
    assert sum(len(m) + 1 for m in frames.messages) + len(frames.rest) + frames.n_skipped == len(
        data
    )
    damaged = b"xUW\x01\x01" + bytes(15) + ThrusterCommands(values=(0.5,)).to_binary() + b"U"
    binary = split_binary(damaged)
    assert len(binary.messages) == 1
    assert binary.rest == b"U"
    assert binary.n_skipped + len(binary.messages[0]) + 1 == len(damaged)


@pytest.mark.parametrize(
    "flood", [b"$", b"$\n", b"\n", b"U", b"UW", b"UW\x01\x20", b"\x00", b"$PUWTC,,0.5*05\n"]
)
def test_a_flood_is_divided_within_a_step(flood: bytes) -> None:
    data = flood * (4096 // len(flood))
    for split in (split_lines, split_binary):
        start = time.process_time()
        for _ in range(5):
            split(data)
        assert (time.process_time() - start) / 5 < 0.02  # usually below 2 ms


@given(st.floats(-90.0, 90.0), st.floats(-180.0, 180.0))
def test_a_position_is_read_as_written(latitude: float, longitude: float) -> None:
    fix = Fix(time_us=NOW, latitude=latitude, longitude=longitude, altitude=-1.5, speed=1.0)
    gga = Position.from_bytes(fix.gga().to_bytes())
    assert gga.latitude == pytest.approx(latitude, abs=1e-8)
    assert gga.longitude == pytest.approx(longitude, abs=1e-8)
    assert gga.altitude == -1.5
    rmc = Position.from_bytes(fix.rmc().to_bytes())
    assert rmc.is_valid
    assert rmc.speed == pytest.approx(1.0, abs=1e-3)
    beacon = BeaconPosition(time_us=NOW, latitude=latitude, longitude=longitude, depth=3.0)
    assert read_beacon_position(beacon.psonlld().to_bytes()).latitude == pytest.approx(
        latitude, abs=1e-8
    )


def test_a_receiver_without_a_fix_leaves_its_position_empty() -> None:
    fix = Fix(time_us=NOW)
    assert fix.gga().to_bytes() == b"$GPGGA,000001.500,,,,,0,00,0.9,,M,0.0,M,,*75\r\n"
    assert not Position.from_bytes(fix.rmc().to_bytes()).is_valid
    assert fix.zda().fields == ("000001.500", "01", "01", "2026", "00", "00")


@pytest.mark.parametrize(
    ("value", "text"), [(-0.0001, "0.00"), (math.nan, ""), (math.inf, ""), (2.005, "2.00")]
)
def test_numbers_have_no_negative_zero_and_no_nan(value: float, text: str) -> None:
    assert format_number(value, 2) == text


def test_the_time_of_day_of_a_command_is_near_the_present_time() -> None:
    midnight = NOW - 1_500_000
    assert nearest_time(parse_time_of_day("235959.500", "x"), NOW) == midnight - 500_000
    assert nearest_time(1_000_000, midnight - 1) == midnight + 1_000_000
    assert format_time_of_day(midnight - 1) == "235959.999"
