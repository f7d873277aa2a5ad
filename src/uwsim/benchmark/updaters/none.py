"""none: an updater that does not change the scene.

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
        """Return the value of the only level, which is 1 as in the original UWSim."""
        return (1.0,)

    def bind(self, stage: Stage) -> NoneUpdater:
        """Return the updater, which does not depend on the scene."""
        return NoneUpdater()


class NoneUpdater(SceneUpdater):
    """An updater that changes nothing."""

    def apply(self, value: float) -> None:
        """Change nothing."""
