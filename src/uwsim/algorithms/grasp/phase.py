"""One phase of a grasp: what all of them are."""

from __future__ import annotations

import abc
from typing import ClassVar

from .task import Task


class Phase(abc.ABC):
    """One state of the machine."""

    name: ClassVar[str]
    limit: ClassVar[float] = 60.0
    """Longest duration [s]."""
    late: ClassVar[str] = "retry"
    """Phase that follows when that is over."""
    looks: bool = True
    """Whether images are looked at."""

    def enter(self, task: Task) -> None:  # noqa: B027 - most have nothing to begin
        """Begin."""

    @abc.abstractmethod
    def step(self, task: Task) -> str | None:
        """Set goals; return the next phase, or None."""
