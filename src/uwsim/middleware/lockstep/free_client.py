"""Programs that are not waited for: simulation time goes with the clock on the wall."""

from __future__ import annotations

from ...bus import Node
from ..bridge import Bridge
from .spec import ClientSpec


class FreeClient:
    """Whatever is connected; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Its messages and calls take effect at the end of the step in which they have come, so that two
    runs are not the same.
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec) -> None:
        self._bridge, self._spec = bridge, spec

    @property
    def name(self) -> str:
        """Its name in the result."""
        return self._spec.name

    @property
    def parameters(self) -> dict[str, float | str]:
        """Those of the programs are their own."""
        return {}

    def start(self, node: Node) -> None:
        """Show the outside what there is; nobody is waited for."""
        self._bridge.step()
