"""The options of the web server and of clients in lock-step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...errors import BadSetting
from .help_texts import PROGRAMS, option
from .secrets import read_web_token

if TYPE_CHECKING:
    from ...middleware.web.options import WebOptions

MAX_LIMIT = 1e6
"""The greatest time limit of a client [s]."""
CLIENT_LIMIT = 60.0
"""The default time limit of a client in lock-step [s of wall time]."""

WebOption = Annotated[
    int | None,
    option(
        PROGRAMS,
        "--web",
        metavar="PORT",
        help="Serve topics and services by WebSocket (rosbridge protocol) at this port; 9090 is "
        "usual, 0: a free port.",
    ),
]

WebHostOption = Annotated[
    str | None,
    option(
        PROGRAMS,
        "--web-host",
        metavar="ADDRESS",
        help="Address of the --web server; other computers need a token [127.0.0.1].",
    ),
]

WebTokenOption = Annotated[
    str | None,
    option(PROGRAMS, "--web-token", metavar="TOKEN", help="Not accepted any more.", hidden=True),
]

WebTokenFileOption = Annotated[
    Path | None,
    option(
        PROGRAMS,
        "--web-token-file",
        metavar="FILE",
        help="File with the token of web clients, as in ws://HOST:PORT/?token=TOKEN "
        "[UWSIM_WEB_TOKEN].",
    ),
]

ClientSecretFileOption = Annotated[
    Path | None,
    option(
        PROGRAMS,
        "--client-secret-file",
        metavar="FILE",
        help="File with a secret for the join of the --client, so that no other program joins "
        "under its name [UWSIM_CLIENT_SECRET].",
    ),
]

WebOriginOption = Annotated[
    list[str] | None,
    option(
        PROGRAMS,
        "--web-origin",
        metavar="ORIGIN",
        help="Origin of pages that may connect, such as https://example.org, besides pages of this "
        "computer; may be repeated.",
    ),
]

ClientOption = Annotated[
    list[str] | None,
    option(
        PROGRAMS,
        "--client",
        metavar="NAME",
        help="An external program, in lock-step: simulation time waits until it has joined under "
        "this name, and for its answers; may be repeated.",
    ),
]

ClientLimitOption = Annotated[
    float,
    option(
        PROGRAMS,
        "--client-limit",
        metavar="SECONDS",
        help="Time limit of a --client for its join and for each answer, in wall time; after it "
        "the run is invalid.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class WebOptionValues:
    """The values of the options of ``--web``."""

    port: int | None = None
    """The value of ``--web``."""
    host: str | None = None
    """The value of ``--web-host``."""
    token: str | None = None
    """The value of ``--web-token``, which is not accepted any more."""
    token_file: Path | None = None
    """The value of ``--web-token-file``."""
    origins: Sequence[str] | None = None
    """The values of ``--web-origin``."""

    def options(self) -> WebOptions | None:
        """Return the settings of the web server; None without ``--web``.

        Raises:
            BadSetting: an option is invalid, or needs ``--web``.
        """
        from ...middleware.web.options import WebOptions

        if self.port is None:
            values = {
                "host": self.host,
                "token": self.token,
                "token-file": self.token_file,
                "origin": self.origins,
            }
            for name, value in values.items():
                if value:
                    raise BadSetting(f"--web-{name} needs --web.")
            return None
        return WebOptions(
            port=self.port,
            host=self.host or "127.0.0.1",
            token=read_web_token(self.token, self.token_file),
            origins=tuple(self.origins or ()),
        )


def check_clients(names: Sequence[str], limit: float, transports: Sequence[str]) -> None:
    """Raise BadSetting if clients in lock-step cannot connect with these options."""
    if not 0.0 < limit <= MAX_LIMIT:
        raise BadSetting(f"--client-limit {limit:g}: expected > 0 and at most {MAX_LIMIT:g} [s].")
    if not all(name.strip() for name in names):
        raise BadSetting("--client: it is blank; expected the name by which the program joins.")
    if names and len(transports) != 1:
        connections = " and ".join(f"--{name}" for name in transports)
        raise BadSetting(
            f"--client {names[0]}: expected one of --web, --ros1 and --ros2 to connect it"
            f"{f', not {connections}' if connections else ''}."
        )
