"""Objects that vehicles hold: fixed to a link until they are released.

A constraint of the engine welds a loose object to a link of a vehicle with dynamics: its weight and
the water on it then act on the vehicle. All other held objects follow their link without exerting
forces on it. As in UWSim (C++), a held object has no contacts with the vehicle that holds it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

import mujoco
import numpy as np

from ..base.geometry import Pose, quaternion_from_rotation
from ..base.record import Record
from ..model.body_names import grip_constraint, loose_joint, object_body
from ..model.collision.shapes import CollisionShape
from .engine_model import ALL_BITS, OBJECT_BIT, vehicle_bit
from .poses import Poses


@dataclass(frozen=True)
class Hold:
    """The link that holds an object, and the object's pose on it."""

    vehicle: int
    """The index of the vehicle."""
    link: str
    """The name of the link."""
    link_from_object: Pose
    """The pose of the object in the frame of the link."""


@dataclass(slots=True)
class GripsState(Record):
    """The objects that are held."""

    grasps: dict[int, Hold] = field(default_factory=dict)
    """The hold of each held object, by the index of the object."""


class Grips:
    """The objects of a scene that are held.

    Args:
        model: the engine's model.
        data: the engine's state.
        poses: the poses of all bodies.
        shapes: the engine's collision shapes, by the name of their body.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        poses: Poses,
        shapes: Mapping[str, Collection[CollisionShape]],
    ) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._shapes = shapes
        self.state = GripsState()
        """The objects that are held."""

    def can_hold(self, index: int) -> bool:
        """Return whether an object can be held.

        An object cannot be held if it is held already, if it is fixed, or if it has collision
        shapes but is not loose.
        """
        is_available = index not in self.state.grasps and not self._poses.is_fixed(index)
        return is_available and (self._is_free(index) or object_body(index) not in self._shapes)

    def hold(self, index: int, vehicle: int, link: str) -> None:
        """Fix an object at its present pose to a link."""
        link_from_object = self._poses.link(vehicle, link).inverse() @ self._poses.object(index)
        self._attach(index, Hold(vehicle, link, link_from_object))
        self._poses.mark_stale()

    def release(self, index: int) -> None:
        """Release an object at its present pose."""
        if index not in self.state.grasps:
            return
        pose = self._poses.object(index)
        is_welded = self._weld(index, self.state.grasps[index]) is not None
        self._detach(index)
        if self._is_free(index) and not is_welded:
            self._place(index, pose)
        elif not self._is_free(index):
            self._poses.place_object(index, pose)
        self._poses.mark_stale()

    def place(self, index: int, world_from_object: Pose) -> None:
        """Place an object that is neither held nor fixed, at rest."""
        if self._is_free(index):
            self._place(index, world_from_object)
        else:
            self._poses.place_object(index, world_from_object)
        self._poses.mark_stale()

    @property
    def is_carrying(self) -> bool:
        """True if a loose object follows a link without a constraint, so that its pose is set."""
        grasps = self.state.grasps
        return bool(grasps) and any(self._is_carried(index, hold) for index, hold in grasps.items())

    @property
    def is_holding(self) -> bool:
        """True if a vehicle holds an object."""
        return bool(self.state.grasps)

    def follow(self) -> None:
        """Set the poses of loose objects that follow a link; to be called before a step."""
        for index, hold in self.state.grasps.items():
            if self._is_carried(index, hold):
                self._place(index, self._poses.object(index))

    def _is_free(self, index: int) -> bool:
        """Return whether forces move an object in all directions: its body has a free joint."""
        name = loose_joint(index)
        return int(mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_JOINT, name)) >= 0

    def _is_carried(self, index: int, hold: Hold) -> bool:
        return self._is_free(index) and self._weld(index, hold) is None

    def _weld(self, index: int, hold: Hold) -> int | None:
        """Return the engine's constraint between an object and a link, or None without one."""
        name = grip_constraint(hold.vehicle, hold.link, index)
        weld = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_EQUALITY, name)
        return None if weld < 0 else int(weld)

    def _attach(self, index: int, hold: Hold) -> None:
        self.state.grasps[index] = hold
        weld = self._weld(index, hold)
        if weld is None:
            self._poses.state.carriers[index] = hold.vehicle, hold.link, hold.link_from_object
        else:
            pose = hold.link_from_object
            quaternion = quaternion_from_rotation(pose.rotation)
            self._model.eq_data[weld, :10] = [0.0, 0.0, 0.0, *pose.position, *quaternion]
            self._data.eq_active[weld] = 1
        bit = vehicle_bit(hold.vehicle)
        self._set_bits(index, bit, ALL_BITS & ~bit)  # no contacts with the vehicle's shapes

    def _detach(self, index: int) -> None:
        weld = self._weld(index, self.state.grasps.pop(index))
        self._poses.state.carriers.pop(index, None)
        if weld is not None:
            self._data.eq_active[weld] = 0
        self._set_bits(index, OBJECT_BIT, ALL_BITS)

    def _set_bits(self, index: int, contype: int, conaffinity: int) -> None:
        if self._is_free(index):
            model = self._model
            body = model.body(object_body(index)).id
            shapes = model.geom_bodyid == body
            model.geom_contype[shapes] = model.body_contype[body] = contype
            model.geom_conaffinity[shapes] = model.body_conaffinity[body] = conaffinity

    def _place(self, index: int, pose: Pose) -> None:
        joint = self._model.joint(loose_joint(index))
        address, dof = int(joint.qposadr[0]), int(joint.dofadr[0])
        self._data.qpos[address : address + 3] = pose.position
        self._data.qpos[address + 3 : address + 7] = quaternion_from_rotation(pose.rotation)
        self._data.qvel[dof : dof + 6] = np.zeros(6)
