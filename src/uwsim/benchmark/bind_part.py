"""Binding a part of a benchmark (a measure, a trigger or a scene updater) to the scene."""

from __future__ import annotations

from ..world import Stage
from .measures import Measure, MeasureSpec
from .triggers import Trigger, TriggerSpec
from .updaters import SceneUpdater, SceneUpdaterSpec

Part = MeasureSpec | TriggerSpec | SceneUpdaterSpec
"""The spec of a part of a benchmark."""


def bind_part(part: Part, stage: Stage) -> Measure | Trigger | SceneUpdater:
    """Bind a scene updater to the stage, or a measure or a trigger to its world.

    Raises:
        UwsimError: a name in the spec is unknown, or the part cannot be used in this scene.
    """
    return part.bind(stage) if isinstance(part, SceneUpdaterSpec) else part.bind(stage.world)
