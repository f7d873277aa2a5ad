"""The base class of the phases of a grasp (`phases`)."""

from __future__ import annotations

import abc
from typing import ClassVar

from .task import Task


class Phase(abc.ABC):
    """A phase of a grasp: a state of the state machine."""

    name: ClassVar[str]
    """The name that is published as the phase."""
    limit: ClassVar[float] = 60.0
    """The longest duration of the phase [s]."""
    timeout_phase: ClassVar[str] = "retry"
    """The name of the phase that follows when `limit` is exceeded."""
    uses_images: bool = True
    """True if the perception reads images during the phase."""

    def enter(self, task: Task) -> None:  # noqa: B027 - most have no start
        """Start the phase."""

    @abc.abstractmethod
    def step(self, task: Task) -> str | None:
        """Set the goals of the vehicle, once every control period.

        Returns:
            The name of the next phase; None to stay in this phase.
        """
