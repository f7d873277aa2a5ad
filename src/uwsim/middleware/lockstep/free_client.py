"""Programs that are not waited for: simulation time goes with the clock on the wall."""

from __future__ import annotations

from ...bus import Node
from .external_program import ExternalProgram


class FreeClient(ExternalProgram):
    """Whatever is connected; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Its messages and calls take effect at the end of the step in which they have come, so that two
    runs are not the same.
    """

    def start(self, node: Node) -> None:
        """Show the outside what there is; nobody is waited for."""
        self._bridge.step()
