r"""Lifting of bodies that begin deep in the ground.

Contacts push a body out of what it is in along the shortest way, which may be sideways or through,
with a force that grows with the depth. A light link that begins 0.25 m deep is thrown out at
100 rad/s. So a body that a scene puts into the ground touches nothing at first, and its base rises
at `SPEED` as it stands until it is clear:

.. math:: z(t) = z_0 + v\,t, \qquad 0 \le t \le \Delta z / v

Its joints are free to move meanwhile. A body that is placed elsewhere is no longer lifted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import mujoco
import numpy as np

from ...base.geometry import Array
from ...base.record import Record

SPEED = 0.25
"""Of a body that is lifted [m/s]."""


@dataclass(slots=True)
class LiftState(Record):
    """How far bodies are lifted."""

    left: list[int] = field(default_factory=list)
    """The steps until each body is clear."""


class Lift:
    """The bodies that are lifted.

    Args:
        model: of the scene; bits of contacts are changed here.
        data: its state.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data = model, data
        self._bodies: list[_LiftedBody] = []
        self.state = LiftState()
        """How far they are lifted."""

    def add(self, body: int, rise: float) -> None:
        """Lift a body with a free joint, and all that is on it, from where it is.

        Args:
            body: number of the body.
            rise: how far [m].
        """
        n_steps = max(1, math.ceil(rise / (SPEED * self._model.opt.timestep)))
        lifted = _LiftedBody(self._model, self._data, body, rise, n_steps)
        lifted.touch(is_on=False)
        self._bodies.append(lifted)
        self.state.left.append(n_steps)

    @property
    def is_active(self) -> bool:
        """Whether a body is being lifted; then steps are taken one by one."""
        return any(self.state.left)

    def begin_step(self) -> None:
        """Stop to lift what was placed elsewhere; to be called before a step."""
        for i, body in enumerate(self._bodies):
            if self.state.left[i] and not body.is_at(self.state.left[i]):
                self.state.left[i] = 0
                body.touch(is_on=True)

    def end_step(self) -> None:
        """Put each body where it has been lifted to; to be called after a step."""
        for i, body in enumerate(self._bodies):
            if self.state.left[i]:
                self.state.left[i] -= 1
                body.put(self.state.left[i])


class _LiftedBody:
    """A body with its way up."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, body: int, rise: float, n_steps: int
    ) -> None:
        joint = int(model.body_jntadr[body])
        place, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self._model, self._rise, self._n_steps = model, rise, n_steps
        self._pose, self._velocity = data.qpos[place : place + 7], data.qvel[dof : dof + 6]
        self._start = self._pose.copy()
        self._geoms = np.flatnonzero(model.body_rootid[model.geom_bodyid] == body)
        self._bits = model.geom_contype[self._geoms], model.geom_conaffinity[self._geoms]

    def touch(self, *, is_on: bool) -> None:
        """Let it touch others, or nothing."""
        contype, conaffinity = self._bits
        self._model.geom_contype[self._geoms] = contype if is_on else 0
        self._model.geom_conaffinity[self._geoms] = conaffinity if is_on else 0

    def is_at(self, left: int) -> bool:
        """Whether it is where it was put some steps before its end."""
        return np.array_equal(self._pose, self._pose_at(left))

    def put(self, left: int) -> None:
        """Place it some steps before its end; at the end it is at rest and touches others."""
        self._pose[:] = self._pose_at(left)
        self._velocity[:] = 0.0
        if left:
            self._velocity[2] = SPEED
        else:
            self.touch(is_on=True)

    def _pose_at(self, left: int) -> Array:
        pose: Array = self._start.copy()
        pose[2] += self._rise * (1.0 - left / self._n_steps)
        return pose
