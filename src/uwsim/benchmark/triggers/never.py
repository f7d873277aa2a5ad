"""never: a trigger that is always off.

.. code-block:: xml

    <stopOn> <type>never</type> </stopOn>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...world import World
from .trigger import Trigger, TriggerSpec


@dataclass(frozen=True, kw_only=True)
class NeverSpec(TriggerSpec):
    """A trigger of type ``never``."""

    def bind(self, world: World) -> NeverTrigger:
        """Return the trigger, which does not depend on the world."""
        return NeverTrigger()


class NeverTrigger(Trigger):
    """A trigger that is always off."""

    is_constant: ClassVar[bool] = True

    def is_on(self) -> bool:
        """Return False."""
        return False
