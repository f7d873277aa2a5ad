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
        """How messages name it: ``service 'startBench'``."""
        kind = type(self).__name__.removesuffix("Spec")
        kind = kind[0].lower() + kind[1:]
        target = getattr(self, "target", None)
        return kind if target is None else f"{kind} {target!r}"

    @abc.abstractmethod
    def bind(self, world: World) -> Trigger:
        """Watch ``world`` from now on; raises UnknownName for a target that is not there."""


class Trigger(abc.ABC):
    """Something in the world that is on or off.

    It is bound anew for every level, without state of earlier levels; read it once a step.
    """

    is_constant: ClassVar[bool] = False
    """Whether its state never changes, so that it is read only once."""

    @abc.abstractmethod
    def is_on(self) -> bool:
        """Whether it is on, at the current step."""

    def close(self) -> None:  # noqa: B027 - most triggers hold nothing
        """Give back what it held (a service, a subscription)."""
