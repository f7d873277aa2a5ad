r"""No bounce of a loose object adds energy.

A contact with a restitution is a soft spring (`restitution`), and with long steps a body sinks in
by more than a facet of relief is wide. Another facet may then find it deep inside, from another
side, and its spring would throw the body out. Here the mechanical energy

.. math:: E = \tfrac12 \nu^T (M + M_A)\,\nu - (m - \rho V)\, g \cdot x

of an object that touches nothing but fixed things is bounded by what it was before it touched
them, and the sum of those of loose objects that touch each other by what it was before. Beyond it
the velocities are reduced to the size that the bound leaves. In water that moves, the work of the
water raises the bound. Objects that touch what else moves (a gripper, a vehicle) are not bounded.
Only scenes in which something has a restitution pay for this.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import dot, product, rotate, rotate_back
from ..base.record import Record
from .hydrodynamics import columns as c

FIXED, MOVING = -1, -2
"""What an object touches that is no object with a bound."""


@dataclass(slots=True)
class BounceState(Record):
    """What bounds the energy of loose objects."""

    bounds: Array
    """The energy that each may have, (n,) [J]."""
    before: Array
    """The velocity of each before the step, (n, 6) [m/s, rad/s]."""


class BounceLimit:
    """The energy of loose objects that bounce.

    Args:
        model: of the scene.
        data: its state.
        bodies: numbers of the loose objects' bodies.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, bodies: Sequence[int]) -> None:
        self._model, self._data = model, data
        self._objects = [_Object(model, data, body) for body in bodies]
        self.is_on = True
        """Whether it bounds anything; not while a vehicle holds an object."""
        self._numbers = {one.body: i for i, one in enumerate(self._objects)}
        self._fixed = model.body_weldid == 0  # whether a body never moves
        self.state = BounceState(
            np.array([one.energy() for one in self._objects]),
            np.array([one.velocity for one in self._objects]).reshape(-1, 6),
        )
        """What bounds their energy."""

    def apply(self) -> None:
        """Bound the energy of every object, and of those that touch each other, after a step."""
        touched = self._touched()
        energies = np.array([one.energy() for one in self._objects])  # [J]
        for group in self._groups(touched):
            is_bounded = self.is_on and not any(MOVING in touched[i] for i in group)
            if is_bounded and (len(group) > 1 or FIXED in touched[group[0]]):
                self._bound(group, energies)
            else:
                self.state.bounds[group] = energies[group]
        for i, one in enumerate(self._objects):
            self.state.before[i] = one.velocity

    def _bound(self, group: list[int], energies: Array) -> None:
        """Bound the sum of the energies of some objects, which they exchange."""
        objects = [self._objects[i] for i in group]
        for i, one in zip(group, objects, strict=True):
            self.state.bounds[i] += one.work_of_flow(self.state.before[i])
        excess = float(energies[group].sum() - self.state.bounds[group].sum())
        kinetic = sum(one.kinetic() for one in objects)
        if excess > 0.0 and kinetic > 0.0:
            share = excess / kinetic
            for one in objects:
                one.slow_down(share)
        if len(group) > 1:  # what each may have from now on: the sum is as before
            left = np.array([one.energy() for one in objects])
            self.state.bounds[group] = left + (self.state.bounds[group].sum() - left.sum()) / len(
                group
            )

    def _groups(self, touched: Sequence[set[int]]) -> list[list[int]]:
        """Numbers of objects, those together that touch each other."""
        groups: list[list[int]] = []
        seen = set[int]()
        for i in range(len(self._objects)):
            if i in seen:
                continue
            group, waiting = [], [i]
            seen.add(i)
            while waiting:
                one = waiting.pop()
                group.append(one)
                near = sorted(touched[one] - seen - {FIXED, MOVING})
                seen.update(near)
                waiting += near
            groups.append(sorted(group))
        return groups

    def _touched(self) -> list[set[int]]:
        """For each object the numbers of others that it touches, `FIXED` and `MOVING`."""
        touched: list[set[int]] = [set() for _ in self._objects]
        if self._data.ncon == 0:
            return touched
        pairs = self._model.geom_bodyid[self._data.contact.geom].tolist()
        for first, second in pairs:
            for body, other in ((first, second), (second, first)):
                if (i := self._numbers.get(body)) is not None:
                    kind = FIXED if self._fixed[other] else MOVING
                    touched[i].add(self._numbers.get(other, kind))
        return touched


