r"""The limit on the energy of loose objects that bounce.

A contact with a coefficient of restitution is a soft spring (`restitution`). In a long step a body
may penetrate a terrain mesh by more than the width of one of its facets. It may then be far behind
another facet, whose spring would eject it. Therefore the mechanical energy

.. math:: E = \tfrac12 \nu^T (M + M_A)\,\nu - g \cdot (m\,x_g - \rho V x_b)

of an object that touches only fixed bodies is limited to its value before the contact: above the
limit, the velocity is reduced. Here :math:`\nu` is the twist, :math:`M` the inertia of the body,
:math:`M_A` the added mass, m the mass, :math:`\rho V` the displaced mass, g the gravity vector,
:math:`x_g` the centre of mass and :math:`x_b` the centre of buoyancy, all in the world frame W.
For loose objects that touch each other, the sum of their energies is limited. In moving water, the
work of the water raises the limit. Objects that touch other moving bodies (a gripper, a vehicle)
have no limit. The limit is only computed in scenes with a coefficient of restitution.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from ..base.geometry import Array, cross_matrix, twist_shift
from ..base.numerics.linear import dot, product, rotate, rotate_back
from ..base.record import Record
from .hydrodynamics import columns as c

FIXED_BODY, MOVING_BODY = -1, -2
"""The kinds of bodies other than loose objects that an object may touch."""


@dataclass(slots=True)
class BounceState(Record):
    """The energy limits of loose objects."""

    bounds: Array
    """The greatest energy of each object, (n,) [J]."""
    velocities: Array
    """The velocity of each object before the step, as in ``qvel``, (n, 6) [m/s, rad/s]."""


class BounceLimit:
    """The limit on the energy of loose objects that bounce.

    Args:
        model: MuJoCo's model.
        data: MuJoCo's data.
        bodies: the MuJoCo body IDs of the loose objects.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, bodies: Sequence[int]) -> None:
        self._model, self._data = model, data
        self._objects = [_LooseBody(model, data, body) for body in bodies]
        self.is_on = True
        """True if the limit applies: while no vehicle holds an object."""
        self._indices = {body.body_id: i for i, body in enumerate(self._objects)}
        self._fixed = model.body_weldid == 0  # mask of the bodies that never move
        self.state = BounceState(
            np.array([body.energy() for body in self._objects]),
            np.array([body.velocity for body in self._objects]).reshape(-1, 6),
        )
        """The energy limits, and the velocities before the step."""

    def apply(self) -> None:
        """Limit the energy of each object or group of touching objects; call it after a step."""
        contacts = self._find_contacts()
        energies = np.array([body.energy() for body in self._objects])  # [J]
        for group in self._groups(contacts):
            is_bounded = self.is_on and not any(MOVING_BODY in contacts[i] for i in group)
            if is_bounded and (len(group) > 1 or FIXED_BODY in contacts[group[0]]):
                self._limit_energy(group, energies)
            else:
                self.state.bounds[group] = energies[group]
        for i, body in enumerate(self._objects):
            self.state.velocities[i] = body.velocity

    def _limit_energy(self, group: list[int], energies: Array) -> None:
        """Limit the sum of the energies of a group of objects that touch each other."""
        objects = [self._objects[i] for i in group]
        for i, body in zip(group, objects, strict=True):
            self.state.bounds[i] += body.work_of_flow(self.state.velocities[i])
        excess = float(energies[group].sum() - self.state.bounds[group].sum())
        kinetic_energy = sum(body.kinetic_energy() for body in objects)
        if excess > 0.0 and kinetic_energy > 0.0:
            share = excess / kinetic_energy
            for body in objects:
                body.slow_down(share)
        if len(group) > 1:  # the new limits have the same sum
            energies_now = np.array([body.energy() for body in objects])
            total = self.state.bounds[group].sum()
            self.state.bounds[group] = energies_now + (total - energies_now.sum()) / len(group)

    def _groups(self, contacts: Sequence[set[int]]) -> list[list[int]]:
        """Return groups of indices of objects that touch each other directly or indirectly."""
        groups: list[list[int]] = []
        known_indices = set[int]()
        for i in range(len(self._objects)):
            if i in known_indices:
                continue
            group, stack = [], [i]
            known_indices.add(i)
            while stack:
                index = stack.pop()
                group.append(index)
                neighbours = sorted(contacts[index] - known_indices - {FIXED_BODY, MOVING_BODY})
                known_indices.update(neighbours)
                stack += neighbours
            groups.append(sorted(group))
        return groups

    def _find_contacts(self) -> list[set[int]]:
        """Return, for each object, the indices of the objects that it touches.

        `FIXED_BODY` and `MOVING_BODY` represent all other bodies.
        """
        contacts: list[set[int]] = [set() for _ in self._objects]
        if self._data.ncon == 0:
            return contacts
        pairs = self._model.geom_bodyid[self._data.contact.geom].tolist()
        for pair in pairs:
            for body, other in (pair, pair[::-1]):
                if (i := self._indices.get(body)) is not None:
                    kind = FIXED_BODY if self._fixed[other] else MOVING_BODY
                    contacts[i].add(self._indices.get(other, kind))
        return contacts


