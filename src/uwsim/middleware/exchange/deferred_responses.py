"""Services for external programs whose responses come at a later step."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from ...bus import Services
from ...errors import UwsimError

RequestHandler = Callable[[object, "Future[object]"], None]
"""A function that is called with a request, and with the future of its response."""


class DeferredResponses:
    """The services with deferred responses; used in the thread of the simulation.

    Args:
        services: the services of the bus, to which the services are added.
    """

    def __init__(self, services: Services) -> None:
        self._services = services
        self._handlers: dict[str, RequestHandler] = {}

    def offer(self, name: str, type: type, handler: RequestHandler) -> None:
        """Offer a service.

        Args:
            name: the name of the service.
            type: the class of the requests.
            handler: the function that is called with each request.
        """
        self._handlers[name] = handler
        self._services.serve(name, type, _refuse_local_call)

    def defer(self, name: str, request: object, response: Future[object]) -> bool:
        """Pass a request to the handler of its service; return False if the service has none."""
        handler = self._handlers.get(name)
        if handler is not None:
            handler(request, response)
        return handler is not None


def forward_result(source: Future[object], target: Future[object]) -> None:
    """Set the result or exception of ``source`` on ``target``, as soon as ``source`` has it."""

    def copy_result(future: Future[object]) -> None:
        if (error := future.exception()) is not None:
            target.set_exception(error)
        else:
            target.set_result(future.result())

    source.add_done_callback(copy_result)


def _refuse_local_call(request: object) -> object:
    raise UwsimError("This service is for external programs.")
