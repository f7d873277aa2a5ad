r"""Prescribed motion: velocities and accelerations of a vehicle whose poses are set.

Commands, or a recording, set the poses of a vehicle without dynamics, in jumps (`jumps`). The
motion spreads each jump evenly over a time T:

.. math:: \dot q = \Delta q / T, \qquad \ddot q = (\dot q - \dot q_{before}) / T

The velocity and the acceleration last until the next jump. If no jump follows for :math:`1.5\,T`,
the velocity becomes 0, with a deceleration that lasts for T. The motions by commands of the base,
by commands of the joints, and by the drift with the water (a jump in every step) are computed
separately and added.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal

import mujoco
import numpy as np

from ...base.geometry import Array
from ...base.record import Record
from .jumps import JumpState, JumpTimes
from .link_motion import LinkMotion

Source = Literal["base", "joints"]
"""The part of a vehicle that commands move."""


@dataclass(slots=True)
class SourceState(Record):
    """The motion that one source causes."""

    speed: Array
    """The velocity of the last jump, (n,) [m/s, rad/s]."""
    previous_speed: Array
    """The velocity of the jump before the last, (n,) [m/s, rad/s]."""
    times: JumpState
    """The time of the last jump."""


@dataclass(slots=True)
class PrescribedMotionState(Record):
    """The state of the prescribed motion of a vehicle."""

    positions: Array
    """The base and joints when last recorded: position in W [m], quaternion (wxyz), and the joint
    positions [rad or m], (7 + n,)."""
    base: SourceState
    """The motion by commands of the base."""
    joints: SourceState
    """The motion by commands of the joints."""
    drift: SourceState
    """The motion by the water."""


class PrescribedMotion:
    """The motion of one vehicle whose poses are set.

    Args:
        model: the engine's model.
        data: the engine's state.
        joints: the vehicle's joints in the model, the free joint of its base first.
        index: the index of the vehicle.
        links: the motion of points on links.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        joints: list[int],
        index: int,
        links: LinkMotion,
    ) -> None:
        self._data = data
        self._speeds, self._accelerations = links.joint_rates(index)
        free_joint, *other_joints = joints
        start, dof = int(model.jnt_qposadr[free_joint]), int(model.jnt_dofadr[free_joint])
        self._qpos_addresses = np.array(
            [*range(start, start + 7), *model.jnt_qposadr[other_joints]]
        )
        self._dofs = np.array([*range(dof, dof + 6), *model.jnt_dofadr[other_joints]])
        timestep = float(model.opt.timestep)
        self._base, self._drift = _Motion(6, timestep), _Motion(6, timestep)
        self._joints = _Motion(len(other_joints), timestep)
        now: Array = data.qpos[self._qpos_addresses]
        self.state = PrescribedMotionState(
            now, self._base.state, self._joints.state, self._drift.state
        )
        """The state of the motion."""

    def record(self, step: int, starting_sources: Collection[Source] = ()) -> None:
        """Record the present configuration; motion by ``starting_sources`` begins there."""
        change = self._measure_change()
        sources: tuple[tuple[Source, _Motion, Array], ...] = (
            ("base", self._base, change[:6]),
            ("joints", self._joints, change[6:]),
        )
        for source, jumps, part in sources:
            if source in starting_sources:
                jumps.begin(step)
            elif part.any():
                jumps.add(step, part)

    def record_drift(self, step: int) -> None:
        """Record the displacement by the water."""
        self._drift.add(step, self._measure_change()[:6])

    def record_at_rest(self) -> None:
        """Record the present configuration, at rest."""
        self._measure_change()
        for jumps in (self._base, self._joints, self._drift):
            jumps.clear()

    def twist(self, step: int) -> Array:
        """Return the twist of the base: linear in W [m/s], angular in its axes [rad/s], (6,)."""
        return self._base.speed(step) + self._drift.speed(step)

    def update(self, step: int) -> None:
        """Write the joints' motion at a step into the arrays that `LinkMotion` reads."""
        parts = (self._speeds, _Motion.speed), (self._accelerations, _Motion.acceleration)
        for array, part in parts:
            base = part(self._base, step) + part(self._drift, step)
            array[self._dofs] = np.concatenate([base, part(self._joints, step)])

    def _measure_change(self) -> Array:
        """Return the displacement since the last call, for each degree of freedom."""
        q_last, q = self.state.positions, self._data.qpos[self._qpos_addresses]
        change = np.empty(len(self._dofs))
        change[:3] = q[:3] - q_last[:3]  # in W
        mujoco.mju_subQuat(change[3:6], q[3:7], q_last[3:7])  # in the base's axes
        change[6:] = q[7:] - q_last[7:]
        self.state.positions = q
        return change


class _Motion:
    """The degrees of freedom that one source moves, with the velocity of its last jump."""

    def __init__(self, n: int, timestep: float) -> None:
        self._times = JumpTimes(timestep, n_steps=1)
        self.state = SourceState(np.zeros(n), np.zeros(n), self._times.state)

    def clear(self) -> None:
        """Forget the last jump."""
        state = self.state
        state.speed = np.zeros_like(state.speed)
        state.previous_speed = np.zeros_like(state.previous_speed)
        self._times.forget()

    def begin(self, step: int) -> None:
        """Set the motion to rest at this step; the next jump counts from it."""
        self.clear()
        self._times.add(step)

    def add(self, step: int, change: Array) -> None:
        """Record a jump; several in one step are one."""
        if self._times.age(step) == 0:
            self.state.speed = self.state.speed + change / self._times.duration
            return
        self.state.previous_speed = self.speed(step)
        self._times.add(step)
        self.state.speed = change / self._times.duration

    def speed(self, step: int) -> Array:
        """Return the velocity, (n,) [m/s, rad/s]."""
        is_moving = self._times.age(step) < self._n_moving_steps
        return self.state.speed if is_moving else np.zeros_like(self.state.speed)

    def acceleration(self, step: int) -> Array:
        """Return the acceleration, (n,) [m/s2, rad/s2]."""
        age, time = self._times.age(step), self._times.duration
        if age < self._n_moving_steps:
            return (self.state.speed - self.state.previous_speed) / time
        if age < self._n_moving_steps + self._times.n_steps:
            return -self.state.speed / time
        return np.zeros_like(self.state.speed)

    @property
    def _n_moving_steps(self) -> int:
        """The number of steps for which a jump is the motion, unless another comes."""
        return self._times.n_steps + (self._times.n_steps + 1) // 2
