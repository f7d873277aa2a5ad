"""Where web clients are served, and which."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import BadSetting

LOOPBACK = ("127.0.0.1", "localhost", "::1")


@dataclass(frozen=True, kw_only=True)
class WebOptions:
    """Where the server listens, and who may connect."""

    port: int = 9090
    """Port; 0: one that the system chooses."""
    host: str = "127.0.0.1"
    """Address; another than this computer's own needs a token."""
    token: str | None = None
    """What a client has to give: ``ws://HOST:PORT/?token=...`` or ``Authorization: Bearer``."""
    origins: tuple[str, ...] = ()
    """Pages that may connect, as ``https://example.org``, next to those of this computer."""

    def __post_init__(self) -> None:
        if not 0 <= self.port < 2**16:
            raise BadSetting(f"--web {self.port}: expected a port, from 0 to 65535.")
        if self.host not in LOOPBACK and not self.token:
            raise BadSetting(
                f"--web-host {self.host}: other computers could connect; give a --web-token too."
            )
