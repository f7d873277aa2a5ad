"""The scene updaters, one module each: how the scene changes from level to level."""

from __future__ import annotations

from .arm_move_updater import ArmMoveUpdater, ArmMoveUpdaterSpec
from .bag_fog_updater import BagFogUpdater, BagFogUpdaterSpec
from .camera_noise_updater import CameraNoiseUpdaterSpec
from .current_force_updater import (
    STILL_WATER,
    CurrentForceUpdater,
    CurrentForceUpdaterSpec,
    SphericalSpec,
)
from .none import NoneSpec, NoneUpdater
from .repeat import Repeat, RepeatSpec
from .scene_fog_updater import SceneFogUpdaterSpec
from .scene_light_updater import SceneLightUpdaterSpec
from .sweep import Setter, SweepSpec, sweep
from .updater import (
    MAX_LEVELS,
    Level,
    SceneUpdater,
    SceneUpdaterSpec,
    apply_level,
    begin_level,
    bind_updaters,
    blend,
    chain,
    initial_level,
    interval,
    levels,
    n_levels,
    ramp_level,
    settling_time,
    steps,
    swept_parameters,
)

UPDATERS: dict[str, type[SceneUpdaterSpec]] = {
    "armMoveUpdater": ArmMoveUpdaterSpec,
    "bagFogUpdater": BagFogUpdaterSpec,
    "cameraNoiseUpdater": CameraNoiseUpdaterSpec,
    "currentForceUpdater": CurrentForceUpdaterSpec,
    "none": NoneSpec,
    "repeat": RepeatSpec,
    "sceneFogUpdater": SceneFogUpdaterSpec,
    "sceneLightUpdater": SceneLightUpdaterSpec,
}
"""Element name -> spec. In alphabetical order."""

__all__ = [
    "MAX_LEVELS",
    "STILL_WATER",
    "UPDATERS",
    "ArmMoveUpdater",
    "ArmMoveUpdaterSpec",
    "BagFogUpdater",
    "BagFogUpdaterSpec",
    "CameraNoiseUpdaterSpec",
    "CurrentForceUpdater",
    "CurrentForceUpdaterSpec",
    "Level",
    "NoneSpec",
    "NoneUpdater",
    "Repeat",
    "RepeatSpec",
    "SceneFogUpdaterSpec",
    "SceneLightUpdaterSpec",
    "SceneUpdater",
    "SceneUpdaterSpec",
    "Setter",
    "SphericalSpec",
    "SweepSpec",
    "apply_level",
    "begin_level",
    "bind_updaters",
    "blend",
    "chain",
    "initial_level",
    "interval",
    "levels",
    "n_levels",
    "ramp_level",
    "settling_time",
    "steps",
    "sweep",
    "swept_parameters",
]
