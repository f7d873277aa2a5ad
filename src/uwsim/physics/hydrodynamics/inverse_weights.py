"""The inverse inertias that scale MuJoCo's contacts and limits, corrected for the added mass.

MuJoCo computes ``body_invweight0``, ``dof_invweight0``, ``tendon_invweight0`` and the mean inertia
when it compiles a model, without the water. Contacts and limits of a body with a large added mass
would then be scaled as for a much lighter body.
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from ...base.numerics.linear import inverse
from . import callback
from . import columns as c

_FREE_JOINT, _BALL_JOINT = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)
_HIGH_SURFACE = 1e9  # a height of the surface above all bodies [m]


def correct_inverse_weights(model: mujoco.MjModel) -> None:
    """Recompute the inverse weights and the mean inertia of a model in water, at ``qpos0``.

    They follow from the mass matrix with added mass. Kinematic trees do not depend on each other.
    Their matrices are inverted separately, so that the time is proportional to their number.
    """
    if model.nv == 0:
        return
    starts = model.tree_dofadr.tolist()
    dofs = [slice(a, a + n) for a, n in zip(starts, model.tree_dofnum.tolist(), strict=True)]
    blocks = _mass_matrices(model, dofs)
    model.stat.meaninertia = float(np.concatenate([np.diag(block) for block in blocks]).mean())
    inverses = [inverse(block) for block in blocks]
    diagonal = np.concatenate([np.diag(block) for block in inverses])  # (nv,)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_tendon(model, data)
    for joint in range(model.njnt):
        first_dof = model.jnt_dofadr[joint]
        n_parts = {_FREE_JOINT: 2, _BALL_JOINT: 1}.get(int(model.jnt_type[joint]), 0)
        if n_parts == 0:
            model.dof_invweight0[first_dof] = diagonal[first_dof]
            continue
        for part in range(n_parts):
            three = slice(first_dof + 3 * part, first_dof + 3 * part + 3)
            model.dof_invweight0[three] = diagonal[three].mean()
    jacobian = np.empty((6, model.nv))
    for body in range(1, model.nbody):
        if model.body_weldid[body] == 0:
            continue
        tree = int(model.body_treeid[body])
        mujoco.mj_jacBodyCom(model, data, jacobian[:3], jacobian[3:], body)
        inverse_inertias = _inverse_inertia_diagonal(jacobian[:, dofs[tree]], inverses[tree])
        model.body_invweight0[body] = inverse_inertias[:3].mean(), inverse_inertias[3:].mean()
    if model.ntendon:
        rows = _tendon_jacobian(model, data)
        parts = zip(dofs, inverses, strict=True)
        model.tendon_invweight0[:] = sum(
            _inverse_inertia_diagonal(rows[:, part], block) for part, block in parts
        )


def _inverse_inertia_diagonal(rows: np.ndarray, inverse_mass: np.ndarray) -> np.ndarray:
    """Return the diagonal of ``J M^-1 J^T``."""
    return np.asarray(np.einsum("ij,jk,ik->i", rows, inverse_mass, rows))


def _mass_matrices(model: mujoco.MjModel, dofs: Sequence[slice]) -> list[np.ndarray]:
    """Return the mass matrix of each tree, in water at ``qpos0``, without implicit drag."""
    surface = model.body_user[0, c.SURFACE]
    implicitness = model.body_user[1:, c.DRAG_IMPLICITNESS].copy()
    flags = model.opt.enableflags
    data = mujoco.MjData(model)
    try:
        model.body_user[0, c.SURFACE] = _HIGH_SURFACE
        model.body_user[1:, c.DRAG_IMPLICITNESS] = 0.0
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        mujoco.mj_resetData(model, data)
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        callback.add_water(model, data)
    finally:
        model.body_user[0, c.SURFACE] = surface
        model.body_user[1:, c.DRAG_IMPLICITNESS] = implicitness
        model.opt.enableflags = flags
    return [_tree_mass_matrix(model, data, tree_dofs) for tree_dofs in dofs]


def _tree_mass_matrix(model: mujoco.MjModel, data: mujoco.MjData, dofs: slice) -> np.ndarray:
    """Return the mass matrix of one tree, (n, n); MuJoCo stores its lower triangle."""
    n = dofs.stop - dofs.start
    block = np.zeros((n, n))
    for row in range(n):
        start, length = model.M_rowadr[dofs.start + row], model.M_rownnz[dofs.start + row]
        columns = model.M_colind[start : start + length] - dofs.start
        block[row, columns] = block[columns, row] = data.M[start : start + length]
    return block


def _tendon_jacobian(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    rows = np.zeros((model.ntendon, model.nv))
    for tendon in range(model.ntendon):
        start, n = model.ten_J_rowadr[tendon], model.ten_J_rownnz[tendon]
        rows[tendon, model.ten_J_colind[start : start + n]] = data.ten_J[start : start + n]
    return rows
