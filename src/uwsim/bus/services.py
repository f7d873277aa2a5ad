"""Services inside the process: their offers, and calls that are answered at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from ..base.message_fields import check_and_freeze
from ..errors import BadMessage, UnknownName
from .names import has_exact_type, strip_slash, type_name

M = TypeVar("M")


class Services:
    """The services by name; names are compared without a leading slash."""

    def __init__(self) -> None:
        self._services: dict[str, tuple[type, Callable[[Any], object]]] = {}
        self._offers: dict[str, list[Callable[[Any], object]]] = {}
        self._external_services: list[
            tuple[Callable[[str], bool], Callable[[str, Any], object]]
        ] = []
        self.revision = 0
        """The number of changes of services."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the services offered in the process, sorted."""
        return tuple(sorted(self._services))

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service whose request class is ``type``; a later offer replaces it."""
        self._services[strip_slash(name)] = (type, handler)
        self.revision += 1

    def offer(self, name: str, type: type[M], handler: Callable[[M], object]) -> Callable[[], None]:
        """Offer a service together with others: a call reaches all, the newest responds.

        Returns a function that ends this offer; the end of the last one withdraws the service.
        """
        handlers = self._offers.setdefault(strip_slash(name), [])
        handlers.append(handler)
        self.serve(name, type, lambda request: [answer(request) for answer in list(handlers)][-1])

        def withdraw_offer() -> None:
            if handler in handlers:
                handlers.remove(handler)
                if not handlers:
                    self.withdraw(name)

        return withdraw_offer

    def withdraw(self, name: str) -> None:
        """Stop offering a service, if it is offered."""
        self._services.pop(strip_slash(name), None)
        self.revision += 1

    def add_external_services(
        self, is_offered: Callable[[str], bool], call: Callable[[str, Any], object]
    ) -> Callable[[], None]:
        """Add services outside of the process, for names that are not offered inside.

        Args:
            is_offered: returns whether a service, named without a leading slash, is offered there.
            call: calls a service with a request, and returns its response.

        Returns:
            A function that removes these services.
        """
        entry = (is_offered, call)
        self._external_services.append(entry)

        def stop() -> None:
            if entry in self._external_services:
                self._external_services.remove(entry)

        return stop

    def request_type(self, name: str) -> type | None:
        """Return the class of a service's requests; None if it is not offered in the process."""
        entry = self._services.get(strip_slash(name))
        return entry[0] if entry else None

    def is_offered(self, name: str) -> bool:
        """Return whether a service is offered, inside or outside of the process."""
        key = strip_slash(name)
        return key in self._services or any(offers(key) for offers, _ in self._external_services)

    def call(self, name: str, request: object) -> object:
        """Call a service now.

        Raises:
            UnknownName: the service is not offered.
            BadMessage: the request, or a field of it, is of another type.
        """
        if strip_slash(name) not in self._services:
            return self._call_external(name, request)
        type, handler = self._services[strip_slash(name)]
        if not has_exact_type(request, type):
            raise BadMessage(
                f"Service {name!r} takes {type_name(type)}, not {type_name(request.__class__)}."
            )
        if error := check_and_freeze(request):
            raise BadMessage(f"Service {name!r} takes {type_name(type)}: {error}.")
        return handler(request)

    def _call_external(self, name: str, request: object) -> object:
        for offers, call in self._external_services:
            if offers(strip_slash(name)):
                return call(strip_slash(name), request)
        raise UnknownName("service", name, self._services)
