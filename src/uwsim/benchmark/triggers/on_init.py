"""onInit: a trigger that is on from the beginning.

.. code-block:: xml

    <startOn> <type>onInit</type> </startOn>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...world import World
from .trigger import Trigger, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class OnInitSpec(TriggerSpec):
    """A trigger of type ``onInit``."""

    def bind(self, world: World) -> OnInitTrigger:
        """Return the trigger, which does not depend on the world."""
        return OnInitTrigger()


class OnInitTrigger(Trigger):
    """A trigger that is always on."""

    is_constant: ClassVar[bool] = True

    def is_on(self) -> bool:
        """Return True."""
        return True
