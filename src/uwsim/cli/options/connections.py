"""Options that connect a running simulation to the world outside, and what they start."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
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
        return self.ros2

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
    """Connect a simulation, and pace it, within the block."""
    bridges: list[Bridge] = []
    try:
        if options.ros2:
            from ...middleware.ros2.adapter import Ros2
            from ...middleware.ros2.settings import settings_from

            bridges.append(
                Ros2(
                    simulation.bus,
                    lambda: simulation.time,
                    settings_from(os.environ, options.domain),
                    more=os.environ.get("CYCLONEDDS_URI", ""),
                )
            )
        for bridge in bridges:
            bridge.step()
            simulation.watch(bridge.step)
        if options.pace > 0:
            from ...middleware.pacing import Pace

            simulation.watch(Pace(lambda: simulation.time, options.pace).step)
        yield
    finally:
        for bridge in bridges:
            bridge.close()
