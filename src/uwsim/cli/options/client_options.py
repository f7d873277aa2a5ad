"""Options of ``uwsim bench`` for an algorithm outside, in lock-step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from ...errors import AllErrors, BadSetting
from .connections import ConnectionOptions, DomainOption, Ros1HostOption, Ros1Option, Ros2Option
from .help_texts import CONNECTED, in_group
from .web_options import (
    CLIENT_LIMIT,
    ClientLimitOption,
    WebHostOption,
    WebOption,
    WebOriginOption,
    WebTokenOption,
)

if TYPE_CHECKING:
    from ...middleware.lockstep.client import ClientSpec


@dataclass(frozen=True, kw_only=True)
class ClientOptions:
    """An algorithm outside, and how it comes."""

    client: Annotated[
        str | None,
        in_group(
            CONNECTED,
            "--client",
            metavar="NAME",
            help="The algorithm is a program outside, in lock-step: simulation time waits until it "
            "has joined under this name, and for its answers.",
        ),
    ] = None
    client_limit: ClientLimitOption = CLIENT_LIMIT
    web: WebOption = None
    web_host: WebHostOption = None
    web_token: WebTokenOption = None
    web_origin: WebOriginOption = None
    ros1: Ros1Option = False
    ros1_host: Ros1HostOption = None
    ros2: Ros2Option = False
    domain: DomainOption = None

    def check(self, wrong: AllErrors, workers: str) -> None:
        """Collect the errors of the options."""
        self._connections.check(wrong)
        with wrong.kept():
            if self.client is None and self._connections.is_connected:
                name = self._connections.transports[0]
                raise BadSetting(
                    f"--{name}: a benchmark is connected to a --client NAME in lock-step only."
                )
        with wrong.kept():
            if self.client is not None and workers not in ("0", "1"):
                raise BadSetting(
                    f"--workers {workers}: --client {self.client} is one program; expected 1."
                )

    def client_spec(self) -> ClientSpec | None:
        """Return the program outside; None without one."""
        from ...middleware.lockstep.client import ClientSpec

        if self.client is None:
            return None
        return ClientSpec(
            name=self.client, connection=self._connections.spec(), limit=self.client_limit
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
            web_origin=self.web_origin,
            client=None if self.client is None else [self.client],
            client_limit=self.client_limit,
        )
