r"""Velocities and accelerations of points on the links of vehicles.

The velocities of a vehicle with dynamics are those at the end of the last step. Its accelerations
:math:`\ddot q` are the engine's solution for that step, with forces at the middle of the step: they
are half a step old. `link_kernel` has the formulas.
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.calls import address_of
from ...base.numerics.linear import inverse, product
from ...base.sampling import Addresses, number_addresses
from ...model.body_names import vehicle_joint
from ...world import BodyMotion
from ..poses import Poses
from . import link_kernel
from .link_kernel import CHAIN, HINGE, ROTATION, SLIDE, TRANSLATION

Chain = npt.NDArray[np.void]
"""A record of `link_kernel.CHAIN`, (1,)."""


class LinkMotion:
    """The motion of points on links.

    Args:
        model: the engine's model.
        data: the engine's state.
        poses: the poses of all bodies.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, poses: Poses) -> None:
        self._model, self._data, self._poses = model, data, poses
        self._scratch = np.zeros(link_kernel.scratch_size(model.nbody, model.nv))
        self._joint_rates: dict[int, tuple[Array, Array]] = {}
        self._chains: dict[tuple[int, int | None], Chain] = {}
        self._dof_arrays: list[npt.NDArray[np.int64]] = []  # kept alive for the chains

    def base_addresses(self, index: int) -> tuple[Addresses, Addresses]:
        """Return the addresses of the pose and the twist of a vehicle's base, (12,) and (6,).

        The pose is the position in W [m] and the rotation ``world_from_base`` by rows, as
        `Poses.refresh` computes them. The twist is the velocity in W [m/s] and the angular velocity
        in base axes [rad/s].
        """
        poses, body = self._poses, self._poses.base(index)
        dof = int(self._model.body_dofadr[body])
        pose = (
            number_addresses(poses.origins, np.arange(3 * body, 3 * body + 3)),
            number_addresses(poses.axes, np.arange(9 * body, 9 * body + 9)),
        )
        return np.concatenate(pose), number_addresses(self._data.qvel, np.arange(dof, dof + 6))

    def joint_addresses(self, index: int, names: Sequence[str], *, with_motion: bool) -> Addresses:
        """Return the addresses of numbers of n joints of a vehicle: positions [rad or m], (n,).

        With motion, (4 n,), they are followed by the addresses of the velocities [rad/s or m/s], of
        the efforts of actuators [N m or N], and of the applied efforts [N m or N].
        """
        model, data = self._model, self._data
        joints = [model.joint(vehicle_joint(index, name)).id for name in names]
        positions, dofs = model.jnt_qposadr[joints], model.jnt_dofadr[joints]
        addresses = [number_addresses(data.qpos, positions)]
        if with_motion:
            arrays = data.qvel, data.qfrc_actuator, data.qfrc_applied
            addresses += [number_addresses(array, dofs) for array in arrays]
        return np.concatenate(addresses)

    def joint_rates(self, index: int) -> tuple[Array, Array]:
        """Return the arrays of the joint motion of a kinematic vehicle.

        Args:
            index: the index of the vehicle.

        Returns:
            The speeds [m/s, rad/s] and the accelerations [m/s2, rad/s2] of all degrees of freedom
            of the scene, (nv,) each; those of other vehicles are 0.
        """
        if index not in self._joint_rates:
            self._joint_rates[index] = np.zeros(self._model.nv), np.zeros(self._model.nv)
        return self._joint_rates[index]

    def point_motion(self, body: int, point: Array, *, vehicle: int | None = None) -> BodyMotion:
        """Return the motion of a point on a body, in W.

        Args:
            body: the MuJoCo ID of the body.
            point: the point in W, (3,) [m].
            vehicle: the kinematic vehicle of the body, whose `joint_rates` are used; None for a
                body with dynamics.
        """
        self._poses.refresh()
        motion = link_kernel.compute_motion(self.chain(body, vehicle), point)
        return BodyMotion(motion[:3], motion[3:6], motion[6:])

    def point_mass(self, body: int, point: Array) -> Array:
        r"""Return the mass that a force at a point of a body accelerates, in W, (3, 3) [kg].

        It is :math:`(J M^{-1} J^T)^{-1}` with the mass matrix M of the last step, which includes
        the added mass, and the Jacobian J of the point. Before the first step it is the mass of the
        body alone.

        Args:
            body: the MuJoCo ID of a body that forces move.
            point: the point in W, (3,) [m].
        """
        if self._data.time == 0.0:
            return np.eye(3) * float(self._model.body_mass[body])
        jacobian = np.zeros((3, self._model.nv))
        mujoco.mj_jac(self._model, self._data, jacobian, None, point, body)
        rates = np.zeros_like(jacobian)
        mujoco.mj_solveM(self._model, self._data, rates, jacobian)
        return inverse(product(rates, jacobian.T))

    def chain(self, body: int, vehicle: int | None) -> Chain:
        """Return the joints that move a body, as a record for compiled code.

        Args:
            body: the MuJoCo ID of the body.
            vehicle: the kinematic vehicle of the body, whose `joint_rates` are used; None for a
                body with dynamics.
        """
        if (body, vehicle) in self._chains:
            return self._chains[body, vehicle]
        model, data = self._model, self._data
        motion = (data.qvel, data.qacc) if vehicle is None else self.joint_rates(vehicle)
        root, rows = int(model.body_rootid[body]), np.array(self._dof_rows(body), np.int64)
        chain = self._chains[body, vehicle] = np.zeros(1, CHAIN)
        chain["root"], chain["n_bodies"] = root, int((model.body_rootid == root).sum())
        chain["n_dofs"] = len(rows)
        self._dof_arrays.append(rows)
        for name, numbers in (
            ("dofs", rows),
            ("parents", model.body_parentid),
            ("masses", model.body_mass),
            ("tree_masses", model.body_subtreemass),
            ("centres", data.xipos),
            ("axes", data.xmat),
            ("anchors", data.xanchor),
            ("joint_axes", data.xaxis),
            ("speeds", motion[0]),
            ("accelerations", motion[1]),
            ("scratch", self._scratch),
        ):
            chain[name] = address_of(numbers)
        return chain

    def _dof_rows(self, body: int) -> list[tuple[int, int, int, int]]:
        """Return the index, kind, body and joint of each degree of freedom from root to body."""
        model, rows = self._model, []
        body = int(model.body_weldid[body])
        dof = int(model.body_dofadr[body] + model.body_dofnum[body] - 1) if body else -1
        while dof >= 0:
            joint = int(model.dof_jntid[dof])
            is_translation = dof < model.jnt_dofadr[joint] + 3  # of a free joint
            kind = {
                mujoco.mjtJoint.mjJNT_FREE: TRANSLATION if is_translation else ROTATION,
                mujoco.mjtJoint.mjJNT_SLIDE: SLIDE,
                mujoco.mjtJoint.mjJNT_HINGE: HINGE,
            }[mujoco.mjtJoint(model.jnt_type[joint])]
            rows.append((dof, kind, int(model.dof_bodyid[dof]), joint))
            dof = int(model.dof_parentid[dof])
        return rows[::-1]
