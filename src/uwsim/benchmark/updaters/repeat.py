"""repeat: an updater that repeats a level several times without a change of the scene.

.. code-block:: xml

    <repeat> <iterations>10</iterations> <interval>60</interval> </repeat>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...world import Stage
from .updater import MAX_LEVELS, SceneUpdater, SceneUpdaterSpec


@dataclass(frozen=True, kw_only=True)
class RepeatSpec(SceneUpdaterSpec):
    """A ``<repeat>`` element."""

    name: ClassVar[str] = "iteration"

    iterations: int = element(minimum=1, maximum=MAX_LEVELS)
    """The number of levels."""
    interval: float = element(exclusive_minimum=0.0)
    """The length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the indices of the iterations, from 0."""
        return tuple(float(i) for i in range(self.iterations))

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def blend(self, value: float, fraction: float) -> float:
        """Return ``value``: there is no value between the numbers of two iterations."""
        return value

    def bind(self, stage: Stage) -> Repeat:
        """Return the updater, which does not depend on the scene."""
        return Repeat()


class Repeat(SceneUpdater):
    """An updater that changes nothing."""

    def apply(self, value: float) -> None:
        """Change nothing."""
