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
    """Topic (std_msgs/Bool)."""

    def bind(self, world: World) -> Topic:
        """Listen to the topic."""
        return Topic(world.inbox(self.target, Bool))


class Topic(Trigger):
    """What the newest message on its topic said; off until there is one."""

    def __init__(self, inbox: Inbox[Bool]) -> None:
        self._inbox = inbox
        self._is_on = False

    def is_on(self) -> bool:
        """Whether the last message was true."""
        for message in self._inbox.take():
            self._is_on = bool(message.data)
        return self._is_on

    def close(self) -> None:
        """Listen no more."""
        self._inbox.close()
