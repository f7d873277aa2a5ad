r"""Velocities and accelerations of a vehicle that is placed, by commands or by a recording.

Its commands move it in jumps (`jumps`), each made evenly over a time T:

.. math:: \dot q = \Delta q / T, \qquad \ddot q = (\dot q - \dot q_{before}) / T

Both last until the next jump; where none comes for :math:`1.5\,T` the vehicle has stopped, and
slows down over T. The commands of the base, those of
the joints and the drift with the water, which moves a vehicle at every step, are jumps of their own
and add up.
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
"""What commands move."""


@dataclass(slots=True)
class SourceState(Record):
    """What one source of motion has done."""

    speed: Array
    """The velocity of its last jump, (n,) [m/s, rad/s]."""
    before: Array
    """The velocity before it, (n,)."""
    times: JumpState
    """When it jumped."""


@dataclass(slots=True)
class PlacedState(Record):
    """What changes of a vehicle that is placed."""

    now: Array
    """Its joints' positions when they were last recorded, (7 + n,)."""
    base: SourceState
    """What commands of the base have done."""
    joints: SourceState
    """What commands of the joints have done."""
    drift: SourceState
    """What the water has done."""


class PlacedMotion:
    """The motion of one vehicle that is placed.

    Args:
        model: of the scene.
        data: its state.
        joints: the vehicle's in the model, the free joint of its base first.
        index: number of the vehicle.
        links: how points on links move.
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
        self._speeds, self._rates = links.led(index)
        free, *moving = joints
        place, dof = int(model.jnt_qposadr[free]), int(model.jnt_dofadr[free])
        self._places = np.array([*range(place, place + 7), *model.jnt_qposadr[moving]])
        self._dofs = np.array([*range(dof, dof + 6), *model.jnt_dofadr[moving]])
        timestep = float(model.opt.timestep)
        self._base, self._drift = _Jumps(6, timestep), _Jumps(6, timestep)
        self._joints = _Jumps(len(moving), timestep)
        now: Array = data.qpos[self._places]
        self.state = PlacedState(now, self._base.state, self._joints.state, self._drift.state)
        """What changes of it."""

    def record(self, step: int, starts: Collection[Source] = ()) -> None:
        """Record where it was put; what ``starts`` has not come there, its motion begins there."""
        change = self._change()
        sources: tuple[tuple[Source, _Jumps, Array], ...] = (
            ("base", self._base, change[:6]),
            ("joints", self._joints, change[6:]),
        )
        for source, jumps, part in sources:
            if source in starts:
                jumps.begin(step)
            elif part.any():
                jumps.add(step, part)

    def record_drift(self, step: int) -> None:
        """Record where the water has carried it."""
        self._drift.add(step, self._change()[:6])

    def rest(self) -> None:
        """Record where it was put, at rest."""
        self._change()
        for jumps in (self._base, self._joints, self._drift):
            jumps.clear()

    def twist(self, step: int) -> Array:
        """Return the velocity of its base in W, and its turning in its own axes, (6,)."""
        return self._base.speed(step) + self._drift.speed(step)

    def update(self, step: int) -> None:
        """Write how its joints move at a step to where `LinkMotion` reads it."""
        for found, part in ((self._speeds, _Jumps.speed), (self._rates, _Jumps.rate)):
            base = part(self._base, step) + part(self._drift, step)
            found[self._dofs] = np.concatenate([base, part(self._joints, step)])

    def _change(self) -> Array:
        """How far it is from where it was the last time, for each degree of freedom."""
        before, now = self.state.now, self._data.qpos[self._places]
        change = np.empty(len(self._dofs))
        change[:3] = now[:3] - before[:3]  # in W
        mujoco.mju_subQuat(change[3:6], now[3:7], before[3:7])  # in the base's axes
        change[6:] = now[7:] - before[7:]
        self.state.now = now
        return change


class _Jumps:
    """The degrees of freedom that one source moves, with the velocity of its last jump."""

    def __init__(self, n: int, timestep: float) -> None:
        self._times = JumpTimes(timestep, n_steps=1)
        self.state = SourceState(np.zeros(n), np.zeros(n), self._times.state)

    def clear(self) -> None:
        """Forget the last jump."""
        state = self.state
        state.speed, state.before = np.zeros_like(state.speed), np.zeros_like(state.before)
        self._times.forget()

    def begin(self, step: int) -> None:
        """Be at rest from this step on; the next jump counts from it."""
        self.clear()
        self._times.add(step)

    def add(self, step: int, change: Array) -> None:
        """Record a jump; several in one step are one."""
        if self._times.age(step) == 0:
            self.state.speed = self.state.speed + change / self._times.duration
            return
        self.state.before = self.speed(step)
        self._times.add(step)
        self.state.speed = change / self._times.duration

    def speed(self, step: int) -> Array:
        """Return the velocity, (n,) [m/s, rad/s]."""
        is_moving = self._times.age(step) < self._lasts
        return self.state.speed if is_moving else np.zeros_like(self.state.speed)

    def rate(self, step: int) -> Array:
        """Return the acceleration, (n,) [m/s2, rad/s2]."""
        age, time = self._times.age(step), self._times.duration
        if age < self._lasts:
            return (self.state.speed - self.state.before) / time
        if age < self._lasts + self._times.n_steps:
            return -self.state.speed / time
        return np.zeros_like(self.state.speed)

    @property
    def _lasts(self) -> int:
        """For how many steps a jump is the motion, unless another comes."""
        return self._times.n_steps + (self._times.n_steps + 1) // 2
