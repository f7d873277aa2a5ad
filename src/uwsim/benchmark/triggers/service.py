"""service: a trigger that turns on as soon as a service is called, which the trigger offers.

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
    """The name of the service that the trigger offers (std_srvs/Empty)."""

    def bind(self, world: World) -> Service:
        """Offer the service."""
        return Service(world, self.target)


class Service(Trigger):
    """A trigger that turns on, for good, at the first call of its service.

    Several triggers may share one service; a call turns all of them on.
    """

    def __init__(self, world: World, name: str) -> None:
        self._was_called = False
        self._withdraw = world.bus.services.offer(name, Empty, self._call)

    def is_on(self) -> bool:
        """Return whether the service has been called."""
        return self._was_called

    def close(self) -> None:
        """Stop offering the service; it is removed when no other trigger shares it."""
        self._withdraw()

    def _call(self, request: Empty) -> EmptyResponse:
        self._was_called = True
        return EmptyResponse()
