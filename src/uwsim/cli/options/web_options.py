"""Options of web clients and of clients in lock-step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting
from .help_texts import CONNECTED, in_group
from .secrets import web_token

if TYPE_CHECKING:
    from ...middleware.web.options import WebOptions

MAX_LIMIT = 1e6
"""The longest that a client is waited for [s]."""
CLIENT_LIMIT = 60.0
"""Default of the longest time that a client in lock-step may take [s of wall time]."""

WebOption = Annotated[
    int | None,
    in_group(
        CONNECTED,
        "--web",
        metavar="PORT",
        help="Serve topics and services by WebSocket (rosbridge protocol) at this port; 9090 is "
        "usual, 0: one that is free.",
    ),
]

WebHostOption = Annotated[
    str | None,
    in_group(
        CONNECTED,
        "--web-host",
        metavar="ADDRESS",
        help="Address at which --web listens, for other computers with a token [127.0.0.1].",
    ),
]

WebTokenOption = Annotated[
    str | None,
    in_group(CONNECTED, "--web-token", metavar="TOKEN", help="Not taken any more.", hidden=True),
]

WebTokenFileOption = Annotated[
    Path | None,
    in_group(
        CONNECTED,
        "--web-token-file",
        metavar="FILE",
        help="Holds what web clients have to give, as ws://HOST:PORT/?token=TOKEN "
        "[UWSIM_WEB_TOKEN].",
    ),
]

ClientSecretFileOption = Annotated[
    Path | None,
    in_group(
        CONNECTED,
        "--client-secret-file",
        metavar="FILE",
        help="Holds a secret that the join of the --client has to have, so that no other program "
        "joins under its name [UWSIM_CLIENT_SECRET].",
    ),
]

WebOriginOption = Annotated[
    list[str] | None,
    in_group(
        CONNECTED,
        "--web-origin",
        metavar="ORIGIN",
        help="A page that may connect, as https://example.org, next to those of this computer; "
        "may be repeated.",
    ),
]

ClientOption = Annotated[
    list[str] | None,
    in_group(
        CONNECTED,
        "--client",
        metavar="NAME",
        help="A program outside, in lock-step: simulation time waits until it has joined under "
        "this name, and for its answers; may be repeated.",
    ),
]

ClientLimitOption = Annotated[
    float,
    in_group(
        CONNECTED,
        "--client-limit",
        metavar="SECONDS",
        help="How long a --client may take to join and to answer, in wall time; after that the "
        "run is invalid.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class WebGiven:
    """What was given of the options of ``--web``."""

    port: int | None = None
    """Of ``--web``."""
    host: str | None = None
    """Of ``--web-host``."""
    token: str | None = None
    """Of ``--web-token``, which is refused."""
    token_file: Path | None = None
    """Of ``--web-token-file``."""
    origins: Sequence[str] | None = None
    """Of ``--web-origin``."""

    def options(self) -> WebOptions | None:
        """Return where web clients are served; None without ``--web``.

        Raises:
            BadSetting: an option is wrong, or is of ``--web`` and there is none.
        """
        from ...middleware.web.options import WebOptions

        if self.port is None:
            given = {
                "host": self.host,
                "token": self.token,
                "token-file": self.token_file,
                "origin": self.origins,
            }
            for name, value in given.items():
                if value:
                    raise BadSetting(f"--web-{name} is of --web.")
            return None
        return WebOptions(
            port=self.port,
            host=self.host or "127.0.0.1",
            token=web_token(self.token, self.token_file),
            origins=tuple(self.origins or ()),
        )


def check_clients(names: Sequence[str], limit: float, transports: Sequence[str]) -> None:
    """Refuse clients that could not come; raises BadSetting."""
    if not 0.0 < limit <= MAX_LIMIT:
        raise BadSetting(
            f"--client-limit {limit:g}: expected a time > 0 and at most {MAX_LIMIT:g} [s]."
        )
    if not all(name.strip() for name in names):
        raise BadSetting("--client: it is blank; expected the name by which the program joins.")
    if names and len(transports) != 1:
        given = " and ".join(f"--{name}" for name in transports)
        raise BadSetting(
            f"--client {names[0]}: expected one of --web, --ros1 and --ros2, by which it comes"
            f"{f', not {given}' if given else ''}."
        )
