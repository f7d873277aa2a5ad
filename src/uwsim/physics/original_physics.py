r"""The physics of UWSim (C++): objects that fall, roll and are pushed, without hydrodynamics.

It applies to scenes with ``<enablePhysics> 1`` and no vehicle with ``u:dynamics``. Gravity is that
of ``<gravity>``, or 1 m/s² down if all its components are zero. Objects do not float. Only their
damping d slows them: before every step, the velocity of the centre of mass and the angular velocity
are multiplied by (Bullet, `applyDamping`)

.. math:: (1 - d)^{\Delta t}

Vehicles move as commanded, even through walls, and push loose objects. The velocity of a
displacement (`kinematics.jumps`) lasts for as long after it as the displacement took. Not modelled:
limits of objects, Bullet's friction and solvers (MuJoCo's are used, with `engine_model.FRICTION`),
``physicsFrequency`` (the timestep of the simulation is used).
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import rotate
from ..base.record import Record
from ..scene.object import PhysicsSpec
from ..scene.spec import SceneSpec
from .kinematics.jumps import JumpState, JumpTimes, jump_velocity

VEHICLE_MASS = 1e4
"""The mass [kg] and inertia [kg m2] of a vehicle's links, so great that no loose object moves them.
"""


@dataclass(slots=True)
class DisplacedState(Record):
    """The last displacement of a kinematic vehicle."""

    positions: Array
    """The positions of the vehicle's joints as in ``qpos``, (n,)."""
    velocity: Array
    """The velocity of the last displacement, (n,) [m/s, rad/s]."""
    step: int
    """The number of steps taken."""
    jumps: JumpState
    """The time of the last displacement."""


@dataclass(slots=True)
class OriginalPhysicsState(Record):
    """The state of the physics besides the engine's state."""

    vehicles: list[DisplacedState]
    """The last displacement of each vehicle."""


class OriginalPhysics:
    """The physics of loose objects among kinematic vehicles, as in UWSim.

    Args:
        scene: the spec of the scene; its ``has_original_physics`` is true.
        model: the engine's model, whose masses and inertias are changed here.
        data: the engine's state.
    """

    def __init__(self, scene: SceneSpec, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        n_vehicles = len(scene.vehicles)
        joints: list[list[int]] = [[] for _ in range(n_vehicles)]
        object_joints: list[tuple[int, int]] = []  # the object's index, its joint
        for joint in range(model.njnt):
            kind, index = model.joint(joint).name.split("/")[:2]
            if kind == "vehicle":
                joints[int(index)].append(joint)
            else:
                object_joints.append((int(index), joint))
        for body in range(1, model.nbody):
            if model.body(body).name.startswith("vehicle/"):
                model.body_mass[body] = VEHICLE_MASS
                model.body_inertia[body] = VEHICLE_MASS
        mujoco.mj_setConst(model, mujoco.MjData(model))  # it resets the state of its data
        bodies = model.jnt_bodyid[[joint for _, joint in object_joints]]
        inertias = np.column_stack([model.body_mass[bodies], model.body_inertia[bodies]])
        model.stat.meaninertia = float(inertias.mean())  # the solver's scale, without vehicles
        objects = [(scene.objects[index].solid, joint) for index, joint in object_joints]
        self._damped_objects = [
            _DampedObject(physics, model, data, joint)
            for physics, joint in objects
            if physics.linear_damping > 0.0 or physics.angular_damping > 0.0
        ]
        self._vehicles = [_KinematicVehicle(model, data, of_vehicle) for of_vehicle in joints]
        self.state = OriginalPhysicsState([vehicle.state for vehicle in self._vehicles])
        """The last displacement of each vehicle."""

    def step(self) -> None:
        """Take a step in which only loose objects move."""
        for vehicle in self._vehicles:
            vehicle.set_velocity()
        for damped_object in self._damped_objects:
            damped_object.slow_down()
        mujoco.mj_step(self._model, self._data)
        for vehicle in self._vehicles:
            vehicle.restore_pose()


class _DampedObject:
    """A loose object with UWSim's velocity damping; r_g is its centre of mass in body axes."""

    def __init__(
        self, physics: PhysicsSpec, model: mujoco.MjModel, data: mujoco.MjData, joint: int
    ) -> None:
        dampings = (physics.linear_damping, physics.angular_damping)
        step = model.opt.timestep
        self._factors = tuple((1.0 - min(max(d, 0.0), 1.0)) ** step for d in dampings)
        dof, body = int(model.jnt_dofadr[joint]), int(model.jnt_bodyid[joint])
        self._velocity = data.qvel[dof : dof + 6]  # linear in W, angular in body axes
        self._rotation = data.xmat[body]
        self._r_g = model.body_ipos[body].copy()

    def slow_down(self) -> None:
        rotation = self._rotation.reshape(3, 3)
        omega = self._velocity[3:]
        v_g = self._velocity[:3] + rotate(rotation, np.cross(omega, self._r_g))
        omega *= self._factors[1]
        lever = rotate(rotation, np.cross(omega, self._r_g))
        self._velocity[:3] = self._factors[0] * v_g - lever


class _KinematicVehicle:
    """A kinematic vehicle with the velocity of its last displacement."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: list[int]) -> None:
        self._model, self._data = model, data
        widths = np.diff([*model.jnt_qposadr.tolist(), model.nq])  # of each joint's position
        self._q = np.flatnonzero(np.isin(np.repeat(np.arange(model.njnt), widths), joints))
        self._v = np.flatnonzero(np.isin(model.dof_jntid, joints))
        self._jumps = JumpTimes(model.opt.timestep, last_step=0)
        q, speed = data.qpos[self._q].copy(), np.zeros(len(self._v))
        self.state = DisplacedState(q, speed, 0, self._jumps.state)

    def set_velocity(self) -> None:
        """Record the configuration, and set the velocity of the last displacement."""
        data, state, q = self._data, self.state, self._data.qpos[self._q].copy()
        state.step += 1
        if not np.array_equal(q, state.positions):
            self._jumps.add(state.step)
            state.velocity = self._jump_velocity()
            state.positions = q
        is_moving = self._jumps.age(state.step) < self._jumps.n_steps
        data.qvel[self._v] = state.velocity if is_moving else 0.0

    def restore_pose(self) -> None:
        self._data.qpos[self._q] = self.state.positions
        self._data.qvel[self._v] = 0.0

    def _jump_velocity(self) -> Array:
        """Return the velocity of the last jump, joint by joint, (n,) [m/s, rad/s].

        It is 0 if the jump is a placement; see `jump_velocity`.
        """
        q = self._data.qpos.copy()
        q_last = q.copy()
        q_last[self._q] = self.state.positions
        velocities = np.zeros(self._model.nv)
        mujoco.mj_differentiatePos(self._model, velocities, self._jumps.duration, q_last, q)
        velocity: Array = velocities[self._v]
        return jump_velocity(velocity, float(np.abs(velocity).max(initial=0.0)))
