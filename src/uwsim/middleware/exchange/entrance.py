"""Messages from outside that a bridge publishes on the bus."""

from __future__ import annotations

from collections.abc import Callable

from ...bus import Bus
from ...errors import BadMessage, UwsimError
from ..log import Log


class Entrance:
    """Publishes messages from outside on the bus; in the thread of the simulation.

    Args:
        bus: of the simulation.
        log: where messages that do not fit are reported.
        owner: whose publishers these are for the bus.
        publisher_of: names who publishes a topic outside, where a message does not say it.
    """

    def __init__(
        self, bus: Bus, log: Log, *, owner: object, publisher_of: Callable[[str], str]
    ) -> None:
        self._bus, self._log, self._owner, self._publisher_of = bus, log, owner, publisher_of
        self._publishers: dict[str, Callable[[object], None]] = {}
        self._published: set[int] = set()
        self._sender = ""  # of the message that is being published

    def publish(self, topic: str, message: object, by: str) -> None:
        """Publish a message of ``by``, which is empty where it is not known.

        A message that does not fit is reported and dropped.
        """
        self._sender = by
        try:
            if self._bus.is_withheld(topic):
                raise BadMessage(f"Topic {topic!r} is not for the outside.")
            if topic not in self._publishers:
                self._publishers[topic] = self._bus.publisher(
                    topic, type(message), owner=self._owner, say=self._report_remark
                )
            self._published.add(id(message))
            self._publishers[topic](message)
        except UwsimError as error:
            text = f"a message{self._source(topic)} was refused: {error}"
            self._log.say(f"/{topic}: {text}", kind=f"refused {topic}")

    def has_published(self, message: object) -> bool:
        """Whether a message has come from outside since `forget_messages`."""
        return id(message) in self._published

    def forget_messages(self) -> None:
        """Forget which messages were published: they are delivered."""
        self._published.clear()

    def _report_remark(self, topic: str, text: str) -> None:
        self._log.say(f"/{topic}: in a message{self._source(topic)}, {text}")

    def _source(self, topic: str) -> str:
        """Return "" or " of" and who has published the message that is being published."""
        publisher = self._sender or self._publisher_of(topic)
        return f" of {publisher}" if publisher else ""
