"""Services for the outside whose responses come at a later step."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from ...bus import Services
from ...errors import UwsimError

Take = Callable[[object, "Future[object]"], None]
"""Called with a request, and the future that is to have its response."""


class LaterAnswers:
    """Which services these are; in the thread of the simulation.

    Args:
        services: those of the bus, among which they are shown.
    """

    def __init__(self, services: Services) -> None:
        self._services = services
        self._takers: dict[str, Take] = {}

    def offer(self, name: str, type: type, take: Take) -> None:
        """Offer a service.

        Args:
            name: of the service.
            type: class of its requests.
            take: called with each of them.
        """
        self._takers[name] = take
        self._services.serve(name, type, _never_here)

    def takes(self, name: str, request: object, answer: Future[object]) -> bool:
        """Hand a request on, if it is of such a service; whether it is."""
        take = self._takers.get(name)
        if take is not None:
            take(request, answer)
        return take is not None


def pass_on(answer: Future[object], to: Future[object]) -> None:
    """Have a future have what another has, when that has it."""

    def take(done: Future[object]) -> None:
        if (error := done.exception()) is not None:
            to.set_exception(error)
        else:
            to.set_result(done.result())

    answer.add_done_callback(take)


def _never_here(request: object) -> object:
    raise UwsimError("This service is for programs outside.")
