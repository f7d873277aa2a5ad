"""The triggers, one module each: they start and stop a benchmark and its measures."""

from __future__ import annotations

from .never import NeverSpec, NeverTrigger
from .on_init import OnInitSpec, OnInitTrigger
from .on_move import OnMove, OnMoveSpec
from .on_no_move import OnNoMove, OnNoMoveSpec
from .position import Position, PositionSpec
from .service import Service, ServiceSpec
from .topic import Topic, TopicSpec
from .trigger import Trigger, TriggerSpec

TRIGGERS: dict[str, type[TriggerSpec]] = {
    "never": NeverSpec,
    "onInit": OnInitSpec,
    "onMove": OnMoveSpec,
    "onNoMove": OnNoMoveSpec,
    "position": PositionSpec,
    "service": ServiceSpec,
    "topic": TopicSpec,
}
"""The spec of each ``<type>`` of trigger, in alphabetical order."""

__all__ = [
    "TRIGGERS",
    "NeverSpec",
    "NeverTrigger",
    "OnInitSpec",
    "OnInitTrigger",
    "OnMove",
    "OnMoveSpec",
    "OnNoMove",
    "OnNoMoveSpec",
    "Position",
    "PositionSpec",
    "Service",
    "ServiceSpec",
    "Topic",
    "TopicSpec",
    "Trigger",
    "TriggerSpec",
]