class _LooseBody:
    """A loose object with its rigid and added inertia, and its centres of mass and buoyancy.

    r_g and r_b are the positions of the centres of mass and buoyancy in the body's frame [m].
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, body: int) -> None:
        self.body_id = body
        dof_start = int(model.body_dofadr[body])
        qpos_start = int(model.jnt_qposadr[model.body_jntadr[body]])
        dofs = slice(dof_start, dof_start + 6)
        self._q, self.velocity = data.qpos[qpos_start : qpos_start + 7], data.qvel[dofs]
        self._qacc, self._qacc_smooth = data.qacc[dofs], data.qacc_smooth[dofs]
        self._timestep, self._gravity = float(model.opt.timestep), model.opt.gravity
        self._mass = float(model.body_mass[body])
        self._r_g = model.body_ipos[body].copy()  # (3,) [m]
        inertia = _rigid_inertia(model, body)
        self._displaced_mass, self._r_b, self._flow = 0.0, np.zeros(3), np.zeros(6)
        if model.nuser_body == c.BODY_COLUMNS and model.body_user[body, c.KIND] != c.DRY_BODY:
            row = model.body_user[body]
            inertia = inertia + _shift_added_mass(row[c.M_A : c.M_A + 36].reshape(6, 6), row)
            self._displaced_mass = float(row[c.DISPLACED_MASS])
            self._r_b = row[c.REFERENCE : c.REFERENCE + 3] + row[c.CENTRE : c.CENTRE + 3]
            start = c.WATER_COLUMNS * body
            self._flow = data.userdata[start : start + 6]
        self._inertia = inertia  # about the body's origin, in its axes, linear part first, (6, 6)

    def energy(self) -> float:
        """Return the sum of kinetic and potential energy in still water [J]."""
        return self._kinetic_energy(self.velocity) + self._potential_energy()

    def kinetic_energy(self) -> float:
        """Return the kinetic energy [J]."""
        return self._kinetic_energy(self.velocity)

    def slow_down(self, share: float) -> None:
        """Reduce the kinetic energy by a fraction, at most to 0."""
        self.velocity *= math.sqrt(max(0.0, 1.0 - share))

    def work_of_flow(self, start: Array) -> float:
        """Return an upper bound of the work of moving water in the last step [J]; 0 in still water.

        Args:
            start: the velocity before the step, (6,) [m/s, rad/s].
        """
        if not self._flow.any():
            return 0.0
        v_smooth = self.velocity - self._timestep * (self._qacc - self._qacc_smooth)
        return max(0.0, self._kinetic_energy(v_smooth) - self._kinetic_energy(start))

    def _kinetic_energy(self, velocity: Array) -> float:
        twist = np.concatenate([rotate_back(self._rotation(), velocity[:3]), velocity[3:]])
        return 0.5 * dot(twist, product(self._inertia, twist))

    def _potential_energy(self) -> float:
        """Return the energy of weight and buoyancy [J]."""
        first_moment_body = self._mass * self._r_g - self._displaced_mass * self._r_b
        mass_difference = self._mass - self._displaced_mass
        # m x_g - rho V x_b [kg m]
        first_moment = mass_difference * self._q[:3] + rotate(self._rotation(), first_moment_body)
        return -dot(self._gravity, first_moment)

    def _rotation(self) -> Array:
        matrix = np.empty(9)
        mujoco.mju_quat2Mat(matrix, self._q[3:])
        return matrix.reshape(3, 3)


def _rigid_inertia(model: mujoco.MjModel, body: int) -> Array:
    """Return the rigid inertia of a body about its origin, in its axes, linear first, (6, 6)."""
    mass, rotation = float(model.body_mass[body]), np.empty(9)
    mujoco.mju_quat2Mat(rotation, model.body_iquat[body])
    axes = rotation.reshape(3, 3)
    s = cross_matrix(model.body_ipos[body])
    inertia = np.zeros((6, 6))
    inertia[:3, :3] = mass * np.eye(3)
    inertia[:3, 3:], inertia[3:, :3] = -mass * s, mass * s
    tensor = product(axes * model.body_inertia[body], axes.T)
    inertia[3:, 3:] = tensor - mass * product(s, s)
    return inertia


def _shift_added_mass(added_mass: Array, row: Array) -> Array:
    """Return the added mass about the body's origin from that about its reference point, (6, 6)."""
    shift = twist_shift(row[c.REFERENCE : c.REFERENCE + 3])
    return product(shift.T, product(added_mass, shift))
