"""How the scene changes from level to level: one file an updater."""

from __future__ import annotations

from .arm_move_updater import ArmMoveUpdater, ArmMoveUpdaterSpec
from .bag_fog_updater import BagFogUpdaterSpec
from .camera_noise_updater import CameraNoiseUpdater, CameraNoiseUpdaterSpec
from .current_force_updater import CurrentForceUpdater, CurrentForceUpdaterSpec, SphericalSpec
from .none import NoneSpec, NoneUpdater
from .repeat import Repeat, RepeatSpec
from .scene_fog_updater import SceneFogUpdater, SceneFogUpdaterSpec
from .scene_light_updater import SceneLightUpdater, SceneLightUpdaterSpec
from .updater import (
    MAX_LEVELS,
    Level,
    SceneUpdater,
    SceneUpdaterSpec,
    apply_level,
    bind_updaters,
    blend,
    calm,
    chain,
    initial_level,
    interval,
    levels,
    n_levels,
    ramp_level,
    references,
    steps,
    sweep,
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
"""Element -> what a file says about it. In alphabetical order."""

__all__ = [
    "MAX_LEVELS",
    "UPDATERS",
    "ArmMoveUpdater",
    "ArmMoveUpdaterSpec",
    "BagFogUpdaterSpec",
    "CameraNoiseUpdater",
    "CameraNoiseUpdaterSpec",
    "CurrentForceUpdater",
    "CurrentForceUpdaterSpec",
    "Level",
    "NoneSpec",
    "NoneUpdater",
    "Repeat",
    "RepeatSpec",
    "SceneFogUpdater",
    "SceneFogUpdaterSpec",
    "SceneLightUpdater",
    "SceneLightUpdaterSpec",
    "SceneUpdater",
    "SceneUpdaterSpec",
    "SphericalSpec",
    "apply_level",
    "bind_updaters",
    "blend",
    "calm",
    "chain",
    "initial_level",
    "interval",
    "levels",
    "n_levels",
    "ramp_level",
    "references",
    "steps",
    "sweep",
]
