"""none: the scene stays as it is.

.. code-block:: xml

    <sceneUpdater> <none/> </sceneUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...world import Stage
from .updater import SceneUpdater, SceneUpdaterSpec


@dataclass(frozen=True, kw_only=True)
class NoneSpec(SceneUpdaterSpec):
    """A ``<none>`` element: one level, which lasts until ``stopOn``."""

    name: ClassVar[str] = "none"

    def values(self) -> tuple[float, ...]:
        """One level, called 1 as in the original."""
        return (1.0,)

    def bind(self, stage: Stage) -> NoneUpdater:
        """Needs nothing of the scene."""
        return NoneUpdater()


class NoneUpdater(SceneUpdater):
    """Changes nothing."""

    def apply(self, value: float) -> None:
        """Change nothing."""
