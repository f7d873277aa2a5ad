"""The connection to a ROS 1 master, which is started if none answers."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass

from ...bus import Bus
from ...errors import BadSetting
from ..log import Log
from .address import read_address
from .bridge import NODE_NAME, Ros1Bridge
from .master import Master
from .tcpros import PeerError
from .xmlrpc import call

DEFAULT_MASTER = "http://127.0.0.1:11311"
"""The URI of the master if neither the options nor ``ROS_MASTER_URI`` give one."""
LOOPBACK = ("127.0.0.1", "localhost", "::1")
"""The names and addresses of this computer on the loopback interface."""


@dataclass(frozen=True, kw_only=True)
class Ros1Options:
    """The options with which a simulation joins ROS 1."""

    master: str | None = None
    """The URI of the master; None: ``ROS_MASTER_URI``, else port 11311 of this computer."""
    host: str = "127.0.0.1"
    """The address at which the node listens, which the master gives to other nodes."""
    node: str = NODE_NAME
    """The name of the node."""


@dataclass(frozen=True)
class Ros1Connection:
    """A bridge, and the master that was started for it."""

    bridge: Ros1Bridge
    """The bridge, which is the node."""
    master: Master | None
    """The master that was started; None if another master was running."""

    def close(self) -> None:
        """Leave the graph, and end the master that was started."""
        self.bridge.close()
        if self.master is not None:
            self.master.close()


def connect(
    bus: Bus, clock: Callable[[], float], options: Ros1Options, log: Log | None = None
) -> Ros1Connection:
    """Join the graph of a master; start a master if none answers at an address of this computer.

    These addresses are those in `LOOPBACK`, and that at which the node listens.

    Args:
        bus: the bus of the simulation.
        clock: a function that returns the simulation time [s].
        options: the addresses of master and node.
        log: the log for events.

    Raises:
        BadSetting: the master's URI is invalid; the master is on another computer and does not
            answer; no master can be started; or the node cannot listen at its address.
    """
    log = log or Log("ros1")
    uri = options.master or os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER
    address = read_address(uri)
    if address is None or address.scheme != "http":
        raise BadSetting(f"ROS_MASTER_URI {uri!r}: expected http://HOST:PORT, as {DEFAULT_MASTER}.")
    _, name, port = address
    master = None
    try:
        call(uri, "getUri", options.node)
    except PeerError as error:
        if name not in (*LOOPBACK, options.host):
            raise BadSetting(f"The ROS master does not answer: {error}.") from None
        master = _start_master(log, "127.0.0.1" if name in LOOPBACK else name, port, error)
        uri = master.uri
    if name not in LOOPBACK and options.host in LOOPBACK:
        log.report(
            f"the master is on {name}, but this node listens on {options.host} only: "
            "--ros1-host ADDRESS gives other computers access"
        )
    try:
        bridge = Ros1Bridge(bus, clock, master=uri, host=options.host, node=options.node, log=log)
    except BadSetting:
        if master is not None:
            master.close()
        raise
    return Ros1Connection(bridge, master)


def _start_master(log: Log, host: str, port: int, failure: PeerError) -> Master:
    try:
        master = Master(log, host=host, port=port)
    except OSError as error:
        raise BadSetting(
            f"{failure}, and no master can be started at port {port}: {error.strerror or error}."
        ) from None
    log.report(f"no master answers; one was started at {master.uri}")
    return master
