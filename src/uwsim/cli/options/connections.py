"""Options that connect a running simulation to the world outside, and what they start."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting, ErrorCollector, RunFailed
from ...middleware.pacing import MIN_SPEED
from .help_texts import CONNECTED, in_group
from .secrets import client_secret
from .web_options import (
    CLIENT_LIMIT,
    ClientLimitOption,
    ClientOption,
    ClientSecretFileOption,
    WebGiven,
    WebHostOption,
    WebOption,
    WebOriginOption,
    WebTokenFileOption,
    WebTokenOption,
    check_clients,
)

if TYPE_CHECKING:
    from ...middleware.bridge import Bridge
    from ...middleware.connection import ConnectionSpec
    from ...middleware.web.options import WebOptions
    from ...simulation import Simulation


Ros1Option = Annotated[
    bool,
    in_group(
        CONNECTED,
        "--ros1",
        help="Be a node of ROS 1: topics, services, /clock and /tf, at the master of "
        "ROS_MASTER_URI; a master is started where none runs. ROS need not be installed.",
    ),
]

Ros1HostOption = Annotated[
    str | None,
    in_group(
        CONNECTED,
        "--ros1-host",
        metavar="ADDRESS",
        help="Address of this computer at which ROS 1 nodes on others reach it [127.0.0.1: "
        "nodes on this computer only].",
    ),
]

Ros2Option = Annotated[
    bool,
    in_group(
        CONNECTED,
        "--ros2",
        help="Be a node of ROS 2: topics, services, /clock. By rclpy where it can be imported, "
        "else by DDS (UWSIM_ROS2=rclpy|dds chooses). On this computer only, unless "
        "ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET.",
    ),
]

DomainOption = Annotated[
    int | None,
    in_group(
        CONNECTED,
        "--domain",
        metavar="N",
        help="ROS 2 domain, 0 to 232 [ROS_DOMAIN_ID, or 0].",
    ),
]


@dataclass(frozen=True, kw_only=True)
class ConnectionOptions:
    """To what a simulation is connected, and how fast it runs then."""

    ros1: Ros1Option = False
    ros1_host: Ros1HostOption = None
    ros2: Ros2Option = False
    domain: DomainOption = None
    speed: Annotated[
        float | None,
        in_group(
            CONNECTED,
            "--speed",
            metavar="X",
            help="Simulation time per real time; 0 is as fast as it can [1 with a connection "
            "and no --client, else 0].",
        ),
    ] = None
    max_lag: Annotated[
        float | None,
        in_group(
            CONNECTED,
            "--max-lag",
            metavar="SECONDS",
            help="A strict clock, for hardware in the loop: the run ends when the simulation is "
            "later than this [a late simulation loses time].",
        ),
    ] = None

    web: WebOption = None
    web_host: WebHostOption = None
    web_token: WebTokenOption = None
    web_token_file: WebTokenFileOption = None
    web_origin: WebOriginOption = None
    client: ClientOption = None
    client_limit: ClientLimitOption = CLIENT_LIMIT
    client_secret_file: ClientSecretFileOption = None

    @property
    def is_connected(self) -> bool:
        """Whether there is any connection."""
        return bool(self.transports)

    @property
    def transports(self) -> tuple[str, ...]:
        """Names of those that are asked for."""
        are = {"ros1": self.ros1, "ros2": self.ros2, "web": self.web is not None}
        return tuple(name for name, is_used in are.items() if is_used)

    @property
    def pace(self) -> float:
        """Simulation time per real time; 0 is as fast as it can."""
        is_free = self.is_connected and not self.client
        return float(is_free) if self.speed is None else self.speed

    def check(self, wrong: ErrorCollector) -> None:
        """Collect the errors of the options."""
        with wrong.collect():
            if self.domain is not None and not self.ros2:
                raise BadSetting("--domain is of --ros2.")
        with wrong.collect():
            if self.ros1_host is not None and not self.ros1:
                raise BadSetting("--ros1-host is of --ros1.")
        with wrong.collect():
            if not (self.pace == 0 or MIN_SPEED <= self.pace < float("inf")):
                raise BadSetting(f"--speed {self.pace:g}: expected 0, or {MIN_SPEED:g} or more.")
        with wrong.collect():
            if self.max_lag is not None and not 0.0 < self.max_lag < float("inf"):
                raise BadSetting(f"--max-lag {self.max_lag:g}: expected a time > 0 [s].")
            if self.max_lag is not None and self.pace == 0:
                raise BadSetting("--max-lag is of a run in real time; give its --speed.")
        with wrong.collect():
            if self.ros2:
                from ...middleware.ros2.choice import check

                check(os.environ, self.domain)
        with wrong.collect():
            if (web := self.web_options()) is not None:
                web.check_free()
        with wrong.collect():
            check_clients(self.client or (), self.client_limit, self.transports)
        with wrong.collect():
            if self.client_secret_file is not None and not self.client:
                raise BadSetting("--client-secret-file is of --client.")
            client_secret(self.client_secret_file)

    def spec(self) -> ConnectionSpec:
        """Return what is opened; raises BadSetting."""
        from ...middleware.connection import ConnectionSpec

        return ConnectionSpec(
            ros1=self.ros1,
            ros1_host=self.ros1_host or "127.0.0.1",
            ros2=self.ros2,
            domain=self.domain,
            web=self.web_options(),
        )

    def web_options(self) -> WebOptions | None:
        """Return where web clients are served; raises BadSetting."""
        return WebGiven(
            port=self.web,
            host=self.web_host,
            token=self.web_token,
            token_file=self.web_token_file,
            origins=self.web_origin,
        ).options()


@contextmanager
def connected(simulation: Simulation, options: ConnectionOptions) -> Iterator[None]:
    """Connect a simulation, and pace it, within the block; a program outside may end the block.

    Clients in lock-step are waited for until they have joined.
    """
    from ...simulation.control import Quit

    with options.spec().open(simulation.bus, lambda: simulation.time) as bridges:
        if options.client:
            _attach(simulation, bridges, options)
        if bridges:
            _connect(simulation, bridges)
        if options.pace > 0:
            from ...middleware.pacing import Pace

            pace = Pace(lambda: simulation.time, options.pace, max_lag=options.max_lag)
            simulation.watch(pace.step)
        with suppress(Quit):
            yield


def _attach(simulation: Simulation, bridges: Sequence[Bridge], options: ConnectionOptions) -> None:
    """Attach the clients in lock-step."""
    from ...middleware.lockstep.client import lockstep_clients

    for client in lockstep_clients(
        bridges,
        options.client or (),
        timestep=simulation.timestep,
        limit=options.client_limit,
        secret=client_secret(options.client_secret_file),
    ):
        node = simulation.attach(client, name=client.name, raises=False)
        if node.error is not None:
            raise RunFailed(f"{client.name} {node.failure_verb}: {node.error}")


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
