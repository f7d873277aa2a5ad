"""topic: a trigger that messages on a topic turn on and off.

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
    """The topic, of any type: a std_msgs/Bool turns the trigger on or off, any other message
    on."""

    def bind(self, world: World) -> Topic:
        """Subscribe to the topic."""
        return Topic(world.bus.inbox(self.target, object))


class Topic(Trigger):
    """A trigger with the state of the newest message on its topic; off before the first.

    A std_msgs/Bool sets the state to its value. A message of any other type is an event, such as
    the first image of a camera or a goal, and turns the trigger on. (The original UWSim reads only
    a Bool.)
    """

    def __init__(self, inbox: Inbox[object]) -> None:
        self._inbox = inbox
        self._is_on = False

    def is_on(self) -> bool:
        """Return whether the newest message is a true Bool, or of another type."""
        for message in self._inbox.take():
            self._is_on = bool(message.data) if isinstance(message, Bool) else True
        return self._is_on

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()
