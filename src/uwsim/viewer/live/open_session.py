"""The opening of a live session: its port, and the line with its address."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..document import document
from .mapping import PilotMapping
from .server import LiveServer
from .session import LiveSession


@contextmanager
def open_session(
    title: str,
    *,
    report: Callable[[str], None],
    port: int = 0,
    speed: float = 1.0,
    mapping: PilotMapping | None = None,
    waits: bool = False,
    resets: bool = False,
) -> Iterator[LiveSession]:
    """Open the port and report the address; at the end of the block, send the end to all pages.

    Args:
        title: the title of the page.
        report: the function that prints a line for the user.
        port: the port; 0: any free one.
        speed: the simulation time per wall time [1]; 0: as fast as possible.
        mapping: the mapping of keys and sticks; None: users of the page cannot pilot.
        waits: True if a simulation begins only when a browser has connected.
        resets: True if users of the page may reset the scene.

    Raises:
        BadSetting: the port is taken.
    """
    server = LiveServer(lambda: document(title, None), port)
    session = LiveSession(
        server,
        real_time_factor=speed,
        mapping=mapping,
        waits_for_page=waits,
        allows_reset=resets,
        report=report,
    )
    report(f"view: {server.url}")
    try:
        yield session
    finally:
        session.end("The run has ended.")
        server.close()
