r"""Lifting of bodies whose initial poses are deep in the ground.

A contact pushes a penetrating body out along the shortest way, which may be sideways or through the
ground, with a force that grows with the depth: a light link that begins at a depth of 0.25 m is
ejected at 100 rad/s. A body that a scene places in the ground therefore has no contacts at first,
and its base rises at `LIFT_SPEED`, v, with a constant attitude, by the height :math:`\Delta z`:

.. math:: z(t) = z_0 + v\,t, \qquad 0 \le t \le \Delta z / v

Its joints are free to move meanwhile. The lift ends if the pose of the body is set.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import mujoco
import numpy as np

from ...base.geometry import Array
from ...base.record import Record

LIFT_SPEED = 0.25
"""The speed of a body that is lifted [m/s]."""


@dataclass(slots=True)
class LiftState(Record):
    """The progress of the lifted bodies."""

    steps_left: list[int] = field(default_factory=list)
    """The number of steps left in the lift of each body; 0 for a body that is not lifted any more.
    """


class Lift:
    """The bodies that are lifted.

    Args:
        model: the engine's model, whose collision bits are changed here.
        data: the engine's state.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        self._bodies: list[_LiftedBody] = []
        self.state = LiftState()
        """The progress of the lifted bodies."""

    def add(self, body: int, rise: float) -> None:
        """Begin to lift a body with a free joint, and the bodies attached to it.

        Args:
            body: the MuJoCo ID of the body.
            rise: the height of the lift [m].
        """
        n_steps = max(1, math.ceil(rise / (LIFT_SPEED * self._model.opt.timestep)))
        lifted_body = _LiftedBody(self._model, self._data, body, rise, n_steps)
        lifted_body.set_contacts(is_on=False)
        self._bodies.append(lifted_body)
        self.state.steps_left.append(n_steps)

    @property
    def is_active(self) -> bool:
        """True if a body is being lifted; steps must then be taken one by one."""
        return any(self.state.steps_left)

    def begin_step(self) -> None:
        """End the lift of bodies whose poses were set since the last step; call before a step."""
        for i, body in enumerate(self._bodies):
            if self.state.steps_left[i] and not body.is_at(self.state.steps_left[i]):
                self.state.steps_left[i] = 0
                body.set_contacts(is_on=True)

    def end_step(self) -> None:
        """Move each body to its lifted pose; call it after a step."""
        for i, body in enumerate(self._bodies):
            if self.state.steps_left[i]:
                self.state.steps_left[i] -= 1
                body.place(self.state.steps_left[i])


class _LiftedBody:
    """A body that is lifted, with its initial pose."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, body: int, rise: float, n_steps: int
    ) -> None:
        joint = int(model.body_jntadr[body])
        address, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self._model, self._rise, self._n_steps = model, rise, n_steps
        self._pose, self._velocity = data.qpos[address : address + 7], data.qvel[dof : dof + 6]
        self._start = self._pose.copy()
        self._geoms = np.flatnonzero(model.body_rootid[model.geom_bodyid] == body)
        self._bits = model.geom_contype[self._geoms], model.geom_conaffinity[self._geoms]

    def set_contacts(self, *, is_on: bool) -> None:
        contype, conaffinity = self._bits
        self._model.geom_contype[self._geoms] = contype if is_on else 0
        self._model.geom_conaffinity[self._geoms] = conaffinity if is_on else 0

    def is_at(self, steps_left: int) -> bool:
        """Return whether the body has the pose of the lift with this number of steps left."""
        return np.array_equal(self._pose, self._pose_at(steps_left))

    def place(self, steps_left: int) -> None:
        """Set the pose and velocity of the body; at the end of the lift, allow contacts again."""
        self._pose[:] = self._pose_at(steps_left)
        self._velocity[:] = 0.0
        if steps_left:
            self._velocity[2] = LIFT_SPEED
        else:
            self.set_contacts(is_on=True)

    def _pose_at(self, steps_left: int) -> Array:
        pose: Array = self._start.copy()
        pose[2] += self._rise * (1.0 - steps_left / self._n_steps)
        return pose
