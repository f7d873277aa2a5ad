"""The options of the server for web clients."""

from __future__ import annotations

import re
import socket
from dataclasses import dataclass, field

from ...errors import BadSetting

ORIGIN = re.compile(r"https?://[^\s/:]+(:[0-9]+)?")
"""The pattern of the origin of a page."""
LOOPBACK = ("127.0.0.1", "localhost", "::1")
"""The names and addresses of this computer on the loopback interface."""


@dataclass(frozen=True, kw_only=True)
class WebOptions:
    """The address of the server, and the clients that may connect."""

    port: int = 9090
    """The port; 0: a port that the system chooses."""
    host: str = "127.0.0.1"
    """The address to listen on; an address that other computers can reach requires a token."""
    token: str | None = field(default=None, repr=False)
    """The token that clients send: ``ws://HOST:PORT/?token=...`` or ``Authorization: Bearer``."""
    origins: tuple[str, ...] = ()
    """The origins of pages that may connect, as ``https://example.org``; local pages always may."""

    def __post_init__(self) -> None:
        if not 0 <= self.port < 2**16:
            raise BadSetting(f"--web {self.port}: expected a port, from 0 to 65535.")
        if self.token is not None and not self.token.strip():
            raise BadSetting("The token of --web is blank.")
        for origin in self.origins:
            if not ORIGIN.fullmatch(origin):
                raise BadSetting(
                    f"--web-origin {origin}: expected scheme and host, as https://example.org."
                )
        if self.host not in LOOPBACK and not self.token:
            raise BadSetting(
                f"--web-host {self.host}: other computers could connect; set "
                "UWSIM_WEB_TOKEN, or give --web-token-file FILE."
            )

    def check_free(self) -> None:
        """Raise BadSetting if the port is in use, or cannot be used."""
        try:
            addresses = socket.getaddrinfo(self.host, self.port, type=socket.SOCK_STREAM)
            family, kind, protocol, _, address = addresses[0]
            with socket.socket(family, kind, protocol) as test_socket:
                test_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                test_socket.bind(address)
        except OSError as error:
            raise BadSetting(
                f"--web {self.port}: cannot listen on {self.host}: {error.strerror or error}."
            ) from None
