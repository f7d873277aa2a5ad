"""Errors about ports and terminals of one computer that two elements of a scene open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...devices.ardupilot import ArduPilotSpec
from ...devices.fdm import FdmSpec
from ...devices.mavlink import MavlinkSpec
from ...devices.motion.follow_pose import FollowPoseSpec
from ...devices.px4 import Px4Spec
from ...devices.streams.actuator_stream import ActuatorStreamSpec
from ...devices.streams.instrument_stream import InstrumentStreamSpec
from ...errors import Diagnostic, UwsimError
from ...scene.spec import SceneSpec
from ...schema import format_tag, line_of
from ...world.addresses import parse_address
from ..subjects import CheckedScene

LOCAL_HOST = "127.0.0.1"
"""The address at which ports without an address of their own are opened by default."""
ANY_HOSTS = ("0.0.0.0", "::", "*")
"""The addresses that include all others of a computer."""
OPENED_KINDS = {"udpin": "UDP", "tcpin": "TCP"}
"""The protocol of each kind of address whose port this computer opens."""


@dataclass(frozen=True)
class LocalPort:
    """A port or a terminal that an element opens."""

    protocol: str
    """The protocol: ``UDP``, ``TCP`` or ``pty``."""
    host: str
    """The address of this computer, or the path of the link to the terminal."""
    port: int
    """The port; 0 for a terminal."""
    owner: str
    """The element and its vehicle."""
    line: int | None
    """The line of the element."""

    @property
    def place(self) -> str:
        """The port or the terminal, for messages."""
        return f"the terminal {self.host}" if not self.port else f"{self.protocol} port {self.port}"

    def collides_with(self, other: LocalPort) -> bool:
        """Return whether only one of two ports is possible."""
        if (self.protocol, self.port) != (other.protocol, other.port):
            return False
        return self.host == other.host or any(x.host in ANY_HOSTS for x in (self, other))


def shared_ports(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report ports that two elements of a scene open, with the lines of both."""
    for port, other in find_shared_ports(scene.spec):
        line = "" if other.line is None else f" (line {other.line})"
        message = (
            f"{port.owner}: {port.place} is that of {other.owner}{line}, too; expected a "
            "port of its own"
        )
        yield scene.error(port.line, message)


def find_shared_ports(scene: SceneSpec) -> Iterator[tuple[LocalPort, LocalPort]]:
    """Yield each port that an earlier element of the scene opens as well, with that element's."""
    ports: dict[tuple[str, int], list[LocalPort]] = {}
    for port in sorted(_find_ports(scene), key=lambda entry: entry.line or 0):
        earlier_ports = ports.setdefault((port.protocol, port.port), [])
        other = next((entry for entry in earlier_ports if entry.collides_with(port)), None)
        if other is not None:
            yield port, other
        else:
            earlier_ports.append(port)


def _find_ports(scene: SceneSpec) -> Iterator[LocalPort]:
    """Yield the ports and terminals of a scene, in the order of its parts."""
    for vehicle in scene.vehicles:
        for element, part in vehicle.all_parts():
            owner = f"{format_tag(element)} of {vehicle.name!r}"
            line = line_of(vehicle, "fdm") if isinstance(part, FdmSpec) else line_of(part)
            if isinstance(part, FdmSpec):
                yield LocalPort("UDP", LOCAL_HOST, part.port, owner, line)
            elif isinstance(part, FollowPoseSpec) and part.mavlink_port is not None:
                yield LocalPort("UDP", LOCAL_HOST, part.mavlink_port, owner, line)
            elif isinstance(part, ArduPilotSpec):
                yield LocalPort("UDP", LOCAL_HOST, part.udp_port, owner, line)
            elif isinstance(part, Px4Spec):
                yield LocalPort("TCP", _numeric_host(part.host), part.port, owner, line)
            elif isinstance(part, MavlinkSpec | ActuatorStreamSpec | InstrumentStreamSpec):
                yield from _find_address(part.address, owner, line)


def _find_address(address: str, owner: str, line: int | None) -> Iterator[LocalPort]:
    """Yield the port or terminal that an address opens; none if it is invalid or of a peer."""
    try:
        kind, host, port = parse_address(address)
    except UwsimError:  # reported where streams are checked
        return
    if kind in OPENED_KINDS:
        yield LocalPort(OPENED_KINDS[kind], _numeric_host(host), port, owner, line)
    elif kind == "pty" and host:
        yield LocalPort("pty", host, 0, owner, line)


def _numeric_host(host: str) -> str:
    return LOCAL_HOST if host == "localhost" else host
