"""Services that external programs offer to the bus."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial

from ...bus import Services
from ...errors import RunFailed
from ...messages.services import Service
from ..log import Log
from .work_signal import WorkSignal

CALL_LIMIT = 60.0
"""The time within which an external service must answer [s of wall time]."""
Offer = tuple[str, Service | None]
"""The name of a service and its type; None withdraws the service."""


class ExternalServices:
    """The external services that a bus offers; the simulation waits for their responses.

    Args:
        services: the services of the bus.
        log: the log for services whose name is in use.
        signal: the work signal of the bridge.
        call: a function that calls an external service.
        wait_for: a function that waits until a condition holds, at most for a time [s]; it returns
            whether the condition holds.
    """

    def __init__(
        self,
        services: Services,
        log: Log,
        signal: WorkSignal,
        *,
        call: Callable[[str, object], Future[object]],
        wait_for: Callable[[Callable[[], bool], float], bool],
    ) -> None:
        self._services, self._log, self._signal = services, log, signal
        self._call, self._wait_for = call, wait_for
        self._offers: list[Offer] = []
        self._names: set[str] = set()
        self.n_called = 0
        """The number of calls of external services so far."""

    def __contains__(self, name: str) -> bool:
        """Return whether a service on the bus is external.

        Called in the thread of the simulation.
        """
        return name in self._names

    def offer(self, name: str, service: Service) -> None:
        """Offer a service of an external program. May be called from any thread."""
        self._add((name.lstrip("/"), service))

    def withdraw(self, name: str) -> None:
        """Withdraw a service of an external program. May be called from any thread."""
        self._add((name.lstrip("/"), None))

    def take(self) -> list[Offer]:
        """Remove and return the offers that wait. With the lock of the signal."""
        offers, self._offers = self._offers, []
        return offers

    def apply(self, offers: list[Offer]) -> None:
        """Offer external services on the bus, or withdraw them."""
        for name, service in offers:
            if service is None:
                if name in self._names:
                    self._names.discard(name)
                    self._services.withdraw(name)
            elif self._services.is_offered(name):
                self._log.report(f"service /{name} is offered already; the external one is ignored")
            else:
                self._names.add(name)
                self._services.serve(name, service.request, partial(self.call_and_wait, name))

    def call_and_wait(self, name: str, request: object) -> object:
        """Call an external service and wait for its response.

        Raises:
            RunFailed: the response does not come in time.
        """
        future = self._call(name, request)
        self.n_called += 1
        future.add_done_callback(lambda _: self._signal.wake())
        if not self._wait_for(future.done, CALL_LIMIT):
            raise RunFailed(f"Service /{name}: no response within {CALL_LIMIT:g} s of wall time.")
        return future.result()

    def close(self) -> None:
        """Withdraw all services."""
        for name in sorted(self._names):
            self._services.withdraw(name)
        self._names.clear()

    def _add(self, offer: Offer) -> None:
        with self._signal.lock:
            self._offers.append(offer)
            self._signal.mark_urgent()
        self._signal.wake()
