"""Self-test of the kernel's assumptions about MuJoCo, run once per process."""

from __future__ import annotations

import functools

import mujoco
import numpy as np

from ...scene.hydrodynamics.spec import BodyHydrodynamics, matrix
from . import callback
from .kernel.layout import MujocoChanged
from .table import prepare

STEP, LOSS = 0.01, 1e-9
"""Of the step that is tried [s], and what it may change of the energy, relative to it."""


@functools.cache
def self_test() -> None:
    """Compare offsets with live arrays, a mass matrix, a force and a step with what they must be.

    Raises:
        MujocoChanged: one of them is off.
    """
    callback.offsets()
    slot_was_ours = callback.is_installed()
    callback.remove()
    right = _equations_hold() and _energy_is_kept()
    if slot_was_ours:
        callback.install()
    if not right:
        raise MujocoChanged(
            f"The hydrodynamics kernel does not agree with itself on MuJoCo {mujoco.__version__}."
        )


def _equations_hold() -> bool:
    """Compare one mass matrix and one force with numpy's."""
    rng_free = np.arange(36.0).reshape(6, 6) / 36.0
    added = rng_free @ rng_free.T + np.diag(np.arange(1.0, 7.0))
    body = BodyHydrodynamics(
        link="b", added_mass=tuple(added.ravel()), linear_damping=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    )
    model = _model(body, mujoco.mjtIntegrator.mjINT_RK4)  # the equations, not their steps
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, -0.2, 0.1, 0.4, 0.5, -0.6
    mujoco.mj_forward(model, data)
    dry = np.empty((6, 6))
    mujoco.mj_fullM(model, data, dry)
    callback.add_water(model, data)
    wet = np.empty((6, 6))
    mujoco.mj_fullM(model, data, wet)
    # at the unit attitude body axes are world axes, so J is the identity
    linear, angular = data.qvel[:3], data.qvel[3:]
    momentum = added @ data.qvel
    force = -matrix(body.linear_damping) @ data.qvel
    force -= added @ np.concatenate([-np.cross(angular, linear), np.zeros(3)])
    force[:3] -= np.cross(angular, momentum[:3])
    force[3:] -= np.cross(angular, momentum[3:]) + np.cross(linear, momentum[:3])
    is_equal = np.allclose(wet - dry, added, rtol=0.0, atol=1e-9)
    return bool(is_equal and np.allclose(data.qfrc_passive, force, rtol=0.0, atol=1e-9))


def _energy_is_kept() -> bool:
    """Turn a free body for a step of ``implicitfast``.

    MuJoCo adds a gyroscopic term of its own there, which `free_bodies` takes back: if it added
    another, or none, the step would gain or lose energy.
    """
    added = (4.0, 20.0, 30.0, 0.3, 0.02, 0.1)
    body = BodyHydrodynamics(link="b", added_mass=added)
    model = _model(body, mujoco.mjtIntegrator.mjINT_IMPLICITFAST)
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, -0.2, 0.4, 2.0, 2.2, 1.1
    inertia = np.array([2.0, 2.0, 2.0, 1.0, 1.1, 1.2]) + added

    def energy() -> float:
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, data.qpos[3:])
        velocity = np.concatenate([turn.reshape(3, 3).T @ data.qvel[:3], data.qvel[3:]])
        return float(0.5 * np.sum(inertia * velocity**2))

    before = energy()
    callback.to_the_middle(model, data)
    mujoco.mj_step1(model, data)
    callback.add_water(model, data)
    mujoco.mj_step2(model, data)
    callback.to_the_end(model, data)
    return abs(energy() - before) <= LOSS * before


def _model(body: BodyHydrodynamics, integrator: mujoco.mjtIntegrator) -> mujoco.MjModel:
    """One free body in weightless water."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    spec.option.integrator = integrator
    spec.option.timestep = STEP
    node = spec.worldbody.add_body(name="b", mass=2.0, inertia=[1.0, 1.1, 1.2])
    node.add_freejoint()
    node.explicitinertial = True
    prepare(spec, {"b": body}, surface=100.0)
    return spec.compile()
