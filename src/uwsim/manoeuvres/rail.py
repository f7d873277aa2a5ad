r"""A rail: a vehicle that can move along or about one of its axes only, in water without gravity.

Weight and buoyancy are left out, as for a model that is trimmed and hung from its carriage. The
links of the vehicle are held at their initial joint positions. A force along the rail, the drag of
the water and the vehicle's inertia with added mass act; fins and thrusters are at rest unless they
are commanded. A *load cell* fixes the vehicle by an inertia of `CELL_INERTIA` along the rail; the
acceleration times this inertia is the force on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from ..base.engine import mujoco
from ..base.geometry import Array
from ..model.scene_model import SceneModel
from ..physics.hydrodynamics import prepare
from ..physics.hydrodynamics.hydrodynamics import install
from ..scene.urdf.kinematics import link_poses

TIMESTEP = 0.002
"""The length of a step [s]."""
CELL_INERTIA = 1e9
"""The inertia of a load cell along the rail [kg or kg m2]."""
DEPTH = 1000.0
"""The depth of the rail: far from the surface [m]."""


class Rail:
    """A vehicle on a rail.

    Args:
        model: the scene of an experiment.
        axis: the index of the axis of the base: 0 to 2 along, 3 to 5 about x, y, z.
        is_fixed: True to fix the vehicle to a load cell.
    """

    def __init__(self, model: SceneModel, axis: int, *, is_fixed: bool = False) -> None:
        self._is_fixed = is_fixed
        spec = mujoco.MjSpec()
        spec.option.timestep = TIMESTEP
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        spec.option.gravity = [0.0, 0.0, 0.0]
        robot, dynamics = model.robots[0], model.dynamics[0]
        poses = link_poses(robot, model.scene.vehicles[0].joint_values)
        nodes: dict[str, Any] = {}
        for link in robot.links:
            parent = spec.worldbody if link.name == robot.root else nodes[robot.root]
            pose, body = poses[link.name], dynamics.body(link.name)
            node = parent.add_body(
                name=link.name, pos=pose.position.tolist(), quat=pose.quaternion.tolist()
            )
            if body is None or body.mass is None:
                node.mass, node.inertia, node.ipos = max(link.mass, 1e-3), [1e-4] * 3, [0.0] * 3
                if link.mass > 0.0 and min(link.inertia[:3]) > 0.0:
                    node.fullinertia, node.ipos = list(link.inertia), list(link.centre_of_mass)
                node.explicitinertial = True
            nodes[link.name] = node
        direction = [0.0, 0.0, 0.0]
        direction[axis % 3] = 1.0
        nodes[robot.root].add_joint(
            type=mujoco.mjtJoint.mjJNT_SLIDE if axis < 3 else mujoco.mjtJoint.mjJNT_HINGE,
            axis=direction,
            armature=CELL_INERTIA if is_fixed else 0.0,
        )
        prepare(
            spec,
            {body.link: body for body in dynamics.bodies},
            {thruster.name: (thruster.link, thruster) for thruster in dynamics.thrusters},
            {fin.name: (fin.link, fin) for fin in dynamics.fins},
            surface=DEPTH,
            density=dynamics.density,
        )
        self._model = spec.compile()
        self._water = install(self._model)
        self._data = mujoco.MjData(self._model)

    @property
    def speed(self) -> float:
        """The speed along or about the rail [m/s or rad/s]."""
        return float(self._data.qvel[0])

    @speed.setter
    def speed(self, value: float) -> None:
        self._data.qvel[0] = value

    def advance(self, duration: float, force: float = 0.0) -> None:
        """Advance by a time [s] with a force along, or a moment about, the rail [N or N m]."""
        self._data.qfrc_applied[0] = force
        self._water.step(self._data, max(1, round(duration / TIMESTEP)))

    def pull(self, force: float, *, time_limit: float = 600.0) -> float:
        """Return the steady speed at a constant force along the rail."""
        last_speed, time = self.speed, 0.0
        while time < time_limit:
            self.advance(1.0, force)
            time += 1.0
            if abs(self.speed - last_speed) <= 1e-5 * abs(self.speed):
                break
            last_speed = self.speed
        return self.speed

    def coast(self, speed: float, times: Array) -> Array:
        """Return the speeds at times from 0 on, (n,), of a vehicle that is released at a speed."""
        self.speed = speed
        speeds = [speed]
        for begin, end in pairwise(times.tolist()):
            self.advance(end - begin)
            speeds.append(self.speed)
        return np.array(speeds)

    def measure_thrust(self, commands: Sequence[float] | Array, settling: float) -> float:
        """Return the force on the load cell after a time with thruster commands [N or N m]."""
        if not self._is_fixed:
            raise ValueError("a rail without load cell measures no thrust")
        self._water.set_thrusters(self._data, np.asarray(commands))
        steps = max(1, round(settling / TIMESTEP))
        self._water.step(self._data, steps)
        first_speed = self.speed
        self._water.step(self._data, 1)
        force = (self.speed - first_speed) / TIMESTEP * CELL_INERTIA
        self._data.qvel[0] = 0.0
        return force
