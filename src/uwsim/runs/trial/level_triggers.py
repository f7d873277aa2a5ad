"""The benchmark's startOn and stopOn, which begin and end levels.

A level runs while ``startOn`` is on and ``stopOn`` is off. ``startOn`` is never reset: most types
stay on, so the next level follows at once; a topic that says off ends the level, and the next one
waits until it says on again. ``stopOn`` is armed anew for every level, so it ends one level and no
more. The original never resets it: with the compatibility ``stop-once`` a stop that stays on keeps
every later level from beginning.
"""

from __future__ import annotations

from ...benchmark.spec import BenchmarkSpec
from ...world import World


class LevelTriggers:
    """The benchmark's start and stop triggers, read once a step."""

    def __init__(self, spec: BenchmarkSpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._stops_once = "stop-once" in world.compatibility
        self._start = spec.start_on.bind(world)
        self._stop = spec.stop_on.bind(world)

    def arm(self) -> None:
        """Forget what stopped the level before.

        The new trigger is there before the old one goes: a service is offered without a gap.
        """
        if not self._stops_once:
            before, self._stop = self._stop, self._spec.stop_on.bind(self._world)
            before.close()

    def may_begin(self) -> bool:
        """Whether a level may begin now; what was stopped is no matter, as `arm` follows."""
        start, stop = self._start.is_on(), self._stop.is_on()
        return start and not (stop and self._stops_once)

    def is_open(self) -> bool:
        """Whether the level may go on."""
        start, stop = self._start.is_on(), self._stop.is_on()
        return start and not stop

    def why_not(self, patience: float) -> str:
        """Return why no level began within ``patience`` [s of simulation time]."""
        if not self._start.is_on():
            return (
                f"its startOn ({self._spec.start_on}) did not go on within {patience:g} s of "
                "simulation time"
            )
        return (
            f"its stopOn ({self._spec.stop_on}) did not go off within {patience:g} s of simulation "
            "time, and with the compatibility stop-once it is not reset"
        )

    def close(self) -> None:
        """Remove the subscriptions and services of the triggers."""
        self._start.close()
        self._stop.close()
