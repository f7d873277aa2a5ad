"""Checks of scene updaters: the number of levels, and updaters or levels without an effect."""

from __future__ import annotations

import math

from ..errors import BadSetting
from ..schema import Diagnostics, line_of
from .spec import MAX_TASK_DURATION, BenchmarkSpec
from .triggers import NeverSpec
from .updater_settings import updater_element
from .updaters import (
    MAX_LEVELS,
    STILL_WATER_TIME,
    CameraNoiseUpdaterSpec,
    CurrentForceUpdaterSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SceneUpdaterSpec,
    SeaStateUpdaterSpec,
    WaterUpdaterSpec,
    chain,
    interval,
)

SETTER_SPECS = (
    CameraNoiseUpdaterSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SeaStateUpdaterSpec,
    WaterUpdaterSpec,
)
"""The updaters that set one value; if two of one type are nested, the outer has no effect."""


def check_levels(root_updater: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Report sweeps that never end, invalid values, and nested updaters with too many levels."""
    count = 1
    for updater in chain(root_updater):
        values: tuple[float, ...] = ()
        try:
            values = updater.values()
        except BadSetting as error:
            diagnostics.error(updater, str(error))
        else:
            if not values or not all(
                isinstance(value, int | float) and math.isfinite(value) for value in values
            ):
                diagnostics.error(updater, "a sweep needs at least one level, and finite values")
        count *= max(1, len(values))
        if count > MAX_LEVELS:
            diagnostics.error(updater, f"there are more than {MAX_LEVELS} levels with this updater")
            return


def warn_overridden(root_updater: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Warn about an updater that has no effect because a nested updater sets the same value."""
    outer_types: list[type] = []
    for updater in chain(root_updater):
        if isinstance(updater, SETTER_SPECS) and type(updater) in outer_types:
            diagnostics.warning(
                updater,
                f"<{updater_element(updater)}> within another: only the inner one's values have an "
                "effect",
            )
        outer_types.append(type(updater))


def warn_still_water(root_updater: SceneUpdaterSpec, diagnostics: Diagnostics) -> None:
    """Warn about levels that end before their water current begins to flow."""
    length, leaf_updater = interval(root_updater), chain(root_updater)[-1]
    for updater in chain(root_updater):
        if not isinstance(updater, CurrentForceUpdaterSpec) or length is None:
            continue
        if 0.0 < length + updater.settling_time <= STILL_WATER_TIME:
            diagnostics.warning(
                line_of(leaf_updater, "interval"),
                f"<interval> {length:g} s: for {STILL_WATER_TIME:g} s after each change of the "
                "current the water is still, so such a level has no current",
            )


def warn_endless(spec: BenchmarkSpec, diagnostics: Diagnostics) -> None:
    """Warn about levels that have neither an interval nor a stop trigger."""
    leaf_updater = chain(spec.scene_updater)[-1]
    if leaf_updater.seconds_per_level is None and isinstance(spec.stop_on, NeverSpec):
        diagnostics.warning(
            line_of(spec, "stopOn"),
            f"no interval and no <stopOn>: a level ends after {MAX_TASK_DURATION:g} s, in timeout",
        )
