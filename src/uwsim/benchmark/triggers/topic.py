"""topic: on and off as given by a topic.

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
    """Topic, of any type: a std_msgs/Bool means on or off, any other message on."""

    def bind(self, world: World) -> Topic:
        """Listen to the topic."""
        return Topic(world.bus.inbox(self.target, object))


class Topic(Trigger):
    """The state given by the newest message on its topic; off until there is one.

    A std_msgs/Bool sets the state to its value. A message of any other type is an event, such as
    the first image of a camera or a goal, and sets it on. (The original reads a Bool only.)
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
        """Unsubscribe."""
        self._inbox.close()
