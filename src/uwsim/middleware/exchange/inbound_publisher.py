"""Messages from outside that a bridge publishes on the bus."""

from __future__ import annotations

from collections.abc import Callable

from ...bus import Bus
from ...errors import BadMessage, UwsimError
from ..log import Log


class InboundPublisher:
    """The publisher of external messages on the bus; used in the thread of the simulation.

    Args:
        bus: the bus of the simulation.
        log: the log for invalid messages.
        owner: the owner of the publishers on the bus.
        publisher_of: a function that returns the external publisher of a topic, for messages
            without a sender.
    """

    def __init__(
        self, bus: Bus, log: Log, *, owner: object, publisher_of: Callable[[str], str]
    ) -> None:
        self._bus, self._log, self._owner, self._publisher_of = bus, log, owner, publisher_of
        self._publishers: dict[str, Callable[[object], None]] = {}
        self._published_ids: set[int] = set()
        self._sender = ""  # the sender of the message that is being published

    def publish(self, topic: str, message: object, sender: str) -> None:
        """Publish a message of ``sender``, which is empty if it is not known.

        An invalid message is reported and dropped.
        """
        self._sender = sender
        try:
            if (reason := self._bus.hidden_reason(topic)) is not None:
                raise BadMessage(f"Topic {topic!r} {reason}.")
            if topic not in self._publishers:
                self._publishers[topic] = self._bus.publisher(
                    topic, type(message), owner=self._owner, report=self._report_remark
                )
            self._published_ids.add(id(message))
            self._publishers[topic](message)
        except UwsimError as error:
            text = f"a message{self._source(topic)} was refused: {error}"
            self._log.report(f"/{topic}: {text}", kind=f"refused {topic}")

    def has_published(self, message: object) -> bool:
        """Return whether a message was published since `forget_messages`."""
        return id(message) in self._published_ids

    def forget_messages(self) -> None:
        """Forget the published messages, once they are delivered."""
        self._published_ids.clear()

    def _report_remark(self, topic: str, text: str) -> None:
        self._log.report(f"/{topic}: in a message{self._source(topic)}, {text}")

    def _source(self, topic: str) -> str:
        """Return " of" and the publisher of the current message, or "" if it is not known."""
        publisher = self._sender or self._publisher_of(topic)
        return f" of {publisher}" if publisher else ""
