"""Small models in water for the tests of this room."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np

from uwsim.physics.hydrodynamics import BodyHydrodynamics, ThrusterSpec, prepare

FAR_BELOW = 1000.0  # a surface that nothing reaches [m]


def free_body(
    water: BodyHydrodynamics,
    *,
    mass: float,
    inertia: tuple[float, ...] = (1.0, 1.0, 1.0),
    centre_of_mass: tuple[float, float, float] = (0.0, 0.0, 0.0),
    thrusters: Mapping[str, ThrusterSpec] | None = None,
    surface: float = FAR_BELOW,
    density: float = 1000.0,
    timestep: float = 0.002,
    integrator: str = "implicitfast",
    gravity: float = 9.81,
) -> mujoco.MjModel:
    """Compile one free body called "body"."""
    spec = mujoco.MjSpec()
    set_options(spec, timestep=timestep, integrator=integrator, gravity=gravity)
    body = spec.worldbody.add_body(name="body", mass=mass, ipos=list(centre_of_mass))
    if len(inertia) == 3:
        body.inertia = list(inertia)
    else:
        body.fullinertia = list(inertia)
    body.explicitinertial = True
    body.add_freejoint()
    propellers = {name: ("body", one) for name, one in (thrusters or {}).items()}
    prepare(spec, {"body": water}, propellers, surface=surface, density=density)
    return spec.compile()


def set_options(
    spec: mujoco.MjSpec,
    *,
    timestep: float = 0.002,
    integrator: str = "implicitfast",
    gravity: float = 9.81,
) -> None:
    spec.option.timestep = timestep
    spec.option.integrator = {
        "RK4": mujoco.mjtIntegrator.mjINT_RK4,
        "Euler": mujoco.mjtIntegrator.mjINT_EULER,
        "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
        "discrete": mujoco.mjtIntegrator.mjINT_DISCRETE,
    }[integrator]
    spec.option.gravity = [0.0, 0.0, -gravity]


def random_added_mass(rng: np.random.Generator, scale: float = 1.0) -> tuple[float, ...]:
    """Symmetric positive definite, full, 36 numbers."""
    root = rng.normal(size=(6, 6))
    full = scale * (root @ root.T / 6 + 0.5 * np.eye(6))
    return tuple(float(value) for value in full.ravel())
