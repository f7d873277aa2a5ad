"""The self-test of the kernel's assumptions about MuJoCo, which runs once in a process."""

from __future__ import annotations

import functools

import mujoco
import numpy as np

from ...scene.hydrodynamics.spec import BodyHydrodynamics, matrix
from . import callback
from .kernel.layout import MujocoChanged
from .table import prepare

STEP, MAX_LOSS = 0.01, 1e-9
"""The length of the tested step [s], and the greatest relative change of energy in it."""


@functools.cache
def self_test() -> None:
    """Check the field offsets, a mass matrix, a force and the energy of a step.

    Raises:
        MujocoChanged: one of them differs from the expected value.
    """
    callback.offsets()
    slot_was_ours = callback.is_installed()
    callback.remove()
    is_right = _equations_hold() and _energy_is_conserved()
    if slot_was_ours:
        callback.install()
    if not is_right:
        raise MujocoChanged(
            f"The hydrodynamics kernel fails its self-test with MuJoCo {mujoco.__version__}."
        )


def _equations_hold() -> bool:
    """Return whether a mass matrix and a force equal the results of numpy."""
    rng_free = np.arange(36.0).reshape(6, 6) / 36.0
    m_a = rng_free @ rng_free.T + np.diag(np.arange(1.0, 7.0))
    body = BodyHydrodynamics(
        link="b", added_mass=tuple(m_a.ravel()), linear_damping=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    )
    model = _model(body, mujoco.mjtIntegrator.mjINT_RK4)  # the equations, not their steps
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, -0.2, 0.1, 0.4, 0.5, -0.6
    mujoco.mj_forward(model, data)
    rigid_mass = np.empty((6, 6))
    mujoco.mj_fullM(model, data, rigid_mass)
    callback.add_water(model, data)
    mass = np.empty((6, 6))
    mujoco.mj_fullM(model, data, mass)
    # body axes are world axes here, so the Jacobian is the identity
    linear, angular = data.qvel[:3], data.qvel[3:]
    momentum = m_a @ data.qvel
    force = -matrix(body.linear_damping) @ data.qvel
    force -= m_a @ np.concatenate([-np.cross(angular, linear), np.zeros(3)])
    force[:3] -= np.cross(angular, momentum[:3])
    force[3:] -= np.cross(angular, momentum[3:]) + np.cross(linear, momentum[:3])
    is_equal = np.allclose(mass - rigid_mass, m_a, rtol=0.0, atol=1e-9)
    return bool(is_equal and np.allclose(data.qfrc_passive, force, rtol=0.0, atol=1e-9))


def _energy_is_conserved() -> bool:
    """Return whether a rotating free body conserves its energy in a step of ``implicitfast``.

    MuJoCo adds a gyroscopic term in this integrator, which `free_bodies` subtracts. If MuJoCo's
    term were different, the body would gain or lose energy in the step.
    """
    added_mass = (4.0, 20.0, 30.0, 0.3, 0.02, 0.1)
    body = BodyHydrodynamics(link="b", added_mass=added_mass)
    model = _model(body, mujoco.mjtIntegrator.mjINT_IMPLICITFAST)
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, -0.2, 0.4, 2.0, 2.2, 1.1
    inertia = np.array([2.0, 2.0, 2.0, 1.0, 1.1, 1.2]) + added_mass

    def energy() -> float:
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:])
        velocity = np.concatenate([rotation.reshape(3, 3).T @ data.qvel[:3], data.qvel[3:]])
        return float(0.5 * np.sum(inertia * velocity**2))

    start_energy = energy()
    callback.move_to_middle(model, data)
    mujoco.mj_step1(model, data)
    callback.add_water(model, data)
    mujoco.mj_step2(model, data)
    callback.move_to_end(model, data)
    return abs(energy() - start_energy) <= MAX_LOSS * start_energy


def _model(body: BodyHydrodynamics, integrator: mujoco.mjtIntegrator) -> mujoco.MjModel:
    """Return a model of one free body in water without gravity."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    spec.option.integrator = integrator
    spec.option.timestep = STEP
    node = spec.worldbody.add_body(name="b", mass=2.0, inertia=[1.0, 1.1, 1.2])
    node.add_freejoint()
    node.explicitinertial = True
    prepare(spec, {"b": body}, surface=100.0)
    return spec.compile()
