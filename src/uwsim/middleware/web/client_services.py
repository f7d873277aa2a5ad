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
    """The clients that offer each service; of several, the first is called.

    Args:
        services: the external services of the bus.
        admission: returns the rule that decides who may offer; None: everybody.
    """

    def __init__(
        self, services: ExternalServices, admission: Callable[[], Admission | None]
    ) -> None:
        self._services, self._admission = services, admission
        self._offerers: dict[str, tuple[Client, ...]] = {}

    def offer(self, name: str, service: Service, client: Client) -> None:
        """Offer a service of a client. Any thread."""
        accept = partial(self.offer, name, service, client)
        admission = self._admission()
        if admission and not admission.may_offer(name, client.name, accept):
            return
        self._offerers[name] = (*self._offerers.get(name, ()), client)
        self._services.offer(name, service)

    def withdraw(self, name: str, client: Client) -> None:
        """Withdraw a service of a client. In the thread of the server."""
        offerers = self._offerers.pop(name, ())
        other_offerers = tuple(offerer for offerer in offerers if offerer is not client)
        if other_offerers:
            self._offerers[name] = other_offerers
        elif offerers:
            self._services.withdraw(name)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of a client. In the thread of the simulation."""
        offerers = self._offerers.get(name)
        if not offerers:
            raise UwsimError(f"Service /{name}: its server has left.")
        return offerers[0].call(name, request)
