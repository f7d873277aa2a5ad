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
        """The value that the original UWSim reports before the measure stops [s]."""
        return 0.0

    def bind(self, world: World) -> Time:
        """Create the measure on the clock of ``world``."""
        return Time(world)


class Time(Measure):
    """The simulation time from the step at which the measure starts to the one at which it stops.

    If the measure does not stop, the time lasts to the last step of the level. If it is active
    several times, the durations are added. Wall-clock time is never used.

    Compatibility ``time-log``: the value is 0 until the measure stops or the level ends.
    ``restart``: the time begins at 0 when the measure becomes active again.
    """

    unit = "s"

    def __init__(self, world: World) -> None:
        self._world = world
        self._last_step: int | None = None  # step of the last update
        self._n_steps = 0  # steps while the measure was active
        self._is_known = True  # False: the value is 0 until the measure stops
        self._is_known_at_end = "time-log" in world.compatibility
        self._is_reset = "restart" in world.compatibility

    def start(self) -> None:
        """Begin at the present step."""
        self._last_step = self._world.step
        self._is_known = not self._is_known_at_end
        if self._is_reset:
            self._n_steps = 0

    def update(self) -> None:
        """Add the time since the last update."""
        if self._last_step is not None:
            self._n_steps += self._world.step - self._last_step
        self._last_step = self._world.step

    def stop(self) -> None:
        """Add the step at which the measure stopped."""
        self.update()
        self._is_known = True

    @property
    def value(self) -> float | None:
        """The time so far [s]; None if the measure was never active."""
        if self._last_step is None:
            return None
        return self._n_steps * self._world.timestep if self._is_known else 0.0
