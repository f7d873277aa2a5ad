"""Time: how long the measure was on.

.. code-block:: xml

    <time>
      <name>taskTime</name>
      <startOn> <type>onMove</type> <target>girona500</target> </startOn>
      <stopOn> <type>service</type> <target>stopBench</target> </stopOn>
    </time>
"""

from __future__ import annotations

from dataclasses import dataclass

from ...world import World
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class TimeSpec(MeasureSpec):
    """A ``<time>`` element of a benchmark file."""

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return 0.0

    def bind(self, world: World) -> Time:
        """Watch the clock of ``world``."""
        return Time(world)


class Time(Measure):
    """Simulation time from the step at which the measure goes on to that at which it goes off.

    Without that, to the last step of the level. What passes while it is off does not count; it
    adds up when the measure goes on again. Never wall time.

    Compatibility ``time-log``: it is 0 until it goes off or the level ends. ``restart``: when it
    goes on again it begins anew.
    """

    unit = "s"

    def __init__(self, world: World) -> None:
        self._world = world
        self._last: int | None = None  # step
        self._steps = 0
        self._is_known = True  # whether it can be read now
        self._is_known_late = "time-log" in world.compatibility
        self._begins_anew = "restart" in world.compatibility

    def start(self) -> None:
        """Count from now."""
        self._last = self._world.step
        self._is_known = not self._is_known_late
        if self._begins_anew:
            self._steps = 0

    def update(self) -> None:
        """Add what has passed since the last look."""
        if self._last is not None:
            self._steps += self._world.step - self._last
        self._last = self._world.step

    def went_off(self) -> None:
        """Add the step in which it went off."""
        self.update()
        self._is_known = True

    @property
    def value(self) -> float | None:
        """Time so far [s]; None when the measure was never on."""
        if self._last is None:
            return None
        return self._steps * self._world.timestep if self._is_known else 0.0
