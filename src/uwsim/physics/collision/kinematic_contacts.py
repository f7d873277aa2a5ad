"""Contacts of kinematic bodies, which have poses instead of forces.

A vehicle without ``u:dynamics`` moves as commanded, even through walls, as in the
original. Its shapes are laid over those of the objects wherever it is; nothing is pushed. It moves
in jumps (`uwsim.physics.kinematics.jumps`); the speed of one is that of as much time after it.
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
from ..engine_model import ALL, OBJECTS, SHAPES, give_form
from ..kinematics.jumps import JumpState, JumpTimes, without_placement


@dataclass(slots=True)
class KinematicBodyState(Record):
    """The last displacement of a kinematic body."""

    now: Pose
    """Where it is."""
    before: Pose
    """Where it was before its last displacement."""
    jumps: JumpState
    """When it was displaced."""


@dataclass(slots=True)
class KinematicContactsState(Record):
    """What is known of the bodies that overlap."""

    seen: int
    """The version of the poses that were last recorded."""
    step: int
    """The step at which they were recorded."""
    bodies: list[KinematicBodyState]
    """The displacements of the bodies."""


class KinematicContacts:
    """Overlaps of the collision shapes of kinematic bodies.

    Args:
        shapes: what can be touched, by the name of its body: ``vehicle/0/base_link``, ``object/1``.
        poses: where the bodies are now, by name.
        names: what the scene calls the owners of bodies: ``vehicle/0``, ``object/1``.
        version: grows whenever something was moved.
        timestep: length of a step [s].
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
        self._model = _model(shapes)
        self._data = mujoco.MjData(self._model)
        owners = [_owner(self._model.geom(i).name) for i in range(self._model.ngeom)]
        self._owners = np.array(owners)
        self._touchable = frozenset(owners)
        self._laid: list[Pose] = []  # where the bodies were when their shapes were laid
        self.state = KinematicContactsState(version(), 0, [body.state for body in self._bodies])
        """What is known of the bodies."""

    def record(self, step: int) -> None:
        """Record the poses of all bodies; to be called at every step."""
        self.state.step = step
        if (version := self._version()) == self.state.seen:
            return
        self.state.seen = version
        for body in self._bodies:
            body.record(step)

    def contacts(self, kind: str, index: int) -> list[Contact] | None:
        """Where a vehicle or object touches others; None if it has no shape to be touched."""
        owner = f"{kind}/{index}"
        if owner not in self._touchable:
            return None
        places = [body.now for body in self.state.bodies]
        if not self._laid or any(a is not b for a, b in zip(places, self._laid, strict=True)):
            self._lay(places)
        found = self._data.contact
        if self._data.ncon == 0:
            return []
        own = self._owners[found.geom] == owner  # (n, 2)
        contacts: list[Contact] = []
        for i in np.flatnonzero((own[:, 0] != own[:, 1]) & (found.dist < 0.0)).tolist():
            first, second = found.geom[i].tolist()
            normal, point = found.frame[i][:3], found.pos[i]  # from the first to the second
            v_first = dot(normal, self._velocity(first, point))
            v_second = dot(normal, self._velocity(second, point))
            is_first = bool(own[i, 0])
            contacts.append(
                Contact(
                    approach_speed=v_first - v_second,
                    own_speed=v_first if is_first else -v_second,
                    is_first=is_first,
                    other=self._names[self._owners[second if is_first else first]],
                )
            )
        return contacts

    def _lay(self, places: list[Pose]) -> None:
        for i, place in enumerate(places):
            self._data.qpos[7 * i : 7 * i + 3] = place.position
            self._data.qpos[7 * i + 3 : 7 * i + 7] = quaternion_from_rotation(place.rotation)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_collision(self._model, self._data)
        self._laid = places

    def _velocity(self, geom: int, point: Array) -> Array:
        """Velocity of a body's point, W, (3,) [m/s]."""
        body = int(self._model.geom_bodyid[geom])
        return self._bodies[body - 1].velocity(point, self.state.step)


class _KinematicBody:
    """A kinematic body, with the velocity of its last displacement."""

    def __init__(self, pose: Callable[[], Pose], timestep: float) -> None:
        self._pose, self._jumps = pose, JumpTimes(timestep, last=0)
        here = pose()
        self.state = KinematicBodyState(here, here, self._jumps.state)

    def record(self, step: int) -> None:
        """Record its pose."""
        pose, state = self._pose(), self.state
        is_there = np.array_equal(pose.position, state.now.position)
        if not is_there or not np.array_equal(pose.rotation, state.now.rotation):
            state.before, state.now = state.now, pose
            self._jumps.add(step)

    def velocity(self, point: Array, step: int) -> Array:
        """Velocity of its point at ``point``, W, (3,) [m/s]."""
        if self._jumps.age(step) >= self._jumps.n_steps:
            return np.zeros(3)
        was_at = (self.state.before @ self.state.now.inverse()).transform(point[None])[0]
        velocity: Array = (point - was_at) / self._jumps.duration
        return without_placement(velocity, length(velocity))


def _model(shapes: Mapping[str, Sequence[CollisionShape]]) -> mujoco.MjModel:
    """Build a model of free bodies, one for each name, in their order."""
    spec = mujoco.MjSpec()
    for name, parts in shapes.items():
        body = spec.worldbody.add_body(name=name, mass=1.0, inertia=[1.0] * 3)
        body.explicitinertial = True
        body.add_freejoint()
        kind, owner = name.split("/")[:2]
        bit = OBJECTS if kind == "object" else 2 << (int(owner) % 29)
        for i, shape in enumerate(parts):
            place = shape.body_from_shape
            geom = body.add_geom(
                name=f"{name}/shape/{i}",
                type=SHAPES[shape.kind],
                pos=place.position.tolist(),
                quat=quaternion_from_rotation(place.rotation).tolist(),
                contype=bit,
                conaffinity=ALL & ~bit,
            )
            give_form(spec, geom, f"{name}/{i}", shape)
    return spec.compile()


def _owner(name: str) -> str:
    """``vehicle/1`` or ``object/1``, what the body or shape of that name belongs to."""
    return "/".join(name.split("/")[:2])
