"""Services inside the process: who offers them, and a call that is answered at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from ..base.message_fields import check_and_freeze
from ..errors import BadMessage, UnknownName
from .names import is_exactly, type_name, without_slash

M = TypeVar("M")


class Services:
    """Named services; names are compared without a leading slash."""

    def __init__(self) -> None:
        self._services: dict[str, tuple[type, Callable[[Any], object]]] = {}
        self._offers: dict[str, list[Callable[[Any], object]]] = {}
        self._elsewhere: list[tuple[Callable[[str], bool], Callable[[str, Any], object]]] = []
        self.revision = 0
        """Grows when a service comes or goes."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the services offered in the process, sorted."""
        return tuple(sorted(self._services))

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service whose request class is ``type``; a later offer takes its place."""
        self._services[without_slash(name)] = (type, handler)
        self.revision += 1

    def offer(self, name: str, type: type[M], handler: Callable[[M], object]) -> Callable[[], None]:
        """Offer a service together with others: a call reaches all, the newest answers.

        Returns the way to take part no more; the last to leave withdraws the service.
        """
        handlers = self._offers.setdefault(without_slash(name), [])
        handlers.append(handler)
        self.serve(name, type, lambda request: [answer(request) for answer in list(handlers)][-1])

        def leave() -> None:
            if handler in handlers:
                handlers.remove(handler)
                if not handlers:
                    self.withdraw(name)

        return leave

    def withdraw(self, name: str) -> None:
        """Stop offering a service, if it is offered."""
        self._services.pop(without_slash(name), None)
        self.revision += 1

    def serve_elsewhere(
        self, offers: Callable[[str], bool], call: Callable[[str, Any], object]
    ) -> Callable[[], None]:
        """Have services that are not offered here looked for outside the process.

        Args:
            offers: whether a service of that name, without a leading slash, is offered there.
            call: calls it with a request, and returns its response.

        Returns:
            The way to stop it.
        """
        entry = (offers, call)
        self._elsewhere.append(entry)

        def stop() -> None:
            if entry in self._elsewhere:
                self._elsewhere.remove(entry)

        return stop

    def request_type(self, name: str) -> type | None:
        """The class of a service's requests; None if it is not offered in the process."""
        found = self._services.get(without_slash(name))
        return found[0] if found else None

    def serves(self, name: str) -> bool:
        """Whether the service is offered, here or outside the process."""
        key = without_slash(name)
        return key in self._services or any(offers(key) for offers, _ in self._elsewhere)

    def call(self, name: str, request: object) -> object:
        """Call a service now.

        Raises:
            UnknownName: it is not offered.
            BadMessage: the request is of another type, or its fields are.
        """
        if without_slash(name) not in self._services:
            return self._call_elsewhere(name, request)
        type, handler = self._services[without_slash(name)]
        if not is_exactly(request, type):
            raise BadMessage(
                f"Service {name!r} takes {type_name(type)}, not {type_name(request.__class__)}."
            )
        if wrong := check_and_freeze(request):
            raise BadMessage(f"Service {name!r} takes {type_name(type)}: {wrong}.")
        return handler(request)

    def _call_elsewhere(self, name: str, request: object) -> object:
        for offers, call in self._elsewhere:
            if offers(without_slash(name)):
                return call(without_slash(name), request)
        raise UnknownName("service", name, self._services)
