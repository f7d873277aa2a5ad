"""The options of the live view."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting
from .help_texts import LIVE_VIEW, option

if TYPE_CHECKING:
    from ...viewer.live.session import LiveSession


@dataclass(frozen=True, kw_only=True)
class LiveOptions:
    """The options of the live view in a browser."""

    view: Annotated[
        bool,
        option(
            LIVE_VIEW,
            "--view",
            help="Show the run in a browser, at the printed address; and pilot. On this computer "
            "only.",
        ),
    ] = False
    port: Annotated[
        int | None,
        option(
            LIVE_VIEW,
            "--port",
            metavar="N",
            min=0,
            max=65535,
            help="Port of --view [any free one].",
        ),
    ] = None
    pilot_mapping: Annotated[
        Path | None,
        option(
            LIVE_VIEW,
            "--pilot-mapping",
            metavar="FILE.toml",
            help="File that changes the default mapping of keys, gamepad and sticks.",
        ),
    ] = None

    def check(self) -> None:
        """Raise BadSetting for an option without --view, or an invalid mapping."""
        for name, value in (("--port", self.port), ("--pilot-mapping", self.pilot_mapping)):
            if value is not None and not self.view:
                raise BadSetting(f"{name} needs --view.")
        if self.pilot_mapping is not None:
            from ...viewer.live.mapping import read_mapping

            read_mapping(self.pilot_mapping)

    @contextmanager
    def open_session(
        self,
        title: str,
        *,
        speed: float,
        is_piloted: bool,
        waits: bool = False,
        resets: bool = False,
    ) -> Iterator[LiveSession | None]:
        """Open the port and print the address; None without ``--view``.

        Args:
            title: the title of the page.
            speed: the simulation time per second; 0: as fast as possible.
            is_piloted: True if users of the page pilot.
            waits: True if the run begins only when a browser has connected.
            resets: True if users of the page may reset the scene.
        """
        if not self.view:
            yield None
            return
        from ...viewer.live.mapping import PilotMapping, read_mapping
        from ...viewer.live.open_session import open_session

        mapping = None
        if is_piloted:
            mapping = read_mapping(self.pilot_mapping) if self.pilot_mapping else PilotMapping()
        with open_session(
            title,
            report=lambda text: typer.echo(text, err=True),
            port=self.port or 0,
            speed=speed,
            mapping=mapping,
            waits=waits,
            resets=resets,
        ) as session:
            yield session
