"""Path following: how far a body strays from a path. Read, not simulated yet.

.. code-block:: xml

    <pathFollowing>
      <name>pathError</name> <target>girona500</target>
      <topic>path</topic> <from>localizedWorld</from>
    </pathFollowing>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import World
from ..not_simulated import NotSimulatedYet
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class PathFollowingSpec(MeasureSpec):
    """A ``<pathFollowing>`` element of a benchmark file."""

    is_simulated: ClassVar[bool] = False

    target: str
    """Route of the body."""
    topic: str | None = element(default=None)
    """Topic of the path (nav_msgs/Path)."""
    from_: str | None = element("from", default=None)
    """Route of the body in whose frame the path is given; None: W."""

    def bind(self, world: World) -> Measure:
        """Raise NotSimulatedYet."""
        raise NotSimulatedYet("pathFollowing")
