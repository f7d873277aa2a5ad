"""The scene updaters, one module each: they change the scene from level to level."""

from __future__ import annotations

from .arm_move_updater import ArmMoveUpdater, ArmMoveUpdaterSpec
from .bag_fog_updater import BagFogUpdater, BagFogUpdaterSpec
from .camera_noise_updater import CameraNoiseUpdaterSpec
from .current_force_updater import (
    STILL_WATER_TIME,
    CurrentForceUpdater,
    CurrentForceUpdaterSpec,
    SphericalSpec,
)
from .none import NoneSpec, NoneUpdater
from .repeat import Repeat, RepeatSpec
from .scene_fog_updater import SceneFogUpdaterSpec
from .scene_light_updater import SceneLightUpdaterSpec
from .sea_state_updater import SeaStateUpdaterSpec
from .setting_updater import SettingUpdaterSpec
from .sweep import Setter, SweepSpec, sweep_values
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
    find_steps,
    initial_level,
    interval,
    levels,
    n_levels,
    ramp_level,
    settling_time,
    swept_parameters,
)
from .water_updater import WaterUpdaterSpec

UPDATERS: dict[str, type[SceneUpdaterSpec]] = {
    "armMoveUpdater": ArmMoveUpdaterSpec,
    "bagFogUpdater": BagFogUpdaterSpec,
    "cameraNoiseUpdater": CameraNoiseUpdaterSpec,
    "currentForceUpdater": CurrentForceUpdaterSpec,
    "none": NoneSpec,
    "repeat": RepeatSpec,
    "sceneFogUpdater": SceneFogUpdaterSpec,
    "sceneLightUpdater": SceneLightUpdaterSpec,
    "u:seaStateUpdater": SeaStateUpdaterSpec,
    "u:settingUpdater": SettingUpdaterSpec,
    "u:waterUpdater": WaterUpdaterSpec,
}
"""The spec of each element, in alphabetical order."""

__all__ = [
    "MAX_LEVELS",
    "STILL_WATER_TIME",
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
    "SeaStateUpdaterSpec",
    "Setter",
    "SettingUpdaterSpec",
    "SphericalSpec",
    "SweepSpec",
    "WaterUpdaterSpec",
    "apply_level",
    "begin_level",
    "bind_updaters",
    "blend",
    "chain",
    "find_steps",
    "initial_level",
    "interval",
    "levels",
    "n_levels",
    "ramp_level",
    "settling_time",
    "sweep_values",
    "swept_parameters",
]
