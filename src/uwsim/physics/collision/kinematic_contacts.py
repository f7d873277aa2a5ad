"""Contacts of kinematic bodies, whose poses are set.

A vehicle without ``u:dynamics`` moves as commanded, even through walls, as in UWSim (C++). Overlaps
of its shapes with those of objects count as contacts, which exert no forces. It moves in jumps
(`uwsim.physics.kinematics.jumps`); the velocity of a jump lasts as long after it as the jump took.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from ...base.geometry import Array, Pose, quaternion_from_rotation
from ...base.numerics.linear import dot, length
from ...base.record import Record
from ...model.collision.shapes import CollisionShape
from ...world import Contact
from ..engine_model import ALL_BITS, GEOM_TYPES, OBJECT_BIT, set_size, vehicle_bit
from ..kinematics.jumps import JumpState, JumpTimes, jump_velocity


@dataclass(slots=True)
class KinematicBodyState(Record):
    """The last displacement of a kinematic body."""

    pose: Pose
    """The last recorded pose in W, the world frame."""
    previous_pose: Pose
    """The pose in W before the last displacement."""
    jumps: JumpState
    """The time of the last displacement."""


@dataclass(slots=True)
class KinematicContactsState(Record):
    """The recorded poses of kinematic bodies."""

    version: int
    """The version of the poses that were last recorded."""
    step: int
    """The number of the last step."""
    bodies: list[KinematicBodyState]
    """The last displacement of each body."""


class KinematicContacts:
    """The overlaps of the collision shapes of kinematic bodies.

    Args:
        shapes: the collision shapes by the name of their body, such as ``vehicle/0/base_link``.
        poses: functions that return the present poses of the bodies in W, by name.
        names: the scene's names of the bodies' owners, by owner: ``vehicle/0``, ``object/1``.
        version: a function that returns a number which grows whenever a pose changes.
        timestep: the length of a step [s].
    """

    def __init__(
        self,
        shapes: Mapping[str, Sequence[CollisionShape]],
        poses: Mapping[str, Callable[[], Pose]],
        names: Mapping[str, str],
        version: Callable[[], int],
        timestep: float,
    ) -> None:
        self._names, self._version = names, version
        self._bodies = [_KinematicBody(poses[name], timestep) for name in shapes]
        self._model = _build_model(shapes)
        self._data = mujoco.MjData(self._model)
        owners = [_owner(self._model.geom(i).name) for i in range(self._model.ngeom)]
        self._owners = np.array(owners)
        self._owners_with_shapes = frozenset(owners)
        self._poses: list[Pose] = []  # the poses of the bodies at the last search for contacts
        self.state = KinematicContactsState(version(), 0, [body.state for body in self._bodies])
        """The recorded poses of the bodies."""

    def record(self, step: int) -> None:
        """Record the poses of all bodies; to be called in every step."""
        self.state.step = step
        if (version := self._version()) == self.state.version:
            return
        self.state.version = version
        for body in self._bodies:
            body.record(step)

    def contacts(self, kind: str, index: int) -> list[Contact] | None:
        """Return the contacts of a vehicle or object; None if it has no collision shape."""
        owner = f"{kind}/{index}"
        if owner not in self._owners_with_shapes:
            return None
        poses = [body.pose for body in self.state.bodies]
        if not self._poses or any(a is not b for a, b in zip(poses, self._poses, strict=True)):
            self._place_shapes(poses)
        pairs = self._data.contact
        if self._data.ncon == 0:
            return []
        is_own = self._owners[pairs.geom] == owner  # (n, 2)
        contacts: list[Contact] = []
        for i in np.flatnonzero((is_own[:, 0] != is_own[:, 1]) & (pairs.dist < 0.0)).tolist():
            first_geom, second_geom = pairs.geom[i].tolist()
            normal, point = pairs.frame[i][:3], pairs.pos[i]  # from the first to the second
            v_first = dot(normal, self._velocity(first_geom, point))
            v_second = dot(normal, self._velocity(second_geom, point))
            is_first = bool(is_own[i, 0])
            contacts.append(
                Contact(
                    approach_speed=v_first - v_second,
                    own_speed=v_first if is_first else -v_second,
                    is_first=is_first,
                    other=self._names[self._owners[second_geom if is_first else first_geom]],
                )
            )
        return contacts

    def _place_shapes(self, poses: list[Pose]) -> None:
        for i, pose in enumerate(poses):
            self._data.qpos[7 * i : 7 * i + 3] = pose.position
            self._data.qpos[7 * i + 3 : 7 * i + 7] = quaternion_from_rotation(pose.rotation)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_collision(self._model, self._data)
        self._poses = poses

    def _velocity(self, geom: int, point: Array) -> Array:
        """Return the velocity in W of the body-fixed point at ``point`` in W, (3,) [m/s]."""
        body = int(self._model.geom_bodyid[geom])
        return self._bodies[body - 1].velocity(point, self.state.step)


class _KinematicBody:
    """A kinematic body, with the velocity of its last displacement."""

    def __init__(self, pose: Callable[[], Pose], timestep: float) -> None:
        self._pose, self._jumps = pose, JumpTimes(timestep, last_step=0)
        initial_pose = pose()
        self.state = KinematicBodyState(initial_pose, initial_pose, self._jumps.state)

    def record(self, step: int) -> None:
        pose, state = self._pose(), self.state
        is_same_position = np.array_equal(pose.position, state.pose.position)
        if not is_same_position or not np.array_equal(pose.rotation, state.pose.rotation):
            state.previous_pose, state.pose = state.pose, pose
            self._jumps.add(step)

    def velocity(self, point: Array, step: int) -> Array:
        """Return the velocity in W of the body-fixed point at ``point`` in W, (3,) [m/s]."""
        if self._jumps.age(step) >= self._jumps.n_steps:
            return np.zeros(3)
        start = (self.state.previous_pose @ self.state.pose.inverse()).transform(point[None])[0]
        velocity: Array = (point - start) / self._jumps.duration
        return jump_velocity(velocity, length(velocity))


def _build_model(shapes: Mapping[str, Sequence[CollisionShape]]) -> mujoco.MjModel:
    """Build an engine model with a free body for each name, in the order of the names."""
    spec = mujoco.MjSpec()
    for name, parts in shapes.items():
        body = spec.worldbody.add_body(name=name, mass=1.0, inertia=[1.0] * 3)
        body.explicitinertial = True
        body.add_freejoint()
        kind, owner = name.split("/")[:2]
        bit = OBJECT_BIT if kind == "object" else vehicle_bit(int(owner))
        for i, shape in enumerate(parts):
            body_from_shape = shape.body_from_shape
            geom = body.add_geom(
                name=f"{name}/shape/{i}",
                type=GEOM_TYPES[shape.kind],
                pos=body_from_shape.position.tolist(),
                quat=quaternion_from_rotation(body_from_shape.rotation).tolist(),
                contype=bit,
                conaffinity=ALL_BITS & ~bit,
            )
            set_size(spec, geom, f"{name}/{i}", shape)
    return spec.compile()


def _owner(name: str) -> str:
    """Return the owner of the body or shape with a name, such as ``vehicle/1`` or ``object/1``."""
    return "/".join(name.split("/")[:2])
