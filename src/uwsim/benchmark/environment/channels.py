r"""The observed quantities of a vehicle's state: the names in ``<observation>``.

With the pose of the base :math:`R, p` in L, its velocity :math:`v` and angular velocity
:math:`\omega` in base axes, and the desired position :math:`q(t)` in L:

===================  =========================================================================
positionError        :math:`R^T (q - p)`, the desired position in base axes (3) [m]
referenceVelocity    :math:`R^T \dot q`, the velocity of the desired position, base axes (3) [m/s]
position             :math:`p` in L (3) [m]
heading              the x and y components of the bow's direction :math:`R e_x` in L (2) [1]
gravity              the direction of gravity in base axes (3) [1]
linearVelocity       :math:`v` over ground, in base axes (3) [m/s]
angularVelocity      :math:`\omega`, in base axes (3) [rad/s]
lastAction           the last action, 0 before the first (n) [1]
===================  =========================================================================

All are the truth; sensors are observed by ``<topicField>``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate_back
from ...world import World
from ..reference_trajectory import TrajectorySpec

DOWN = np.array([0.0, 0.0, -1.0])
"""The direction of gravity in W."""


@dataclass(frozen=True, eq=False)
class VehicleState:
    """The state of a vehicle at one time, from which the quantities follow."""

    localized_from_base: Pose
    """The pose of the base in L."""
    world_from_base: Pose
    """The pose of the base in W."""
    twist: Array
    """The velocity over ground and the angular velocity, in base axes, (6,) [m/s, rad/s]."""
    trajectory: TrajectorySpec | None
    """The desired position at each time; None without a reference."""
    time: float
    """The simulation time [s]."""
    last_action: Array
    """The last action (n,)."""

    @staticmethod
    def read(
        world: World, vehicle: str, trajectory: TrajectorySpec | None, last_action: Array
    ) -> VehicleState:
        """Read the present state of a vehicle."""
        world_from_base = world.body(vehicle).world_from_body
        return VehicleState(
            localized_from_base=world.world_from_localized.inverse() @ world_from_base,
            world_from_base=world_from_base,
            twist=world.twist(vehicle),
            trajectory=trajectory,
            time=world.time,
            last_action=last_action,
        )

    @property
    def position_error(self) -> Array:
        """The desired position in base axes, (3,) [m]."""
        assert self.trajectory is not None
        pose = self.localized_from_base
        return rotate_back(pose.rotation, self.trajectory.position(self.time) - pose.position)

    @property
    def reference_velocity(self) -> Array:
        """The velocity of the desired position in base axes, (3,) [m/s]."""
        assert self.trajectory is not None
        velocity = self.trajectory.velocity(self.time)
        return rotate_back(self.localized_from_base.rotation, velocity)

    @property
    def gravity(self) -> Array:
        """The direction of gravity in base axes, (3,) [1]."""
        return rotate_back(self.world_from_base.rotation, DOWN)


Read = Callable[[VehicleState], Array]

CHANNELS: dict[str, tuple[int | None, Read]] = {
    "positionError": (3, lambda state: state.position_error),
    "referenceVelocity": (3, lambda state: state.reference_velocity),
    "position": (3, lambda state: state.localized_from_base.position),
    "heading": (2, lambda state: state.localized_from_base.rotation[:2, 0]),
    "gravity": (3, lambda state: state.gravity),
    "linearVelocity": (3, lambda state: state.twist[:3]),
    "angularVelocity": (3, lambda state: state.twist[3:]),
    "lastAction": (None, lambda state: state.last_action),
}
"""The size and the function of each quantity; None: the size of an action."""

REFERENCE_CHANNELS = ("positionError", "referenceVelocity")
"""The quantities that need a reference."""
