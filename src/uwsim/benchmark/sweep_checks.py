"""Checks of a nest of updaters: the number of its levels, and levels without an effect."""

from __future__ import annotations

import math

from ..errors import BadSetting
from ..schema import Diagnostics, line_of
from .spec import MAX_TASK_DURATION, BenchmarkSpec
from .triggers import NeverSpec
from .updater_settings import element_of
from .updaters import (
    MAX_LEVELS,
    STILL_WATER,
    CameraNoiseUpdaterSpec,
    CurrentForceUpdaterSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SceneUpdaterSpec,
    chain,
    interval,
)

SETTERS = (CameraNoiseUpdaterSpec, SceneFogUpdaterSpec, SceneLightUpdaterSpec)
"""Updaters that set one value of the scene: of two in a nest, only the inner one has an effect."""


def check_levels(outermost: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Refuse a sweep that never ends, or a nest of them with too many levels."""
    count = 1
    for updater in chain(outermost):
        values: tuple[float, ...] = ()
        try:
            values = updater.values()
        except BadSetting as diagnostic:
            diagnostics.error(updater, str(diagnostic))
        else:
            if not values or not all(
                isinstance(value, int | float) and math.isfinite(value) for value in values
            ):
                diagnostics.error(updater, "a sweep needs at least one level, and finite values")
        count *= max(1, len(values))
        if count > MAX_LEVELS:
            diagnostics.error(updater, f"with this, there are more than {MAX_LEVELS} levels")
            return


def warn_overridden(outermost: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Say where an updater has no effect: another within it sets the same value."""
    around: list[SceneUpdaterSpec] = []
    for updater in chain(outermost):
        if isinstance(updater, SETTERS) and any(type(o) is type(updater) for o in around):
            diagnostics.warning(
                updater,
                f"<{element_of(updater)}> within another: only the inner one's values have an "
                "effect",
            )
        around.append(updater)


def warn_still_water(outermost: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Warn about levels that end before their current flows."""
    length, deepest = interval(outermost), chain(outermost)[-1]
    for updater in chain(outermost):
        if not isinstance(updater, CurrentForceUpdaterSpec) or length is None:
            continue
        if 0.0 < length + updater.settling_time <= STILL_WATER:
            diagnostics.warning(
                line_of(deepest, "interval"),
                f"<interval> {length:g} s: for {STILL_WATER:g} s after each change of the "
                "current the water is still, so such a level sees nothing of it",
            )


def warn_endless(spec: BenchmarkSpec, diagnostics: Diagnostics) -> None:
    """Warn of a level that nothing ends."""
    deepest = chain(spec.scene_updater)[-1]
    if deepest.seconds_per_level is None and isinstance(spec.stop_on, NeverSpec):
        diagnostics.warning(
            line_of(spec, "stopOn"),
            f"no interval and no <stopOn>: it ends after {MAX_TASK_DURATION:g} s, in timeout",
        )
