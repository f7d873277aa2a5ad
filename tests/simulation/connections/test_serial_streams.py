"""Serial lines and pseudo-terminals: bytes in both directions, without hardware."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from uwsim.errors import MissingExtra, UwsimError
from uwsim.simulation.connections import OpenConnections
from uwsim.simulation.connections.serial_streams import PseudoTerminal
from uwsim.world import TerminalStream
from uwsim.world.addresses import parse_address


def test_a_terminal_carries_all_bytes_unchanged_in_both_directions(tmp_path: Path) -> None:
    connections = OpenConnections()
    stream = connections.open(f"pty:{tmp_path / 'dvl'}")
    other = os.open(tmp_path / "dvl", os.O_RDWR | os.O_NOCTTY)
    data = bytes(range(256))
    assert stream.send(data)
    assert os.read(other, 1000) == data
    os.write(other, data[::-1])
    assert stream.receive(1.0) == data[::-1]
    assert stream.receive() == b""
    os.close(other)
    connections.close()
    assert not os.path.lexists(tmp_path / "dvl")


def test_a_terminal_that_nobody_reads_refuses_bytes_and_does_not_block() -> None:
    terminal = PseudoTerminal()
    is_sent = [terminal.send(bytes(1000)) for _ in range(100)]
    terminal.close()
    assert is_sent[0]
    assert not is_sent[-1]


def test_a_link_does_not_replace_a_file(tmp_path: Path) -> None:
    (tmp_path / "kept").write_text("text")
    with pytest.raises(UwsimError, match="cannot be opened: File exists"):
        OpenConnections().open(f"pty:{tmp_path / 'kept'}")
    assert (tmp_path / "kept").read_text() == "text"


def test_a_serial_line_is_opened_with_pyserial() -> None:
    pytest.importorskip("serial", reason="needs pyserial")
    connections = OpenConnections()
    terminal = connections.open("pty")
    assert isinstance(terminal, TerminalStream)
    line = connections.open(f"serial:{terminal.path}:115200")
    assert terminal.send(b"$GPZDA\r\n")
    assert line.receive(1.0) == b"$GPZDA\r\n"
    assert line.send(b"answer")
    assert terminal.receive(1.0) == b"answer"
    connections.close()
    assert not line.send(b"x")


def test_without_pyserial_the_error_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "serial", None)
    with pytest.raises(MissingExtra, match=r"pip install 'uwsim\[serial\]'"):
        OpenConnections().open("serial:/dev/ttyUSB0:115200")


def test_a_line_that_does_not_exist_is_an_error_of_one_line() -> None:
    pytest.importorskip("serial", reason="needs pyserial")
    with pytest.raises(UwsimError, match="serial:/dev/no_such_line:9600 cannot be opened"):
        OpenConnections().open("serial:/dev/no_such_line:9600")


@pytest.mark.parametrize(
    ("address", "parts"),
    [
        ("serial:/dev/ttyUSB0:115200", ("serial", "/dev/ttyUSB0", 115200)),
        ("pty", ("pty", "", 0)),
        ("pty:/tmp/dvl", ("pty", "/tmp/dvl", 0)),
        ("udpout:[::1]:9110", ("udpout", "::1", 9110)),
    ],
)
def test_addresses_have_three_parts(address: str, parts: tuple[str, str, int]) -> None:
    assert parse_address(address) == parts


@pytest.mark.parametrize(
    ("address", "problem"),
    [
        ("serial:/dev/ttyUSB0", "expected serial:PATH:BIT_RATE"),
        ("serial:/dev/ttyUSB0:0", "expected serial:PATH:BIT_RATE"),
        ("seral:/dev/ttyUSB0:9600", "Did you mean 'serial'"),
        ("udpin:localhost:65536", "expected udpin:HOST:PORT"),
    ],
)
def test_an_error_states_the_form_of_an_address(address: str, problem: str) -> None:
    with pytest.raises(UwsimError, match=problem):
        parse_address(address)
