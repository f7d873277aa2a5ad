"""Inverse inertias that MuJoCo's contacts are scaled with, corrected for the added mass.

MuJoCo computes ``body_invweight0``, ``dof_invweight0``, ``tendon_invweight0`` and the mean
inertia when it compiles, without the water. Contacts and limits of a body with much added mass
would then be scaled for a much lighter one.
"""

from __future__ import annotations

import mujoco
import numpy as np

from ...linear import inverse
from . import callback
from . import columns as c

_FREE, _BALL = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)
_ABOVE_ALL = 1e9  # a surface so high that everything is under water [m]


def correct_inverse_weights(model: mujoco.MjModel) -> None:
    """Recompute the inverse weights of ``model`` from M plus the added mass at ``qpos0``."""
    if model.nv == 0:
        return
    inverted = _inverse(_mass_matrix(model), model.dof_treeid)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_tendon(model, data)
    for joint in range(model.njnt):
        first = model.jnt_dofadr[joint]
        n_parts = {_FREE: 2, _BALL: 1}.get(int(model.jnt_type[joint]), 0)
        if n_parts == 0:
            model.dof_invweight0[first] = inverted[first, first]
            continue
        for part in range(n_parts):
            dofs = slice(first + 3 * part, first + 3 * part + 3)
            model.dof_invweight0[dofs] = np.diag(inverted)[dofs].mean()
    jacobian = np.empty((6, model.nv))
    for body in range(1, model.nbody):
        if model.body_weldid[body] == 0:
            continue
        mujoco.mj_jacBodyCom(model, data, jacobian[:3], jacobian[3:], body)
        spread = np.einsum("ij,jk,ik->i", jacobian, inverted, jacobian)
        model.body_invweight0[body] = spread[:3].mean(), spread[3:].mean()
    if model.ntendon:
        rows = _tendon_jacobian(model, data)
        model.tendon_invweight0[:] = np.einsum("ij,jk,ik->i", rows, inverted, rows)


def _mass_matrix(model: mujoco.MjModel) -> np.ndarray:
    """M at ``qpos0`` with everything under water, without implicit drag, (nv, nv)."""
    surface, thetas = model.body_user[0, c.SURFACE], model.body_user[1:, c.THETA].copy()
    flags = model.opt.enableflags
    data = mujoco.MjData(model)
    full = np.empty((model.nv, model.nv))
    try:
        model.body_user[0, c.SURFACE] = _ABOVE_ALL
        model.body_user[1:, c.THETA] = 0.0
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        mujoco.mj_resetData(model, data)
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        callback.add_water(model, data)
        mujoco.mj_fullM(model, data, full)
    finally:
        model.body_user[0, c.SURFACE] = surface
        model.body_user[1:, c.THETA] = thetas
        model.opt.enableflags = flags
    model.stat.meaninertia = float(np.diag(full).mean())
    return full


def _inverse(masses: np.ndarray, trees: np.ndarray) -> np.ndarray:
    """Invert M, in which no tree of bodies has anything to do with another."""
    found = np.zeros_like(masses)
    for tree in np.unique(trees):
        dofs = np.ix_(trees == tree, trees == tree)
        found[dofs] = inverse(masses[dofs])
    return found


def _tendon_jacobian(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    rows = np.zeros((model.ntendon, model.nv))
    for tendon in range(model.ntendon):
        first, n = model.ten_J_rowadr[tendon], model.ten_J_rownnz[tendon]
        rows[tendon, model.ten_J_colind[first : first + n]] = data.ten_J[first : first + n]
    return rows
