"""The prelude of an independent level: the initial values, then a ramp to those of the level."""

from __future__ import annotations

from collections.abc import Iterator

from ...benchmark.updaters import Level, SceneUpdaterSpec, blend, initial_level

SETTLING_TIME = 1.0
"""The time of the prelude at the initial values, before the ramp [s of simulation time]."""
RAMP_TIME = 1.0
"""The time of the prelude in which the values change to those of the level [s of simulation
time]."""


def prelude_levels(
    updater: SceneUpdaterSpec, level: Level, timestep: float
) -> Iterator[tuple[Level, bool]]:
    """Yield the values before each step of a prelude, and whether measures are updated after it.

    Args:
        updater: the outermost updater.
        level: the level that follows.
        timestep: the length of a step [s].
    """
    initial_values = initial_level(updater)
    for _ in range(round(SETTLING_TIME / timestep)):
        yield initial_values, True
    n_steps = round(RAMP_TIME / timestep)
    for i in range(1, n_steps + 1):
        yield blend(updater, level, i / n_steps), False
