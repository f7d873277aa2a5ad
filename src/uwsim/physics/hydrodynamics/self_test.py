"""Is this MuJoCo, on this machine, what the kernel believes it is? Asked once a process."""

from __future__ import annotations

import functools

import mujoco
import numpy as np

from . import callback
from .layout import MujocoChanged
from .spec import BodyHydrodynamics, matrix
from .table import prepare


@functools.cache
def self_test() -> None:
    """Hold offsets against live arrays, and one mass matrix and one force against numpy.

    Raises:
        MujocoChanged: one of them is off.
    """
    callback.offsets()
    rng_free = np.arange(36.0).reshape(6, 6) / 36.0
    added = rng_free @ rng_free.T + np.diag(np.arange(1.0, 7.0))
    body = BodyHydrodynamics(
        link="b", added_mass=tuple(added.ravel()), linear_damping=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    )
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4  # the equations, not their steps
    node = spec.worldbody.add_body(name="b", mass=2.0, inertia=[1.0, 1.1, 1.2])
    node.add_freejoint()
    node.explicitinertial = True
    prepare(spec, {"b": body}, surface=100.0)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, -0.2, 0.1, 0.4, 0.5, -0.6
    slot_was_ours = callback.is_installed()
    callback.remove()
    mujoco.mj_forward(model, data)
    dry = np.empty((6, 6))
    mujoco.mj_fullM(model, data, dry)
    callback.add_water(model, data)
    wet = np.empty((6, 6))
    mujoco.mj_fullM(model, data, wet)
    if slot_was_ours:
        callback.install()
    # at the unit attitude body axes are world axes, so J is the identity
    linear, angular = data.qvel[:3], data.qvel[3:]
    momentum = added @ data.qvel
    force = -matrix(body.linear_damping) @ data.qvel
    force -= added @ np.concatenate([-np.cross(angular, linear), np.zeros(3)])
    force[:3] -= np.cross(angular, momentum[:3])
    force[3:] -= np.cross(angular, momentum[3:]) + np.cross(linear, momentum[:3])
    right = np.allclose(wet - dry, added, rtol=0.0, atol=1e-9)
    if not right or not np.allclose(data.qfrc_passive, force, rtol=0.0, atol=1e-9):
        raise MujocoChanged(
            f"The hydrodynamics kernel does not agree with itself on MuJoCo {mujoco.__version__}."
        )
