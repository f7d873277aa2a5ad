"""The options that connect a running simulation to external programs."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting, ErrorCollector, RunFailed
from ...middleware.pacing import MIN_REAL_TIME_FACTOR
from .help_texts import CLOCK, ROS, option
from .secrets import read_client_secret
from .web_options import (
    CLIENT_LIMIT,
    ClientLimitOption,
    ClientOption,
    ClientSecretFileOption,
    WebHostOption,
    WebOption,
    WebOptionValues,
    WebOriginOption,
    WebTokenFileOption,
    WebTokenOption,
    check_clients,
)

if TYPE_CHECKING:
    from ...middleware.bridge import Bridge
    from ...middleware.connection import ConnectionSpec
    from ...middleware.strict import StrictClock
    from ...middleware.web.options import WebOptions
    from ...simulation import Simulation


Ros1Option = Annotated[
    bool,
    option(
        ROS,
        "--ros1",
        help="Run as a node of ROS 1: topics, services, /clock and /tf, at the master of "
        "ROS_MASTER_URI; a master is started if none runs. ROS need not be installed.",
    ),
]

Ros1HostOption = Annotated[
    str | None,
    option(
        ROS,
        "--ros1-host",
        metavar="ADDRESS",
        help="Address of this computer for ROS 1 nodes on other computers [127.0.0.1: nodes on "
        "this computer only].",
    ),
]

Ros2Option = Annotated[
    bool,
    option(
        ROS,
        "--ros2",
        help="Run as a node of ROS 2: topics, services, /clock. With rclpy if it can be imported, "
        "else with DDS (UWSIM_ROS2=rclpy|dds selects one). On this computer only, unless "
        "ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET.",
    ),
]

DomainOption = Annotated[
    int | None,
    option(ROS, "--domain", metavar="N", help="ROS 2 domain, 0 to 232 [ROS_DOMAIN_ID, or 0]."),
]


@dataclass(frozen=True, kw_only=True)
class ConnectionOptions:
    """The options of connections to external programs, and of the pace of the simulation."""

    ros1: Ros1Option = False
    ros1_host: Ros1HostOption = None
    ros2: Ros2Option = False
    domain: DomainOption = None
    speed: Annotated[
        float | None,
        option(
            CLOCK,
            "--speed",
            metavar="X",
            help="Simulation time per real time; 0 is as fast as possible [1 with a connection "
            "and no --client, else 0].",
        ),
    ] = None
    max_lag: Annotated[
        float | None,
        option(
            CLOCK,
            "--max-lag",
            metavar="SECONDS",
            help="The greatest lag, for hardware in the loop: the run ends when the simulation is "
            "later than this [a late simulation loses time]; --strict counts instead.",
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
        """True if a connection is requested."""
        return bool(self.transports)

    @property
    def transports(self) -> tuple[str, ...]:
        """The names of the requested transports."""
        requests = {"ros1": self.ros1, "ros2": self.ros2, "web": self.web is not None}
        return tuple(name for name, is_requested in requests.items() if is_requested)

    @property
    def real_time_factor(self) -> float:
        """The simulation time per real time; 0 is as fast as possible."""
        is_free = self.is_connected and not self.client
        return float(is_free) if self.speed is None else self.speed

    def check(self, errors: ErrorCollector) -> None:
        """Collect the errors of the options."""
        with errors.collect():
            if self.domain is not None and not self.ros2:
                raise BadSetting("--domain needs --ros2.")
        with errors.collect():
            if self.ros1_host is not None and not self.ros1:
                raise BadSetting("--ros1-host needs --ros1.")
        with errors.collect():
            factor = self.real_time_factor
            if not (factor == 0 or MIN_REAL_TIME_FACTOR <= factor < float("inf")):
                raise BadSetting(
                    f"--speed {factor:g}: expected 0, or {MIN_REAL_TIME_FACTOR:g} or more."
                )
        with errors.collect():
            if self.max_lag is not None and not 0.0 < self.max_lag < float("inf"):
                raise BadSetting(f"--max-lag {self.max_lag:g}: expected a time > 0 [s].")
            if self.max_lag is not None and self.real_time_factor == 0:
                raise BadSetting("--max-lag needs a run in real time; add --speed or --strict.")
        with errors.collect():
            if self.ros2:
                from ...middleware.ros2.choice import check

                check(os.environ, self.domain)
        with errors.collect():
            if (web := self.web_options()) is not None:
                web.check_free()
        with errors.collect():
            check_clients(self.client or (), self.client_limit, self.transports)
        with errors.collect():
            if self.client_secret_file is not None and not self.client:
                raise BadSetting("--client-secret-file needs --client.")
            read_client_secret(self.client_secret_file)

    def spec(self) -> ConnectionSpec:
        """Return the connections to open; raise BadSetting."""
        from ...middleware.connection import ConnectionSpec

        return ConnectionSpec(
            ros1=self.ros1,
            ros1_host=self.ros1_host or "127.0.0.1",
            ros2=self.ros2,
            domain=self.domain,
            web=self.web_options(),
        )

    def web_options(self) -> WebOptions | None:
        """Return the settings of the web server; raise BadSetting."""
        return WebOptionValues(
            port=self.web,
            host=self.web_host,
            token=self.web_token,
            token_file=self.web_token_file,
            origins=self.web_origin,
        ).options()


@contextmanager
def open_connections(
    simulation: Simulation, options: ConnectionOptions, strict_clock: StrictClock | None = None
) -> Iterator[None]:
    """Connect a simulation to external programs, and pace it, within the block.

    The block begins when all clients in lock-step have joined. An external program may end it. A
    strict clock paces the simulation instead of the pace of the options.
    """
    from ...simulation.control import Quit

    with options.spec().open(simulation.bus, lambda: simulation.time) as bridges:
        if options.client:
            _attach_clients(simulation, bridges, options)
        if bridges:
            _connect_bridges(simulation, bridges)
        if strict_clock is not None:
            simulation.watch(strict_clock.step)
        elif options.real_time_factor > 0:
            from ...middleware.pacing import Pace

            pace = Pace(lambda: simulation.time, options.real_time_factor, max_lag=options.max_lag)
            simulation.watch(pace.step)
        with suppress(Quit):
            yield


def _attach_clients(
    simulation: Simulation, bridges: Sequence[Bridge], options: ConnectionOptions
) -> None:
    from ...middleware.lockstep.client import lockstep_clients

    for client in lockstep_clients(
        bridges,
        options.client or (),
        timestep=simulation.timestep,
        limit=options.client_limit,
        secret=read_client_secret(options.client_secret_file),
    ):
        node = simulation.attach(client, name=client.name, raises=False)
        if node.error is not None:
            raise RunFailed(f"{client.name} {node.failure_verb}: {node.error}")


def _connect_bridges(simulation: Simulation, bridges: Sequence[Bridge]) -> None:
    """Exchange messages with bridges, and control the simulation, at the end of each step."""
    from ...simulation.control import SimulationControl

    def exchange() -> None:
        for bridge in bridges:
            bridge.step()

    control = SimulationControl(simulation, exchange)
    exchange()
    control.begin()
    simulation.watch(exchange)
    simulation.watch(control.hold)
