"""How the scene changes from level to level: one file an updater."""

from __future__ import annotations

from .camera_noise_updater import CameraNoiseUpdater, CameraNoiseUpdaterSpec
from .none import NoneSpec, NoneUpdater
from .repeat import Repeat, RepeatSpec
from .scene_fog_updater import SceneFogUpdater, SceneFogUpdaterSpec
from .scene_light_updater import SceneLightUpdater, SceneLightUpdaterSpec
from .updater import (
    Level,
    SceneUpdater,
    SceneUpdaterSpec,
    apply_level,
    bind_updaters,
    blend,
    chain,
    initial_level,
    interval,
    levels,
    n_levels,
    references,
    sweep,
)

UPDATERS: dict[str, type[SceneUpdaterSpec]] = {
    "cameraNoiseUpdater": CameraNoiseUpdaterSpec,
    "none": NoneSpec,
    "repeat": RepeatSpec,
    "sceneFogUpdater": SceneFogUpdaterSpec,
    "sceneLightUpdater": SceneLightUpdaterSpec,
}
"""Element -> what a file says about it. In alphabetical order."""

__all__ = [
    "UPDATERS",
    "CameraNoiseUpdater",
    "CameraNoiseUpdaterSpec",
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
    "apply_level",
    "bind_updaters",
    "blend",
    "chain",
    "initial_level",
    "interval",
    "levels",
    "n_levels",
    "references",
    "sweep",
]
