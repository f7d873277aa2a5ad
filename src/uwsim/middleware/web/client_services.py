"""Services that web clients advertise."""

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
    """The clients that have advertised each service; if there are several, the first is called.

    Args:
        services: the external services of the bus.
        admission: a function that returns the rule that decides which clients may offer services;
            None: all clients.
    """

    def __init__(
        self, services: ExternalServices, admission: Callable[[], Admission | None]
    ) -> None:
        self._services, self._admission = services, admission
        self._providers: dict[str, tuple[Client, ...]] = {}

    def advertise(self, name: str, service: Service, client: Client) -> None:
        """Offer a service of a client on the bus. May be called from any thread."""
        accept = partial(self.advertise, name, service, client)
        admission = self._admission()
        if admission and not admission.may_offer(name, client.name, accept):
            return
        self._providers[name] = (*self._providers.get(name, ()), client)
        self._services.offer(name, service)

    def unadvertise(self, name: str, client: Client) -> None:
        """Withdraw a service of a client. Called in the thread of the server."""
        providers = self._providers.pop(name, ())
        other_providers = tuple(provider for provider in providers if provider is not client)
        if other_providers:
            self._providers[name] = other_providers
        elif providers:
            self._services.withdraw(name)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service of a client. Called in the thread of the simulation."""
        providers = self._providers.get(name)
        if not providers:
            raise UwsimError(f"Service /{name}: the client that offers it has disconnected.")
        return providers[0].call(name, request)
