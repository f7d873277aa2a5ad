"""The binding of any part of a benchmark: a measure, a trigger or a scene updater."""

from __future__ import annotations

from ..world import Stage
from .measures import Measure, MeasureSpec
from .triggers import Trigger, TriggerSpec
from .updaters import SceneUpdater, SceneUpdaterSpec

Part = MeasureSpec | TriggerSpec | SceneUpdaterSpec


def bind_part(part: Part, stage: Stage) -> Measure | Trigger | SceneUpdater:
    """Bind a scene updater to the stage, or a measure or a trigger to its world.

    Raises:
        UwsimError: a name of the part is unknown.
    """
    return part.bind(stage) if isinstance(part, SceneUpdaterSpec) else part.bind(stage.world)
