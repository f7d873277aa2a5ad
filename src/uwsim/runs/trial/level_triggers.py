"""The benchmark's triggers startOn and stopOn, which begin and end levels.

A level runs while ``startOn`` is on and ``stopOn`` is off. ``startOn`` is never reset: most types
stay on, so the next level follows at once; a message ``off`` on a topic ends the level, and the
next one waits for ``on``. ``stopOn`` is reset for every level, so it ends one level only. The
original UWSim never resets it: with the compatibility ``stop-once``, a ``stopOn`` that stays on
prevents every later level.
"""

from __future__ import annotations

from ...benchmark.spec import BenchmarkSpec
from ...world import World


class LevelTriggers:
    """The start and stop triggers of a benchmark, which are read once in each step."""

    def __init__(self, spec: BenchmarkSpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._stops_once = "stop-once" in world.compatibility
        self._start = spec.start_on.bind(world)
        self._stop = spec.stop_on.bind(world)

    def arm(self) -> None:
        """Reset the stop trigger.

        The new trigger is bound before the old one is closed, so that a service of the trigger is
        advertised without interruption.
        """
        if not self._stops_once:
            old_stop, self._stop = self._stop, self._spec.stop_on.bind(self._world)
            old_stop.close()

    def may_begin(self) -> bool:
        """Return whether a level may begin now; the stop trigger counts with ``stop-once`` only."""
        start, stop = self._start.is_on(), self._stop.is_on()
        return start and not (stop and self._stops_once)

    def is_open(self) -> bool:
        """Return whether the level may continue."""
        start, stop = self._start.is_on(), self._stop.is_on()
        return start and not stop

    def describe_wait(self, timeout: float) -> str:
        """Return the reason why no level began within ``timeout`` [s of simulation time]."""
        if not self._start.is_on():
            return (
                f"its startOn ({self._spec.start_on}) did not go on within {timeout:g} s of "
                "simulation time"
            )
        return (
            f"its stopOn ({self._spec.stop_on}) did not go off within {timeout:g} s of simulation "
            "time, and with the compatibility stop-once it is not reset"
        )

    def close(self) -> None:
        """Remove the subscriptions and services of the triggers."""
        self._start.close()
        self._stop.close()
