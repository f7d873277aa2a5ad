"""Time: the duration for which the measure is active.

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
        """Create the measure on the clock of ``world``."""
        return Time(world)


class Time(Measure):
    """The simulation time from the step at which the measure starts to that at which it stops.

    Without a stop it is the time to the last step of the level. The times of several activations
    are added. It is never wall time.

    Compatibility ``time-log``: it is 0 until it stops or the level ends. ``restart``: it is reset
    when it becomes active again.
    """

    unit = "s"

    def __init__(self, world: World) -> None:
        self._world = world
        self._last_step: int | None = None  # step
        self._n_steps = 0
        self._is_known = True  # whether it can be read now
        self._is_known_at_end = "time-log" in world.compatibility
        self._is_reset = "restart" in world.compatibility

    def start(self) -> None:
        """Begin at the present step."""
        self._last_step = self._world.step
        self._is_known = not self._is_known_at_end
        if self._is_reset:
            self._n_steps = 0

    def update(self) -> None:
        """Add the time since the last call."""
        if self._last_step is not None:
            self._n_steps += self._world.step - self._last_step
        self._last_step = self._world.step

    def went_off(self) -> None:
        """Add the step in which the measure stopped."""
        self.update()
        self._is_known = True

    @property
    def value(self) -> float | None:
        """The time so far [s]; None if the measure was never active."""
        if self._last_step is None:
            return None
        return self._n_steps * self._world.timestep if self._is_known else 0.0
