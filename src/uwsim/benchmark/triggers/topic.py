"""topic: on and off by the messages of a topic.

.. code-block:: xml

    <startOn> <type>topic</type> <target>/valveReached</target> </startOn>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.inbox import Inbox
from ...messages import Bool
from ...world import World
from .trigger import Trigger, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class TopicSpec(TriggerSpec):
    """A trigger of type ``topic``."""

    target: str
    """The topic, of any type: a std_msgs/Bool means on or off, any other message on."""

    def bind(self, world: World) -> Topic:
        """Subscribe to the topic."""
        return Topic(world.bus.inbox(self.target, object))


class Topic(Trigger):
    """A trigger with the state of the newest message on its topic; off before the first.

    A std_msgs/Bool sets the state to its value. A message of any other type is an event, such as
    the first image of a camera or a goal, and sets it on. (The original reads a Bool only.)
    """

    def __init__(self, inbox: Inbox[object]) -> None:
        self._inbox = inbox
        self._is_on = False

    def is_on(self) -> bool:
        """Return whether the last message was true, or not a Bool."""
        for message in self._inbox.take():
            self._is_on = bool(message.data) if isinstance(message, Bool) else True
        return self._is_on

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()
