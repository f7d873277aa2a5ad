"""Options that connect a running simulation to the world outside, and what they start."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import AllErrors, BadSetting, MissingExtra
from .help_texts import CONNECTED, in_group

if TYPE_CHECKING:
    from ...middleware.bridge import Bridge
    from ...simulation import Simulation


@dataclass(frozen=True, kw_only=True)
class ConnectionOptions:
    """To what a simulation is connected, and how fast it runs then."""

    ros1: Annotated[
        bool,
        in_group(
            CONNECTED,
            "--ros1",
            help="Be a node of ROS 1: topics, services, /clock and /tf, at the master of "
            "ROS_MASTER_URI; a master is started where none runs. ROS need not be installed.",
        ),
    ] = False
    ros1_host: Annotated[
        str | None,
        in_group(
            CONNECTED,
            "--ros1-host",
            metavar="ADDRESS",
            help="Address of this computer at which ROS 1 nodes on others reach it [127.0.0.1: "
            "nodes on this computer only].",
        ),
    ] = None
    ros2: Annotated[
        bool,
        in_group(
            CONNECTED,
            "--ros2",
            help="Be a node of ROS 2: topics, services, /clock. On this computer only, unless "
            "ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET.",
        ),
    ] = False
    domain: Annotated[
        int | None,
        in_group(
            CONNECTED,
            "--domain",
            metavar="N",
            help="ROS 2 domain, 0 to 232 [ROS_DOMAIN_ID, or 0].",
        ),
    ] = None
    speed: Annotated[
        float | None,
        in_group(
            CONNECTED,
            "--speed",
            metavar="X",
            help="Simulation time per real time; 0 is as fast as it can [1 with a connection, "
            "else 0].",
        ),
    ] = None

    @property
    def is_connected(self) -> bool:
        """Whether there is any connection."""
        return self.ros1 or self.ros2

    @property
    def pace(self) -> float:
        """Simulation time per real time; 0 is as fast as it can."""
        return float(self.is_connected) if self.speed is None else self.speed

    def check(self, wrong: AllErrors) -> None:
        """Collect the errors of the options."""
        with wrong.kept():
            if self.domain is not None and not self.ros2:
                raise BadSetting("--domain is of --ros2.")
        with wrong.kept():
            if self.ros1_host is not None and not self.ros1:
                raise BadSetting("--ros1-host is of --ros1.")
        with wrong.kept():
            if not 0 <= self.pace < float("inf"):
                raise BadSetting(f"--speed {self.pace:g}: expected 0 or more.")
        with wrong.kept():
            if self.ros2:
                self._check_ros2()

    def _check_ros2(self) -> None:
        if importlib.util.find_spec("cyclonedds") is None:
            raise MissingExtra(
                "--ros2: Cyclone DDS is not installed. Install it with: pip install uwsim[ros2]"
            )
        from ...middleware.ros2.settings import settings_from

        settings_from(os.environ, self.domain)


@contextmanager
def connected(simulation: Simulation, options: ConnectionOptions) -> Iterator[None]:
    """Connect a simulation, and pace it, within the block; a program outside may end the block."""
    from ...simulation.control import Quit

    with ExitStack() as stack:
        if bridges := list(_bridges(simulation, options, stack)):
            _connect(simulation, bridges)
        if options.pace > 0:
            from ...middleware.pacing import Pace

            simulation.watch(Pace(lambda: simulation.time, options.pace).step)
        with suppress(Quit):
            yield


def _connect(simulation: Simulation, bridges: Sequence[Bridge]) -> None:
    """Let transports exchange messages, and control the simulation, at the end of each step."""
    from ...simulation.control import SimulationControl

    def exchange() -> None:
        for bridge in bridges:
            bridge.step()

    control = SimulationControl(simulation, exchange)
    exchange()
    control.begin()
    simulation.watch(exchange)
    simulation.watch(control.hold)


def _bridges(
    simulation: Simulation, options: ConnectionOptions, stack: ExitStack
) -> Iterator[Bridge]:
    """Open what the options ask for; ``stack`` closes it."""
    if options.ros1:
        from ...middleware.ros1 import Ros1Options, connect

        ros1_options = Ros1Options(host=options.ros1_host or "127.0.0.1")
        connection = connect(simulation.bus, lambda: simulation.time, ros1_options)
        stack.callback(connection.close)
        yield connection.bridge
    if options.ros2:
        from ...middleware.ros2.adapter import Ros2
        from ...middleware.ros2.settings import settings_from

        ros2 = Ros2(
            simulation.bus,
            lambda: simulation.time,
            settings_from(os.environ, options.domain),
            more=os.environ.get("CYCLONEDDS_URI", ""),
        )
        stack.callback(ros2.close)
        yield ros2
