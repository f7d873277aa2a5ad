"""The connections of a simulation to external programs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from ..bus import Bus
from .bridge import Bridge
from .web.options import WebOptions


@dataclass(frozen=True, kw_only=True)
class ConnectionSpec:
    """The choice of the transports of a simulation; `open` connects them to a bus."""

    ros1: bool = False
    """True if the simulation is a node of ROS 1."""
    ros1_host: str = "127.0.0.1"
    """The address at which the node listens."""
    ros2: bool = False
    """True if the simulation is a node of ROS 2."""
    domain: int | None = None
    """The domain of ROS 2; None: the value of ``ROS_DOMAIN_ID``."""
    web: WebOptions | None = None
    """The options of the server for web clients; None: there is no server."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the transports: ros1, ros2, web."""
        is_used_by_name = {"ros1": self.ros1, "ros2": self.ros2, "web": self.web is not None}
        return tuple(name for name, is_used in is_used_by_name.items() if is_used)

    @contextmanager
    def open(self, bus: Bus, clock: Callable[[], float]) -> Iterator[tuple[Bridge, ...]]:
        """Open all connections within the block; yield the bridge of each.

        Args:
            bus: the bus of the simulation.
            clock: a function that returns the simulation time [s].

        Raises:
            BadSetting: a connection cannot be opened.
        """
        with ExitStack() as stack:
            yield tuple(self._bridges(bus, clock, stack))

    def _bridges(self, bus: Bus, clock: Callable[[], float], stack: ExitStack) -> Iterator[Bridge]:
        if self.ros1:
            from .ros1 import Ros1Options, connect

            connection = connect(bus, clock, Ros1Options(host=self.ros1_host))
            stack.callback(connection.close)
            yield connection.bridge
        if self.ros2:
            from .log import Log
            from .ros2.adapter import Ros2
            from .ros2.choice import open_node

            log = Log("ros2")
            ros2 = Ros2(bus, clock, open_node(os.environ, self.domain, log), log)
            stack.callback(ros2.close)
            yield ros2
        if self.web is not None:
            from .web.server import WebBridge

            web = WebBridge(bus, clock, self.web)
            stack.callback(web.close)
            yield web
