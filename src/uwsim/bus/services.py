"""Services inside the process; a call returns the response at once."""

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
        """The number of times that a service was offered or withdrawn."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the services offered in the process, sorted."""
        return tuple(sorted(self._services))

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service whose request class is ``type``; a later offer replaces it."""
        self._services[strip_slash(name)] = (type, handler)
        self.revision += 1

    def offer(self, name: str, type: type[M], handler: Callable[[M], object]) -> Callable[[], None]:
        """Add a handler to a service that may have several; the newest one's response is returned.

        A call reaches all handlers. Returns a function that removes this handler; the service is
        withdrawn when its last handler is removed.
        """
        handlers = self._offers.setdefault(strip_slash(name), [])
        handlers.append(handler)
        self.serve(name, type, lambda request: [handle(request) for handle in list(handlers)][-1])

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
        """Add services outside the process, for names that are not offered inside.

        Args:
            is_offered: a function that returns whether a service is offered outside; its name has
                no leading slash.
            call: a function that calls a service, by its name, with a request and returns the
                response.

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
        """Return the class of a service's requests; None if it is not offered inside."""
        entry = self._services.get(strip_slash(name))
        return entry[0] if entry else None

    def is_offered(self, name: str) -> bool:
        """Return whether a service is offered, inside or outside the process."""
        key = strip_slash(name)
        return key in self._services or any(
            is_offered(key) for is_offered, _ in self._external_services
        )

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
        for is_offered, call in self._external_services:
            if is_offered(strip_slash(name)):
                return call(strip_slash(name), request)
        raise UnknownName("service", name, self._services)
