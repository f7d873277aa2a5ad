"""Services that web clients offer."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial

from ...errors import UwsimError
from ...messages.services import Service
from ..admission import Admission
from ..exchange.external_services import ExternalServices
from .contract import Client


class ClientServices:
    """Which clients offer a service; of several, the first is called.

    Args:
        services: those of the outside, on the bus.
        admission: returns who may offer; None: everybody.
    """

    def __init__(
        self, services: ExternalServices, admission: Callable[[], Admission | None]
    ) -> None:
        self._services, self._admission = services, admission
        self._offerers: dict[str, tuple[Client, ...]] = {}

    def offer(self, name: str, service: Service, client: Client) -> None:
        """A client offers a service. Any thread."""
        later = partial(self.offer, name, service, client)
        admission = self._admission()
        if admission and not admission.may_offer(name, client.name, later):
            return
        self._offerers[name] = (*self._offerers.get(name, ()), client)
        self._services.offer(name, service)

    def withdraw(self, name: str, client: Client) -> None:
        """A client offers it no more. In the thread of the server."""
        offerers = self._offerers.pop(name, ())
        left = tuple(each for each in offerers if each is not client)
        if left:
            self._offerers[name] = left
        elif offerers:
            self._services.withdraw(name)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of a client. In the thread of the simulation."""
        offerers = self._offerers.get(name)
        if not offerers:
            raise UwsimError(f"Service /{name}: who offered it has left.")
        return offerers[0].call(name, request)