class _Object:
    """A loose object with its inertia, rigid and added."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, body: int) -> None:
        self.body = body
        dof = int(model.body_dofadr[body])
        place = int(model.jnt_qposadr[model.body_jntadr[body]])
        self._q, self.velocity = data.qpos[place : place + 7], data.qvel[dof : dof + 6]
        self._pushed, self._free = data.qacc[dof : dof + 6], data.qacc_smooth[dof : dof + 6]
        self._timestep, self._gravity = float(model.opt.timestep), model.opt.gravity
        self._mass = float(model.body_mass[body])
        self._middle = model.body_ipos[body].copy()  # (3,) [m]
        inertia = _rigid(model, body)
        self._displaced, self._lift_at, self._flow = 0.0, np.zeros(3), np.zeros(6)
        if model.nuser_body == c.BODY_COLUMNS and model.body_user[body, c.KIND] != c.DRY:
            row = model.body_user[body]
            inertia = inertia + _moved(row[c.ADDED : c.ADDED + 36].reshape(6, 6), row)
            self._displaced = float(row[c.DISPLACED])
            self._lift_at = row[c.REFERENCE : c.REFERENCE + 3] + row[c.CENTRE : c.CENTRE + 3]
            start = c.WATER_COLUMNS * body
            self._flow = data.userdata[start : start + 6]
        self._inertia = inertia  # about its origin, in its axes, linear part first, (6, 6)

    def energy(self) -> float:
        """Kinetic and potential energy in still water [J]."""
        return self._kinetic(self.velocity) + self._potential()

    def kinetic(self) -> float:
        """Kinetic energy [J]."""
        return self._kinetic(self.velocity)

    def slow_down(self, share: float) -> None:
        """Take a share of its kinetic energy out of its motion, all of it at most."""
        self.velocity *= math.sqrt(max(0.0, 1.0 - share))

    def work_of_flow(self, before: Array) -> float:
        """At most the work of moving water in the last step [J]; 0 in still water."""
        if not self._flow.any():
            return 0.0
        free = self.velocity - self._timestep * (self._pushed - self._free)
        return max(0.0, self._kinetic(free) - self._kinetic(before))

    def _kinetic(self, velocity: Array) -> float:
        twist = np.concatenate([rotate_back(self._rotation(), velocity[:3]), velocity[3:]])
        return 0.5 * dot(twist, product(self._inertia, twist))

    def _potential(self) -> float:
        """Of weight and buoyancy."""
        lever = self._mass * self._middle - self._displaced * self._lift_at
        moment = (self._mass - self._displaced) * self._q[:3] + rotate(self._rotation(), lever)
        return -dot(self._gravity, moment)

    def _rotation(self) -> Array:
        found = np.empty(9)
        mujoco.mju_quat2Mat(found, self._q[3:])
        return found.reshape(3, 3)


def _rigid(model: mujoco.MjModel, body: int) -> Array:
    """Inertia of the rigid body about its origin, in its axes, (6, 6)."""
    mass, turn = float(model.body_mass[body]), np.empty(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[body])
    axes = turn.reshape(3, 3)
    s = _skew(model.body_ipos[body])
    found = np.zeros((6, 6))
    found[:3, :3] = mass * np.eye(3)
    found[:3, 3:], found[3:, :3] = -mass * s, mass * s
    own = product(axes * model.body_inertia[body], axes.T)
    found[3:, 3:] = own - mass * product(s, s)
    return found


def _moved(added: Array, row: Array) -> Array:
    """Added mass about the origin, from that about the reference point, (6, 6)."""
    move = np.eye(6)  # twist at the reference from that at the origin
    move[:3, 3:] = -_skew(row[c.REFERENCE : c.REFERENCE + 3])
    return product(move.T, product(added, move))


def _skew(a: Array) -> Array:
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
