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

`path_view` has those of a path: ``pathError``, ``pathDirection`` and ``pathAhead``.

All are the truth; sensors are observed by ``<topicField>``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.linear import rotate
from ...world import World
from ..metrics.reference import Reference
from .path_view import SIZE, PathView

DOWN = np.array([0.0, 0.0, -1.0])
"""The direction of gravity in W."""


@dataclass(frozen=True, eq=False)
class VehicleState:
    """The state of a vehicle at one time, from which the quantities follow."""

    position: Array
    """The position of the base in L, (3,) [m]."""
    localized_from_base: Array
    """The rotation from the base to L, (3, 3)."""
    world_from_base: Array
    """The rotation from the base to W, (3, 3)."""
    twist: Array
    """The velocity over ground and the angular velocity, in base axes, (6,) [m/s, rad/s]."""
    reference_position: Array
    """The desired position in L, (3,) [m]; NaN without a reference."""
    reference_motion: Array
    """The velocity of the desired position in L, (3,) [m/s]; NaN without a reference."""
    time: float | Array
    """The simulation time [s]."""
    last_action: Array
    """The last action (n,)."""
    path: Array | None = None
    """The view of the path (`PathView.read`), (15,) [m, 1]; None without a path."""

    @staticmethod
    def read(
        world: World,
        vehicle: str,
        reference: Reference | None,
        last_action: Array,
        path: PathView | None = None,
    ) -> VehicleState:
        """Read the present state of a vehicle."""
        world_from_base = world.body(vehicle).world_from_body
        localized_from_world = world.world_from_localized.inverse()
        no_reference = np.full(3, np.nan)
        return VehicleState(
            position=rotate(localized_from_world.rotation, world_from_base.position)
            + localized_from_world.position,
            localized_from_base=(localized_from_world @ world_from_base).rotation,
            world_from_base=world_from_base.rotation,
            twist=world.twist(vehicle),
            reference_position=no_reference if reference is None else reference.position(),
            reference_motion=no_reference if reference is None else reference.velocity(),
            time=world.time,
            last_action=last_action,
            path=None if path is None else path.read(world_from_base),
        )

    @property
    def position_error(self) -> Array:
        """The desired position in base axes, (3,) [m]."""
        return to_base(self.localized_from_base, self.reference_position - self.position)

    @property
    def reference_velocity(self) -> Array:
        """The velocity of the desired position in base axes, (3,) [m/s]."""
        return to_base(self.localized_from_base, self.reference_motion)

    @property
    def gravity(self) -> Array:
        """The direction of gravity in base axes, (3,) [1]."""
        return to_base(self.world_from_base, DOWN)


def to_base(rotation: Array, vector: Array) -> Array:
    """Return ``rotation.T @ vector``, for (3, 3) and (3,)."""
    x, y, z = vector[..., 0, None], vector[..., 1, None], vector[..., 2, None]
    result: Array = rotation[..., 0, :] * x + rotation[..., 1, :] * y + rotation[..., 2, :] * z
    return result


def _path_part(start: int, stop: int) -> Read:
    """Return a function that reads a part of the view of the path."""

    def read(state: VehicleState) -> Array:
        assert state.path is not None
        return state.path[..., start:stop]

    return read


Read = Callable[[VehicleState], Array]

CHANNELS: dict[str, tuple[int | None, Read]] = {
    "positionError": (3, lambda state: state.position_error),
    "referenceVelocity": (3, lambda state: state.reference_velocity),
    "pathError": (3, _path_part(0, 3)),
    "pathDirection": (3, _path_part(3, 6)),
    "pathAhead": (SIZE - 6, _path_part(6, SIZE)),
    "position": (3, lambda state: state.position),
    "heading": (2, lambda state: state.localized_from_base[..., :2, 0]),
    "gravity": (3, lambda state: state.gravity),
    "linearVelocity": (3, lambda state: state.twist[..., :3]),
    "angularVelocity": (3, lambda state: state.twist[..., 3:]),
    "lastAction": (None, lambda state: state.last_action),
}
"""The size and the function of each quantity; None: the size of an action."""

REFERENCE_CHANNELS = ("positionError", "referenceVelocity")
"""The quantities that need a desired position."""
PATH_CHANNELS = ("pathError", "pathDirection", "pathAhead")
"""The quantities that need a path."""
