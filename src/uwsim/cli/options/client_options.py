"""Options of ``uwsim bench`` for an algorithm outside, in lock-step or in real time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting, ErrorCollector
from ...middleware.pacing import MIN_SPEED
from .connections import ConnectionOptions, DomainOption, Ros1HostOption, Ros1Option, Ros2Option
from .help_texts import CONNECTED, in_group
from .secrets import client_secret
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
    """An algorithm outside, how it comes, and what is waited for."""

    client: Annotated[
        str | None,
        in_group(
            CONNECTED,
            "--client",
            metavar="NAME",
            help="The algorithm is a program outside, which the result calls by this name: in "
            "lock-step, unless --sync says otherwise.",
        ),
    ] = None
    client_limit: ClientLimitOption = CLIENT_LIMIT
    client_secret_file: ClientSecretFileOption = None
    sync: Annotated[
        str | None,
        in_group(
            CONNECTED,
            "--sync",
            metavar="WHAT",
            help="What simulation time waits for. ack: the client joins and acknowledges each "
            "tick. step: it takes the steps itself, by the service /step_simulation. output: it "
            "knows nothing of lock-step and works by /clock; each --output that is due is waited "
            "for. none: nothing, simulation time is real time; not repeatable.  [ack]",
        ),
    ] = None
    output: Annotated[
        list[str] | None,
        in_group(
            CONNECTED,
            "--output",
            metavar="TOPIC=RATE|INPUT",
            help="Of --sync output: a topic that the client publishes at a rate, as "
            "/cmd_vel=10Hz, or once for each message of another, as /corners=/camera/image; may "
            "be repeated.",
        ),
    ] = None
    settle: Annotated[
        float | None,
        in_group(
            CONNECTED,
            "--settle",
            metavar="SECONDS",
            help="Of --sync output and step, over ROS: how long messages may be on their way, in "
            "wall time.  [0.005]",
        ),
    ] = None
    speed: Annotated[
        float | None,
        in_group(
            CONNECTED,
            "--speed",
            metavar="X",
            help="Of --sync none: simulation time per real time.  [1]",
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

    def check(self, wrong: ErrorCollector, workers: str) -> None:
        """Collect the errors of the options."""
        self._connections.check(wrong)
        with wrong.collect():
            if self.client is not None and not self.client.strip():
                raise BadSetting("--client: expected a name.")
        with wrong.collect():
            if self.client is None and self._connections.is_connected:
                name = self._connections.transports[0]
                raise BadSetting(
                    f"--{name}: add --client NAME, the program outside that is scored; and --sync "
                    "none, if it knows nothing of lock-step."
                )
        with wrong.collect():
            if self.client is not None and workers not in ("0", "1"):
                raise BadSetting(
                    f"--workers {workers}: --client {self.client} is one program; expected 1."
                )
        self._check_sync(wrong)

    def _check_sync(self, wrong: ErrorCollector) -> None:
        """Collect what is wrong about what is waited for."""
        from ...middleware.lockstep.spec import read_sync

        sync = self.sync or "ack"
        of = {
            "--output": (self.output, ("output",)),
            "--settle": (self.settle, ("output", "step")),
            "--speed": (self.speed, ("none",)),
            "--client-secret-file": (self.client_secret_file, ("ack",)),
        }
        for option, (value, kinds) in of.items():
            with wrong.collect():
                if value is not None and sync not in kinds:
                    raise BadSetting(f"{option} is of --sync {' and '.join(kinds)}.")
        with wrong.collect():
            if self.sync is not None and self.client is None:
                raise BadSetting(f"--sync {sync} is of --client NAME.")
        with wrong.collect():
            if read_sync(sync) == "output" and not self.output:
                raise BadSetting(
                    "--sync output: add what the client publishes, as --output /cmd_vel=10Hz."
                )
        with wrong.collect():
            if not MIN_SPEED <= (1.0 if self.speed is None else self.speed) < float("inf"):
                raise BadSetting(f"--speed {self.speed:g}: expected a number >= {MIN_SPEED:g}.")
        with wrong.collect():
            if not 0.0 <= (self.settle or 0.0) < float("inf"):
                raise BadSetting(f"--settle {self.settle:g}: expected a time >= 0 [s].")
        with wrong.collect():
            _outputs(self.output or ())

    def client_spec(self) -> ClientSpec | None:
        """Return the program outside; None without one."""
        from ...middleware.lockstep.spec import DEFAULT_SETTLE_TIME, ClientSpec, read_sync

        if self.client is None:
            return None
        return ClientSpec(
            name=self.client,
            connection=self._connections.spec(),
            limit=self.client_limit,
            sync=read_sync(self.sync or "ack"),
            outputs=_outputs(self.output or ()),
            settle=DEFAULT_SETTLE_TIME if self.settle is None else self.settle,
            speed=1.0 if self.speed is None else self.speed,
            secret=client_secret(self.client_secret_file) if self.sync in (None, "ack") else None,
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


def _outputs(texts: Sequence[str]) -> tuple[OutputSpec, ...]:
    """Read every ``--output``; raises BadSetting."""
    from ...middleware.lockstep.spec import read_outputs

    return read_outputs(texts)
