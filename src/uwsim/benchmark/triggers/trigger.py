"""The base classes of triggers, which are on or off."""

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
        """Return its name in messages: ``service 'startBench'``."""
        kind = type(self).__name__.removesuffix("Spec")
        kind = kind[0].lower() + kind[1:]
        target = getattr(self, "target", None)
        return kind if target is None else f"{kind} {target!r}"

    @abc.abstractmethod
    def bind(self, world: World) -> Trigger:
        """Resolve the target in ``world``; raises UnknownName if there is none."""


class Trigger(abc.ABC):
    """A state of the world that is on or off.

    It is bound anew for every level, without state of earlier levels; read it once a step.
    """

    is_constant: ClassVar[bool] = False
    """True if the state never changes, so it is read only once."""

    @abc.abstractmethod
    def is_on(self) -> bool:
        """Return whether it is on, at the current step."""

    def close(self) -> None:  # noqa: B027 - most triggers have none
        """Release its resources (a service, a subscription)."""
