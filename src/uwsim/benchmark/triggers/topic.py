"""topic: on and off as a topic says.

.. code-block:: xml

    <startOn> <type>topic</type> <target>/valveReached</target> </startOn>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...bus import Inbox
from ...messages import Bool
from ...world import World
from .trigger import Trigger, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class TopicSpec(TriggerSpec):
    """A trigger of type ``topic``."""

    target: str
    """Topic, of any type: a std_msgs/Bool says on or off, any other message on."""

    def bind(self, world: World) -> Topic:
        """Listen to the topic."""
        return Topic(world.bus.inbox(self.target, object))


class Topic(Trigger):
    """What the newest message on its topic said; off until there is one.

    A std_msgs/Bool says what it holds. A message of any other type is an event, such as the first
    image of a camera or a goal that was sent: it says on. (The original reads a Bool only.)
    """

    def __init__(self, inbox: Inbox[object]) -> None:
        self._inbox = inbox
        self._is_on = False

    def is_on(self) -> bool:
        """Whether the last message was true, or no Bool."""
        for message in self._inbox.take():
            self._is_on = bool(message.data) if isinstance(message, Bool) else True
        return self._is_on

    def close(self) -> None:
        """Listen no more."""
        self._inbox.close()
