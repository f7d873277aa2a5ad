"""Services that programs outside offer to the bus."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial

from ...bus import Services
from ...errors import RunFailed
from ...messages.services import Service
from ..log import Log
from .intake import Intake

CALL_LIMIT = 60.0
"""How long a call of a service that is offered outside may take [s of wall time]."""
Offer = tuple[str, Service | None]
"""The name of a service, and its type; None if it is offered no more."""


class OutsideServices:
    """Offers services of the outside on a bus; the simulation waits for their responses.

    Args:
        services: those of the bus.
        log: where a service is reported whose name is taken.
        intake: of the bridge.
        call: calls a service outside.
        wait_for: waits until a condition holds, at most a time [s]; returns whether it does.
    """

    def __init__(
        self,
        services: Services,
        log: Log,
        intake: Intake,
        *,
        call: Callable[[str, object], Future[object]],
        wait_for: Callable[[Callable[[], bool], float], bool],
    ) -> None:
        self._services, self._log, self._intake = services, log, intake
        self._call, self._wait_for = call, wait_for
        self._offers: list[Offer] = []
        self._names: set[str] = set()
        self.n_called = 0
        """Services of the outside that the simulation has called so far."""

    def __contains__(self, name: str) -> bool:
        """Whether a service on the bus is one of the outside. In the thread of the simulation."""
        return name in self._names

    def offer(self, name: str, service: Service) -> None:
        """Somebody outside offers a service. Any thread."""
        self._add((name.lstrip("/"), service))

    def withdraw(self, name: str) -> None:
        """A service is no longer offered outside. Any thread."""
        self._add((name.lstrip("/"), None))

    def take(self) -> list[Offer]:
        """Remove and return the offers that wait. With the lock of the intake."""
        offers, self._offers = self._offers, []
        return offers

    def follow(self, offers: list[Offer]) -> None:
        """Offer services of the outside on the bus, or no longer."""
        for name, service in offers:
            if service is None:
                if name in self._names:
                    self._names.discard(name)
                    self._services.withdraw(name)
            elif self._services.serves(name):
                self._log.say(
                    f"service /{name} is offered already; that of the outside is not taken"
                )
            else:
                self._names.add(name)
                self._services.serve(name, service.request, partial(self.ask, name))

    def ask(self, name: str, request: object) -> object:
        """Call a service of the outside and wait for its response.

        Raises:
            RunFailed: there is none.
        """
        future = self._call(name, request)
        self.n_called += 1
        future.add_done_callback(lambda _: self._intake.wake())
        if not self._wait_for(future.done, CALL_LIMIT):
            raise RunFailed(f"Service /{name}: no response within {CALL_LIMIT:g} s of wall time.")
        return future.result()

    def close(self) -> None:
        """Withdraw all services."""
        for name in sorted(self._names):
            self._services.withdraw(name)
        self._names.clear()

    def _add(self, offer: Offer) -> None:
        with self._intake.lock:
            self._offers.append(offer)
            self._intake.add_urgent()
        self._intake.wake()
