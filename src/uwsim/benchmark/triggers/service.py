"""service: on as soon as its service is called.

.. code-block:: xml

    <startOn> <type>service</type> <target>startBench</target> </startOn>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...messages import Empty, EmptyResponse
from ...world import World
from .trigger import Trigger, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class ServiceSpec(TriggerSpec):
    """A trigger of type ``service``."""

    target: str
    """Name of the service it offers (std_srvs/Empty)."""

    def bind(self, world: World) -> Service:
        """Offer the service."""
        return Service(world, self.target)


class Service(Trigger):
    """On from the first call of its service, and for good.

    Several triggers may wait for one service: a call reaches all of them.
    """

    def __init__(self, world: World, name: str) -> None:
        self._was_called = False
        self._leave = world.bus.services.offer(name, Empty, self._call)

    def is_on(self) -> bool:
        """Whether the service has been called."""
        return self._was_called

    def close(self) -> None:
        """Stop waiting for the service; the last trigger to do so removes it."""
        self._leave()

    def _call(self, request: Empty) -> EmptyResponse:
        self._was_called = True
        return EmptyResponse()
