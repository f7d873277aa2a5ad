r"""UWSim's own physics: objects that fall, roll and are pushed, without hydrodynamics.

A scene with ``<enablePhysics> 1`` and no vehicle with ``u:dynamics`` is simulated by it, as by the
original's engine: gravity is that of ``<gravity>`` and 1 m/s² down where it is all zero,
objects do not float, and nothing slows them but their damping d, which before every step
multiplies the velocity of the centre of mass, and that of turning (Bullet, `applyDamping`), by

.. math:: (1 - d)^{\Delta t}

Vehicles move as commanded, even through walls, and push free objects: each jump
(`kinematics.jumps`) is their motion for as much time after it. Not modelled: limits of objects,
Bullet's friction and its solvers (ours is MuJoCo's, with `compile.FRICTION`), ``physicsFrequency``
(the step is the simulation's).
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

HEAVY = 1e4
"""Mass and inertia of a vehicle's links: nothing that is loose moves them [kg, kg m2]."""


@dataclass(slots=True)
class DisplacedState(Record):
    """The last displacement of a kinematic vehicle."""

    now: Array
    """Where its joints were put, (n,)."""
    velocity: Array
    """The velocity of the last displacement, (n,) [m/s, rad/s]."""
    step: int
    """The steps taken."""
    jumps: JumpState
    """When it was displaced."""


@dataclass(slots=True)
class UwsimPhysicsState(Record):
    """What changes besides the engine's numbers."""

    vehicles: list[DisplacedState]
    """The displacements of each vehicle."""


class UwsimPhysics:
    """Free objects among kinematic vehicles, as in UWSim.

    Args:
        scene: spec of the scene; its ``has_uwsim_physics`` is true.
        model: of the scene; changed here to what this engine needs.
        data: its state.
    """

    def __init__(self, scene: SceneSpec, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        n_vehicles = len(scene.vehicles)
        joints: list[list[int]] = [[] for _ in range(n_vehicles)]
        loose: list[tuple[int, int]] = []  # number of the object, its joint
        for joint in range(model.njnt):
            kind, index = model.joint(joint).name.split("/")[:2]
            if kind == "vehicle":
                joints[int(index)].append(joint)
            else:
                loose.append((int(index), joint))
        for body in range(1, model.nbody):
            if model.body(body).name.startswith("vehicle/"):
                model.body_mass[body] = HEAVY
                model.body_inertia[body] = HEAVY
        mujoco.mj_setConst(model, mujoco.MjData(model))  # it sets the state to the model's own
        bodies = model.jnt_bodyid[[joint for _, joint in loose]]
        own = np.column_stack([model.body_mass[bodies], model.body_inertia[bodies]])
        model.stat.meaninertia = float(own.mean())  # the solver's scale: not the vehicles' own
        damped = [(scene.objects[index].solid, joint) for index, joint in loose]
        self._damped = [
            _DampedObject(physics, model, data, joint)
            for physics, joint in damped
            if physics.linear_damping > 0.0 or physics.angular_damping > 0.0
        ]
        self._vehicles = [_KinematicVehicle(model, data, of_vehicle) for of_vehicle in joints]
        self.state = UwsimPhysicsState([vehicle.state for vehicle in self._vehicles])
        """What changes besides the engine's numbers."""

    def step(self) -> None:
        """Take a step; vehicles stay where they are."""
        for vehicle in self._vehicles:
            vehicle.set_speed()
        for thing in self._damped:
            thing.slow_down()
        mujoco.mj_step(self._model, self._data)
        for vehicle in self._vehicles:
            vehicle.put_back()


class _DampedObject:
    """A free object with UWSim's velocity damping."""

    def __init__(
        self, physics: PhysicsSpec, model: mujoco.MjModel, data: mujoco.MjData, joint: int
    ) -> None:
        given = (physics.linear_damping, physics.angular_damping)
        step = model.opt.timestep
        self._keeps, self._keeps_turning = ((1.0 - min(max(d, 0.0), 1.0)) ** step for d in given)
        dof, body = int(model.jnt_dofadr[joint]), int(model.jnt_bodyid[joint])
        self._velocity = data.qvel[dof : dof + 6]  # of its origin, W; of its turning, own axes
        self._rotation = data.xmat[body]
        self._middle = model.body_ipos[body].copy()

    def slow_down(self) -> None:
        """Damp its velocities for one step."""
        rotation = self._rotation.reshape(3, 3)
        turning = self._velocity[3:]
        of_middle = self._velocity[:3] + rotate(rotation, np.cross(turning, self._middle))
        turning *= self._keeps_turning
        lever = rotate(rotation, np.cross(turning, self._middle))
        self._velocity[:3] = self._keeps * of_middle - lever


class _KinematicVehicle:
    """A kinematic vehicle with the speed of its last displacement."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: list[int]) -> None:
        self._model, self._data = model, data
        widths = np.diff([*model.jnt_qposadr.tolist(), model.nq])  # of each joint's position
        self._q = np.flatnonzero(np.isin(np.repeat(np.arange(model.njnt), widths), joints))
        self._v = np.flatnonzero(np.isin(model.dof_jntid, joints))
        self._jumps = JumpTimes(model.opt.timestep, last_step=0)
        now, speed = data.qpos[self._q].copy(), np.zeros(len(self._v))
        self.state = DisplacedState(now, speed, 0, self._jumps.state)

    def set_speed(self) -> None:
        """Record its pose, and set the speed of its last displacement."""
        data, state, here = self._data, self.state, self._data.qpos[self._q].copy()
        state.step += 1
        if not np.array_equal(here, state.now):
            self._jumps.add(state.step)
            state.velocity = self._speed()
            state.now = here
        is_moving = self._jumps.age(state.step) < self._jumps.n_steps
        data.qvel[self._v] = state.velocity if is_moving else 0.0

    def put_back(self) -> None:
        """Undo what the step did to it."""
        self._data.qpos[self._q] = self.state.now
        self._data.qvel[self._v] = 0.0

    def _speed(self) -> Array:
        """Compute the speed of the jump to where it is now, joint by joint, (n,) [m/s, rad/s].

        It is 0 where a component is that of a placement.
        """
        after = self._data.qpos.copy()
        before = after.copy()
        before[self._q] = self.state.now
        speed = np.zeros(self._model.nv)
        mujoco.mj_differentiatePos(self._model, speed, self._jumps.duration, before, after)
        own: Array = speed[self._v]
        return jump_velocity(own, float(np.abs(own).max(initial=0.0)))
