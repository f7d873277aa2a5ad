"""armMoveUpdater: arm positions that change from level to level.

.. code-block:: xml

    <armMoveUpdater>
      <armPosition> <joint>0</joint> <joint>0.5</joint> </armPosition>
      <armPosition> <joint>1</joint> <joint>0.7</joint> </armPosition>
      <step>4</step> <interval>10</interval> <target>girona500</target>
    </armMoveUpdater>
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting, UnknownName
from ...schema import element
from ...world import Stage
from .updater import MAX_LEVELS, SceneUpdater, SceneUpdaterSpec


@dataclass(frozen=True, kw_only=True)
class ArmMoveUpdaterSpec(SceneUpdaterSpec):
    """An ``<armMoveUpdater>`` element.

    There is a level for each arm position, and ``step`` more levels, evenly spaced, between each
    position and the next. The value of a level is its number, from 0. (In the original UWSim it is
    always 1.)
    """

    name: ClassVar[str] = "armPosition"

    arm_position: tuple[tuple[float, ...], ...] = element("armPosition", item="joint")
    """The arm positions: vectors of joint positions in the order of the vehicle's joints
    [rad or m]."""
    step: int = element(minimum=0, maximum=MAX_LEVELS)
    """The number of levels between an arm position and the next."""
    interval: float = element(exclusive_minimum=0.0)
    """The length of a level [s]."""
    target: str = element(refers_to="vehicle")
    """The name of the vehicle."""

    def values(self) -> tuple[float, ...]:
        """Return the index of each level, from 0."""
        count = len(self.arm_position) + (len(self.arm_position) - 1) * self.step
        if count > MAX_LEVELS:
            raise BadSetting(f"The arm has {count} positions; expected at most {MAX_LEVELS}.")
        return tuple(float(i) for i in range(count))

    def errors(self) -> Iterator[str]:
        """Report arm positions of different lengths."""
        if len({len(joints) for joints in self.arm_position}) > 1:
            yield "every <armPosition> must have as many <joint> as the first"

    def joints(self, value: float) -> npt.NDArray[np.float64]:
        """Return the joint positions of a level, interpolated between levels, (n,) [rad or m]."""
        arm_positions = np.array(self.arm_position)  # (k, n)
        levels = np.arange(len(arm_positions)) * (self.step + 1.0)
        return np.array([np.interp(value, levels, column) for column in arm_positions.T])

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def bind(self, stage: Stage) -> ArmMoveUpdater:
        """Resolve the vehicle; raises UnknownName if there is none."""
        if self.target not in stage.vehicles:
            raise UnknownName("vehicle", self.target, stage.vehicles)
        return ArmMoveUpdater(stage, self)


class ArmMoveUpdater(SceneUpdater):
    """An updater that sets the joint positions of a vehicle."""

    def __init__(self, stage: Stage, spec: ArmMoveUpdaterSpec) -> None:
        self._stage, self._spec = stage, spec

    def apply(self, value: float) -> None:
        """Set the joints to their positions in the level with the number ``value``."""
        joints = self._spec.joints(value).tolist()
        self._stage.set_joints(self._spec.target, dict(enumerate(joints)))
