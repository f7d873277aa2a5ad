"""Options of the live view, and what opens it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting
from .help_texts import CONNECTED, in_group

if TYPE_CHECKING:
    from ...viewer.live.session import LiveSession


@dataclass(frozen=True, kw_only=True)
class LiveOptions:
    """Whether a browser may look on."""

    view: Annotated[
        bool,
        in_group(
            CONNECTED,
            "--view",
            help="Look on in a browser, at the address that is printed; and pilot. On this "
            "computer only.",
        ),
    ] = False
    port: Annotated[
        int | None,
        in_group(
            CONNECTED, "--port", metavar="N", min=0, max=65535, help="Of --view [any free one]."
        ),
    ] = None
    pilot_mapping: Annotated[
        Path | None,
        in_group(
            CONNECTED,
            "--pilot-mapping",
            metavar="FILE.toml",
            help="What keys, gamepad and sticks do, where it is not as usual.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse options without --view; raises BadSetting."""
        for option, value in (("--port", self.port), ("--pilot-mapping", self.pilot_mapping)):
            if value is not None and not self.view:
                raise BadSetting(f"{option} is of --view.")
        if self.pilot_mapping is not None:
            from ...viewer.live.mapping import read_mapping

            read_mapping(self.pilot_mapping)

    @contextmanager
    def opened(
        self,
        title: str,
        *,
        speed: float,
        is_piloted: bool,
        waits: bool = False,
        resets: bool = False,
    ) -> Iterator[LiveSession | None]:
        """Open the port and print the address; None where nobody may look.

        Args:
            title: of the page.
            speed: simulation time a second; 0: as fast as it can.
            is_piloted: whether viewers pilot.
            waits: whether nothing begins before somebody looks.
            resets: whether viewers may put everything back where it began.
        """
        if not self.view:
            yield None
            return
        from ...viewer.document import document
        from ...viewer.live.mapping import PilotMapping, read_mapping
        from ...viewer.live.server import LiveServer
        from ...viewer.live.session import LiveSession

        mapping = None
        if is_piloted:
            mapping = read_mapping(self.pilot_mapping) if self.pilot_mapping else PilotMapping()
        server = LiveServer(lambda: document(title, None), self.port or 0)
        session = LiveSession(
            server,
            speed=speed,
            mapping=mapping,
            waits_for_page=waits,
            allows_reset=resets,
            report=lambda text: print(text, file=sys.stderr),
        )
        typer.echo(f"view: {server.url}", err=True)
        try:
            yield session
        finally:
            session.end("The run has ended.")
            server.close()
