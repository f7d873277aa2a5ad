"""u:ROSToWinch: the speed at which the winch of a tether pays out, from a topic.

.. code-block:: xml

    <u:ROSToWinch> <name>tether</name> <topic>/winch</topic> </u:ROSToWinch>

The message is a std_msgs/Float64: the speed [m/s], positive to pay out, negative to haul in. It is
held until the next message; the limits of the winch apply. A message that is not finite is ignored.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ...base.external_values import MAX_COMMAND
from ...base.message_fields import find_invalid_number
from ...errors import UnknownName
from ...messages import Float64
from ...world import TetherControl
from ..interface import Interface, InterfaceSpec, TopicWorld


@dataclass(frozen=True, kw_only=True)
class ROSToWinchSpec(InterfaceSpec):
    """A subscription to the speed of a tether's winch as std_msgs/Float64."""

    subscribes: ClassVar[bool] = True
    sources: ClassVar[tuple[str, ...]] = ("u:tether",)
    messages: ClassVar[Mapping[str, type]] = {"topic": Float64}

    name: str
    """The name of the tether; it has a ``<winch>``."""
    topic: str
    """The name of the topic."""

    def bind(self, world: TopicWorld) -> WinchCommand:
        """Start to subscribe; raise UnknownName if no tether of this name has a winch."""
        tether = world.tether(self.name)
        if not tether.has_winch:
            raise UnknownName("tether with a winch", self.name, ())
        command = WinchCommand(tether)
        world.bus.subscribe(
            self.topic,
            Float64,
            world.defer_to_next_step(command.apply_command),
            remark=lambda message: find_invalid_number(message, ("data",), MAX_COMMAND),
        )
        return command


class WinchCommand(Interface):
    """The application of commands to a winch."""

    def __init__(self, tether: TetherControl) -> None:
        self._tether = tether

    def apply_command(self, message: Float64) -> None:
        """Set the speed of the winch; ignore a number that is not finite."""
        if math.isfinite(message.data):
            self._tether.set_winch_speed(message.data)
