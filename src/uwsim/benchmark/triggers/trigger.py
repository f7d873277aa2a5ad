"""The base classes of triggers: conditions that start or stop a benchmark or a measure."""

from __future__ import annotations

import abc
from dataclasses import dataclass
from typing import ClassVar

from ...schema import Spec
from ...world import World


@dataclass(frozen=True, kw_only=True)
class TriggerSpec(Spec, abc.ABC):
    """A ``<startOn>`` or ``<stopOn>`` element of a benchmark file."""

    def __str__(self) -> str:
        """Return type and target for messages: ``service 'startBench'``."""
        kind = type(self).__name__.removesuffix("Spec")
        kind = kind[0].lower() + kind[1:]
        target = getattr(self, "target", None)
        return kind if target is None else f"{kind} {target!r}"

    @abc.abstractmethod
    def bind(self, world: World) -> Trigger:
        """Resolve the target in ``world``; raises UnknownName if there is none."""


class Trigger(abc.ABC):
    """A condition on the world that is on or off.

    A trigger is bound anew for every level, so it has no state of earlier levels. Read `is_on` at
    every step.
    """

    is_constant: ClassVar[bool] = False
    """True if the trigger never changes; it is then read only once."""

    @abc.abstractmethod
    def is_on(self) -> bool:
        """Return whether the trigger is on at the current step."""

    def close(self) -> None:  # noqa: B027 - most triggers have neither
        """End the trigger's service or subscription."""
