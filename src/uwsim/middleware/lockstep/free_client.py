"""Programs for which the simulation does not wait: simulation time follows wall time."""

from __future__ import annotations

from ...bus import Node
from .external_program import ExternalProgram


class FreeClient(ExternalProgram):
    """All connected programs together, as one algorithm in the sense of `uwsim.bus.Algorithm`.

    Messages and calls take effect at the end of the step in which they arrive, so that two runs
    differ.
    """

    def start(self, node: Node) -> None:
        """Advertise topics and services; wait for no program."""
        self._bridge.step()
