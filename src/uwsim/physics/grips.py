"""Objects that vehicles hold: fixed to a link until they are let go.

An object that forces move, on a link of a simulated vehicle, is welded to it by a constraint: its
weight and the water on it act on the vehicle. Everything else that is held follows its link as if
without mass. An object that is held passes through the vehicle that holds it, as in the original.
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
from .engine_model import ALL, OBJECTS, vehicle_bit
from .poses import Poses


@dataclass(frozen=True)
class Hold:
    """What holds an object, and how."""

    vehicle: int
    """Number of the vehicle."""
    link: str
    """Its link."""
    link_from_object: Pose
    """Where the object is in the frame of the link."""


@dataclass(slots=True)
class GripsState(Record):
    """What is held."""

    held: dict[int, Hold] = field(default_factory=dict)
    """What holds each object that is held, by its number."""


class Grips:
    """The objects of a scene that are held.

    Args:
        model: of the scene.
        data: its state.
        poses: where everything is.
        dynamics: numbers of the simulated vehicles.
        shapes: what can be touched in the engine, by the name of its body.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        poses: Poses,
        dynamics: Collection[int],
        shapes: Mapping[str, Collection[CollisionShape]],
    ) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._dynamics, self._shapes = dynamics, shapes
        self.state = GripsState()
        """What is held."""

    def can_hold(self, thing: int) -> bool:
        """Whether an object can be held: not what is solid and fixed, nor what is held."""
        is_loose = thing not in self.state.held and not self._poses.is_fixed(thing)
        return is_loose and (self._is_free(thing) or object_body(thing) not in self._shapes)

    def hold(self, thing: int, vehicle: int, link: str) -> None:
        """Fix an object, where it is now, to a link."""
        link_from_object = self._poses.link(vehicle, link).inverse() @ self._poses.object(thing)
        self._fix(thing, Hold(vehicle, link, link_from_object))
        self._poses.moved()

    def let_go(self, thing: int) -> None:
        """Release an object where it is."""
        if thing not in self.state.held:
            return
        here = self._poses.object(thing)
        is_welded = self._weld(thing, self.state.held[thing]) is not None
        self._loosen(thing)
        if self._is_free(thing) and not is_welded:
            self._place(thing, here)
        elif not self._is_free(thing):
            self._poses.put(thing, here)
        self._poses.moved()

    def place(self, thing: int, world_from_object: Pose) -> None:
        """Place an object that nothing holds and that is not fixed, at rest."""
        if self._is_free(thing):
            self._place(thing, world_from_object)
        else:
            self._poses.put(thing, world_from_object)
        self._poses.moved()

    @property
    def is_carrying(self) -> bool:
        """Whether a body of the engine follows a vehicle that is not simulated."""
        held = self.state.held
        return bool(held) and any(self._follows(thing, hold) for thing, hold in held.items())

    @property
    def is_holding(self) -> bool:
        """Whether a vehicle holds an object."""
        return bool(self.state.held)

    def follow(self) -> None:
        """Put the bodies that follow a vehicle where they are, before a step."""
        for thing, hold in self.state.held.items():
            if self._follows(thing, hold):
                self._place(thing, self._poses.object(thing))

    def _is_free(self, thing: int) -> bool:
        """Whether an object is a body of the engine that forces move."""
        name = object_body(thing)
        return int(mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_BODY, name)) >= 0

    def _follows(self, thing: int, hold: Hold) -> bool:
        return self._is_free(thing) and self._weld(thing, hold) is None

    def _weld(self, thing: int, hold: Hold) -> int | None:
        """The engine's constraint between an object and a link; None: there is none."""
        name = grip_constraint(hold.vehicle, hold.link, thing)
        weld = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_EQUALITY, name)
        return None if weld < 0 else int(weld)

    def _fix(self, thing: int, hold: Hold) -> None:
        self.state.held[thing] = hold
        weld = self._weld(thing, hold)
        if weld is None:
            self._poses.state.carried[thing] = hold.vehicle, hold.link, hold.link_from_object
        else:
            place = hold.link_from_object
            turn = quaternion_from_rotation(place.rotation)
            self._model.eq_data[weld, :10] = [0.0, 0.0, 0.0, *place.position, *turn]
            self._data.eq_active[weld] = 1
        bit = vehicle_bit(hold.vehicle)
        self._collide(thing, bit, ALL & ~bit)  # as the vehicle's own shapes

    def _loosen(self, thing: int) -> None:
        weld = self._weld(thing, self.state.held.pop(thing))
        self._poses.state.carried.pop(thing, None)
        if weld is not None:
            self._data.eq_active[weld] = 0
        self._collide(thing, OBJECTS, ALL)

    def _collide(self, thing: int, own: int, others: int) -> None:
        """Set what the shapes of an object collide with."""
        if self._is_free(thing):
            model = self._model
            body = model.body(object_body(thing)).id
            shapes = model.geom_bodyid == body
            model.geom_contype[shapes] = model.body_contype[body] = own
            model.geom_conaffinity[shapes] = model.body_conaffinity[body] = others

    def _place(self, thing: int, pose: Pose) -> None:
        joint = self._model.joint(loose_joint(thing))
        place, dof = int(joint.qposadr[0]), int(joint.dofadr[0])
        self._data.qpos[place : place + 3] = pose.position
        self._data.qpos[place + 3 : place + 7] = quaternion_from_rotation(pose.rotation)
        self._data.qvel[dof : dof + 6] = np.zeros(6)
