"""The options of ``uwsim bench`` for an external algorithm, in lock-step or in real time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting, ErrorCollector
from ...middleware.pacing import MIN_REAL_TIME_FACTOR
from .connections import ConnectionOptions, DomainOption, Ros1HostOption, Ros1Option, Ros2Option
from .help_texts import PROGRAMS, option
from .secrets import read_client_secret
from .web_options import (
    CLIENT_LIMIT,
    ClientLimitOption,
    ClientSecretFileOption,
    WebHostOption,
    WebOption,
    WebOriginOption,
    WebTokenFileOption,
    WebTokenOption,
)

if TYPE_CHECKING:
    from ...middleware.lockstep.spec import ClientSpec, OutputSpec


@dataclass(frozen=True, kw_only=True)
class ClientOptions:
    """The options of an external algorithm: its connection and its synchronization."""

    client: Annotated[
        str | None,
        option(
            PROGRAMS,
            "--client",
            metavar="NAME",
            help="The algorithm is an external program with this name in the result: in lock-step, "
            "unless --sync selects another mode.",
        ),
    ] = None
    client_limit: ClientLimitOption = CLIENT_LIMIT
    client_secret_file: ClientSecretFileOption = None
    sync: Annotated[
        str | None,
        option(
            PROGRAMS,
            "--sync",
            metavar="WHAT",
            help="How simulation time advances. ack: the client joins and acknowledges each tick. "
            "step: it requests the steps by the service /step_simulation. output: it has no "
            "lock-step and uses /clock; the simulation waits for each --output that is due. none: "
            "simulation time is real time; not repeatable.  [ack]",
        ),
    ] = None
    output: Annotated[
        list[str] | None,
        option(
            PROGRAMS,
            "--output",
            metavar="TOPIC=RATE|INPUT",
            help="For --sync output: a topic that the client publishes at a rate, as "
            "/cmd_vel=10Hz, or once for each message of another, as /corners=/camera/image; may "
            "be repeated.",
        ),
    ] = None
    settle: Annotated[
        float | None,
        option(
            PROGRAMS,
            "--settle",
            metavar="SECONDS",
            help="For --sync output and step, over ROS: the greatest delay of messages, in wall "
            "time.  [0.005]",
        ),
    ] = None
    speed: Annotated[
        float | None,
        option(
            PROGRAMS,
            "--speed",
            metavar="X",
            help="For --sync none and --view: simulation time per real time. With --view the run "
            "then waits for a browser.  [--sync none: 1, --view: as fast as possible]",
        ),
    ] = None
    web: WebOption = None
    web_host: WebHostOption = None
    web_token: WebTokenOption = None
    web_token_file: WebTokenFileOption = None
    web_origin: WebOriginOption = None
    ros1: Ros1Option = False
    ros1_host: Ros1HostOption = None
    ros2: Ros2Option = False
    domain: DomainOption = None

    def check(self, errors: ErrorCollector, workers: str, *, is_viewed: bool = False) -> None:
        """Collect the errors of the options; ``is_viewed``: the run is shown in a browser."""
        self._connections.check(errors)
        with errors.collect():
            if self.client is not None and not self.client.strip():
                raise BadSetting("--client: expected a name.")
        with errors.collect():
            if self.client is None and self._connections.is_connected:
                name = self._connections.transports[0]
                raise BadSetting(
                    f"--{name}: add --client NAME, the external program that is scored; and --sync "
                    "none, if it has no lock-step."
                )
        with errors.collect():
            if self.client is not None and workers not in ("0", "1"):
                raise BadSetting(
                    f"--workers {workers}: --client {self.client} is one program; expected 1."
                )
        self._check_sync(errors, is_viewed=is_viewed)

    def _check_sync(self, errors: ErrorCollector, *, is_viewed: bool) -> None:
        from ...middleware.lockstep.spec import read_sync

        sync = self.sync or "ack"
        requirements = {
            "--output": (self.output, ("output",)),
            "--settle": (self.settle, ("output", "step")),
            "--speed": (None if is_viewed else self.speed, ("none",)),
            "--client-secret-file": (self.client_secret_file, ("ack",)),
        }
        for name, (value, kinds) in requirements.items():
            with errors.collect():
                if value is not None and sync not in kinds:
                    raise BadSetting(f"{name} needs --sync {' or '.join(kinds)}.")
        with errors.collect():
            if self.sync is not None and self.client is None:
                raise BadSetting(f"--sync {sync} needs --client NAME.")
        with errors.collect():
            if read_sync(sync) == "output" and not self.output:
                raise BadSetting(
                    "--sync output: add the client's topics, as --output /cmd_vel=10Hz."
                )
        with errors.collect():
            speed = 1.0 if self.speed is None else self.speed
            if not MIN_REAL_TIME_FACTOR <= speed < float("inf"):
                raise BadSetting(
                    f"--speed {speed:g}: expected a number >= {MIN_REAL_TIME_FACTOR:g}."
                )
        with errors.collect():
            if not 0.0 <= (self.settle or 0.0) < float("inf"):
                raise BadSetting(f"--settle {self.settle:g}: expected a time >= 0 [s].")
        with errors.collect():
            _read_outputs(self.output or ())

    def client_spec(self) -> ClientSpec | None:
        """Return the spec of the external program; None without ``--client``."""
        from ...middleware.lockstep.spec import DEFAULT_SETTLE_TIME, ClientSpec, read_sync

        if self.client is None:
            return None
        return ClientSpec(
            name=self.client,
            connection=self._connections.spec(),
            limit=self.client_limit,
            sync=read_sync(self.sync or "ack"),
            outputs=_read_outputs(self.output or ()),
            settle=DEFAULT_SETTLE_TIME if self.settle is None else self.settle,
            speed=1.0 if self.speed is None else self.speed,
            secret=read_client_secret(self.client_secret_file)
            if self.sync in (None, "ack")
            else None,
        )

    @property
    def _connections(self) -> ConnectionOptions:
        return ConnectionOptions(
            ros1=self.ros1,
            ros1_host=self.ros1_host,
            ros2=self.ros2,
            domain=self.domain,
            web=self.web,
            web_host=self.web_host,
            web_token=self.web_token,
            web_token_file=self.web_token_file,
            web_origin=self.web_origin,
            client=None if self.client is None else [self.client],
            client_limit=self.client_limit,
            client_secret_file=self.client_secret_file,
        )


def _read_outputs(texts: Sequence[str]) -> tuple[OutputSpec, ...]:
    from ...middleware.lockstep.spec import read_outputs

    return read_outputs(texts)
