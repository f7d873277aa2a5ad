"""The desired position of a body in a scene: a trajectory, in L or relative to a vehicle."""

from __future__ import annotations

from ...base.geometry import Array
from ...base.numerics.linear import rotate
from ...world import World
from ..reference_trajectory import TrajectorySpec


class Reference:
    """The desired position and its velocity at the present time.

    Args:
        trajectory: the places at each time.
        world: the scene.
        relative_to: the vehicle from whose position the places are offsets; None: they are
            positions in L.

    Raises:
        UnknownName: there is no such vehicle.
    """

    def __init__(
        self, trajectory: TrajectorySpec, world: World, *, relative_to: str | None = None
    ) -> None:
        self._trajectory, self._world, self._leader = trajectory, world, relative_to
        self._localized_from_world = world.world_from_localized.inverse()
        self._leader_body = None if relative_to is None else world.body(relative_to)

    def position(self) -> Array:
        """Return the desired position in L, (3,) [m]."""
        place = self._trajectory.position(self._world.time)
        if self._leader_body is None:
            return place
        frame = self._localized_from_world
        leader = rotate(frame.rotation, self._leader_body.world_from_body.position)
        position: Array = leader + frame.position + place
        return position

    def velocity(self) -> Array:
        """Return the velocity of the desired position in L, (3,) [m/s]."""
        velocity = self._trajectory.velocity(self._world.time)
        if self._leader is None or self._leader_body is None:
            return velocity
        localized_from_base = self._localized_from_world @ self._leader_body.world_from_body
        leader_velocity = rotate(localized_from_base.rotation, self._world.twist(self._leader)[:3])
        total: Array = velocity + leader_velocity
        return total
